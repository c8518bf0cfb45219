/* tests/stress/family_photo.c - photography over the whole range of doubles, in 113 bits. */
/* SPDX-License-Identifier: MIT */
#include "quad.h"
#include "stress.h"

#include "photo/conjugate.h"
#include "photo/diffraction.h"
#include "photo/dof.h"
#include "photo/exposure.h"
#include "photo/flash.h"
#include "photo/fov.h"
#include "photo/given.h"
#include "photo/motion.h"
#include "photo/stops.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/*
 * A formula: what is given, all above 0, and what follows. A figure is right, or the question is
 * refused because some figure is beyond the range of doubles, or because of what the formula's own
 * header says; NaN is neither.
 */
enum { INPUTS = 5, FIGURES = 15 };
struct formula {
    const char *name;
    int inputs, figures;
    double typical[INPUTS]; /* of the numbers that people have */
    bool (*ask)(const double *x, double *y, struct error *error);
    /* NaN: the figure is absent; false: refused */
    bool (*truth)(const quad *x, quad *y);
};

static quad quad_log2(quad x)
{
    return (quad)log2l((long double)x);
}

/* -------- conjugates -------- */

static bool ask_conjugates(const struct conjugates_given *given, double *y, struct error *error)
{
    struct conjugates found;
    if (!conjugates_solve(given, &found, error)) {
        return false;
    }
    const double all[] = {found.f, found.s, found.v, found.m, found.T, found.extension};
    memcpy(y, all, sizeof all);
    return true;
}

static bool ask_focused(const double *x, double *y, struct error *error)
{
    const double nan = (double)NAN;
    const struct conjugates_given given = {x[0], x[1], nan, nan, nan, 0, 0};
    return ask_conjugates(&given, y, error);
}

static bool truth_of_image(quad f, quad s, quad m, quad *y)
{
    const quad all[] = {f, s, f * (1 + m), m, s + f * (1 + m), f * m};
    memcpy(y, all, sizeof all);
    return true;
}

static bool truth_focused(const quad *x, quad *y)
{
    return x[1] > x[0] && truth_of_image(x[0], x[1], x[0] / (x[1] - x[0]), y);
}

static bool ask_magnified(const double *x, double *y, struct error *error)
{
    const double nan = (double)NAN;
    const struct conjugates_given given = {x[0], nan, nan, x[1], nan, 0, 0};
    return ask_conjugates(&given, y, error);
}

static bool truth_magnified(const quad *x, quad *y)
{
    return truth_of_image(x[0], x[0] * (1 + 1 / x[1]), x[1], y);
}

static bool ask_between(const double *x, double *y, struct error *error)
{
    const double nan = (double)NAN;
    const struct conjugates_given given = {nan, x[0], x[1], nan, nan, 0, 0};
    return ask_conjugates(&given, y, error);
}

static bool truth_between(const quad *x, quad *y)
{
    const quad f = 1 / (1 / x[0] + 1 / x[1]), m = x[1] / x[0];
    const quad all[] = {f, x[0], x[1], m, x[0] + x[1], f * m};
    memcpy(y, all, sizeof all);
    return true;
}

static bool ask_bellows(const double *x, double *y, struct error *error)
{
    struct conjugates_exposure found;
    if (!conjugates_exposure(x[0], x[1], x[2], &found, error)) {
        return false;
    }
    y[0] = found.working_fnumber;
    y[1] = found.factor;
    y[2] = found.stops;
    return true;
}

static bool truth_bellows(const quad *x, quad *y)
{
    const quad more = x[1] / x[2];
    y[0] = x[0] * (1 + more);
    y[1] = (1 + more) * (1 + more);
    y[2] = 2 * (quad)(log1pl((long double)more) / logl(2));
    return true;
}

/* -------- diffraction -------- */

static bool ask_diffraction(const double *x, double *y, struct error *error)
{
    const struct diffraction_setting setting = {x[0], x[1], x[2], x[3], 0, x[4]};
    struct diffraction found;
    if (!diffraction_compute(&setting, &found, error)) {
        return false;
    }
    const double all[] = {found.working_fnumber, found.airy_diameter, found.cutoff, found.nyquist};
    memcpy(y, all, sizeof all);
    return true;
}

static bool truth_diffraction(const quad *x, quad *y)
{
    const quad N = x[0] * (1 + x[1] / x[2]), wavelength = x[3] / 1000;
    y[0] = N;
    y[1] = 2 * quad_read("1.2196698912665045") * wavelength * N;
    y[2] = 1 / (wavelength * N);
    y[3] = 1 / (2 * x[4]);
    return true;
}

static bool ask_spread(const double *x, double *y, struct error *error)
{
    return diffraction_focus_spread(x[0], x[1], x[2], y, error);
}

static bool truth_spread(const quad *x, quad *y)
{
    const quad f = x[0], near = x[1], far = x[2];
    y[0] = f * f * (far - near) / ((near - f) * (far - f));
    return near > f && far >= near;
}

/* -------- exposure, flash, motion, fields -------- */

static bool ask_light(const double *x, double *y, struct error *error)
{
    const double nan = (double)NAN;
    const struct exposure_given given = {x[0], x[1], x[2], nan, nan, nan, nan, nan, nan, nan, nan};
    struct exposure found;
    if (!exposure_solve(&given, &found, error)) {
        return false;
    }
    const double all[] = {found.L, found.E, found.ev100, found.ev_set};
    memcpy(y, all, sizeof all);
    return true;
}

static bool truth_light(const quad *x, quad *y)
{
    const quad light = x[0] * x[0] / (x[1] * x[2]);
    y[0] = quad_read("12.5") * light;
    y[1] = 250 * light;
    y[2] = quad_log2(100 * light);
    y[3] = quad_log2(x[0] * x[0] / x[1]);
    return true;
}

static bool ask_time(const double *x, double *y, struct error *error)
{
    const double nan = (double)NAN;
    const struct exposure_given given = {x[0], nan, x[1], nan, nan, x[2], nan, nan, nan, nan, nan};
    struct exposure found;
    if (!exposure_solve(&given, &found, error)) {
        return false;
    }
    y[0] = found.t;
    return true;
}

static bool truth_time(const quad *x, quad *y)
{
    y[0] = x[0] * x[0] * quad_read("12.5") / (x[1] * x[2]);
    return true;
}

static bool ask_flash(const double *x, double *y, struct error *error)
{
    struct flash_setting setting = {x[0], (double)NAN, x[1], x[2], 1, x[3], (double)NAN};
    enum flash_unknown unknown;
    y[0] = 0;
    const bool good = flash_solve(&setting, &unknown, error);
    y[0] = setting.N;
    return good;
}

static bool truth_flash(const quad *x, quad *y)
{
    y[0] = x[0] / x[1] * quad_root(x[2] / 100) * quad_root(x[3]);
    return true;
}

static bool ask_falloff(const double *x, double *y, struct error *error)
{
    return flash_falloff(x[0], x[1], y, error);
}

static bool truth_falloff(const quad *x, quad *y)
{
    y[0] = 2 * (quad_log2(x[1]) - quad_log2(x[0]));
    return true;
}

static bool ask_shake(const double *x, double *y, struct error *error)
{
    struct shake shake = {x[0], x[1], x[2], (double)NAN, x[3]};
    const bool good = shake_solve(&shake, error);
    y[0] = shake.blur;
    return good;
}

static bool truth_shake(const quad *x, quad *y)
{
    y[0] = x[0] * (1 + x[3]) * x[1] * x[2];
    return true;
}

static bool ask_motion(const double *x, double *y, struct error *error)
{
    struct motion motion = {x[0], x[1], x[2], (double)NAN, 1.5707963267948966, INFINITY, 0};
    const bool good = motion_solve(&motion, error);
    y[0] = motion.blur;
    return good;
}

static bool truth_motion(const quad *x, quad *y)
{
    y[0] = x[0] * x[1] * x[2];
    return true;
}

static bool ask_field(const double *x, double *y, struct error *error)
{
    return fov_focal_length_for_field(x[0], x[1], x[2], y, error);
}

static bool truth_field(const quad *x, quad *y)
{
    y[0] = x[2] * x[0] / (x[1] + x[0]);
    return true;
}

static bool ask_angle(const double *x, double *y, struct error *error)
{
    return fov_angle(RECTILINEAR, x[0], x[1], y, error);
}

static bool truth_angle(const quad *x, quad *y)
{
    y[0] = 2 * (quad)atanl((long double)(x[1] / (2 * x[0])));
    return true;
}

static bool ask_t_stop(const double *x, double *y, struct error *error)
{
    return t_stop(x[0], x[1], y, error);
}

static bool truth_t_stop(const quad *x, quad *y)
{
    y[0] = x[0] / quad_root(x[1]);
    return x[1] <= TRANSMITTANCE_MOST;
}

static bool ask_handheld(const double *x, double *y, struct error *error)
{
    return handheld_time(x[0], x[1], 0, y, error);
}

static bool truth_handheld(const quad *x, quad *y)
{
    y[0] = 1 / (x[0] * x[1]);
    return true;
}

/* -------- depth of field -------- */

static const char *const dof_names[FIGURES] = {
    "hyperfocal",    "near",           "far",
    "front",         "behind",         "total",
    "magnification", "depth of focus", "blur at infinity",
    "image",         "image of near",  "image of far",
    "1/near",        "1/far",          "working f-number"};

static bool ask_dof(const double *x, double *y, struct error *error)
{
    const struct dof_setting setting = {x[0], x[1], x[2], x[3], x[4]};
    struct dof d;
    if (!dof_compute(&setting, DOF_EXACT, &d, error)) {
        return false;
    }
    const double all[FIGURES] = {d.hyperfocal,    d.near,           d.far,
                                 d.front,         d.behind,         d.total,
                                 d.magnification, d.depth_of_focus, d.blur_at_infinity,
                                 d.image,         d.image_near,     d.image_far,
                                 d.near_vergence, d.far_vergence,   d.working_fnumber};
    memcpy(y, all, sizeof all);
    return true;
}

/* Similar triangles: the entrance pupil at q, f/N wide, blurs the plane s by c/m. */
static bool truth_dof(const quad *x, quad *y)
{
    const quad f = x[0], N = x[1], c = x[2], s = x[3], P = x[4];
    if (!(s > f)) {
        return false;
    }
    const quad m = f / (s - f), q = f - f / P, eps = N * c / (f * m), X = s - q;
    /* near and far, and how far they are beyond the front focus, over 1 +- eps */
    const quad front = X * eps / (1 + eps), behind = X * eps / (1 - eps);
    const quad near = s + q * eps, near_beyond = s - f - f / P * eps;
    const quad far = s - q * eps, far_beyond = s - f + f / P * eps;
    const bool is_far = eps >= 1;
    const quad none = (quad)INFINITY;
    const quad all[FIGURES] = {f * f / (N * c) + f,
                               near / (1 + eps),
                               is_far ? none : far / (1 - eps),
                               front,
                               is_far ? none : behind,
                               is_far ? none : front + behind,
                               m,
                               2 * N * c * (1 + m / P),
                               f * m / N,
                               f * s / (s - f),
                               near_beyond > 0 ? f * near / near_beyond : (quad)NAN,
                               is_far ? f : f * far / far_beyond,
                               (1 + eps) / near,
                               is_far ? 0 : (1 - eps) / far,
                               N * (1 + m / P)};
    memcpy(y, all, sizeof all);
    return true;
}

static const struct formula depth = {"dof", 5, FIGURES, {50, 4, 0.03, 3000, 1}, ask_dof, truth_dof};

static const struct formula formulas[] = {
    {"f and distance", 2, 6, {50, 2000}, ask_focused, truth_focused},
    {"f and magnification", 2, 6, {50, 0.1}, ask_magnified, truth_magnified},
    {"distance and image", 2, 6, {2000, 60}, ask_between, truth_between},
    {"bellows", 3, 3, {8, 1, 1}, ask_bellows, truth_bellows},
    {"diffraction", 5, 4, {8, 0.1, 1, 0.55, 0.005}, ask_diffraction, truth_diffraction},
    {"focus spread", 3, 1, {50, 1500, 4000}, ask_spread, truth_spread},
    {"light", 3, 4, {8, 0.01, 100}, ask_light, truth_light},
    {"time", 3, 1, {8, 100, 500}, ask_time, truth_time},
    {"flash", 4, 1, {40000, 3000, 100, 1}, ask_flash, truth_flash},
    {"fall-off", 2, 1, {1000, 3000}, ask_falloff, truth_falloff},
    {"shake", 4, 1, {50, 0.02, 0.01, 0.1}, ask_shake, truth_shake},
    {"motion", 3, 1, {10000, 0.01, 0.02}, ask_motion, truth_motion},
    {"field", 3, 1, {36, 1000, 3000}, ask_field, truth_field},
    {"angle", 2, 1, {50, 36}, ask_angle, truth_angle},
    {"T-stop", 2, 1, {2, 0.8}, ask_t_stop, truth_t_stop},
    {"hand-held", 2, 1, {50, 1.5}, ask_handheld, truth_handheld},
};

/* Half as people have them, half of any size that a double may have. */
static void draw_inputs(struct trial *trial, const struct formula *formula, double *x)
{
    const bool usual = trial_chance(trial, 0.5), near = trial_chance(trial, 0.3);
    for (int i = 0; i < formula->inputs; i++) {
        const double any = trial_chance(trial, 0.1) ? trial_magnitude(trial, 5e-324, DBL_MAX)
                                                    : trial_magnitude(trial, 1e-31, 1e31);
        x[i] = usual ? formula->typical[i] * trial_magnitude(trial, 1e-3, 1e3) : any;
        if (near && i > 0) { /* differences of what is nearly the same */
            x[i] = x[i - 1] * (1 + trial_magnitude(trial, 1e-12, 10));
            x[i] = isfinite(x[i]) ? x[i] : DBL_MAX;
        }
    }
}

static void formula_sensitivity(const struct formula *formula, const double *x, quad *sums)
{
    const quad step = (quad)1e-9;
    quad at[INPUTS], here[FIGURES], there[FIGURES];
    for (int i = 0; i < formula->inputs; i++) {
        at[i] = (quad)x[i];
    }
    memset(sums, 0, FIGURES * sizeof *sums);
    (void)formula->truth(at, here);
    for (int i = 0; i < formula->inputs; i++) {
        at[i] += at[i] * step;
        const bool is_there = formula->truth(at, there);
        for (int k = 0; k < formula->figures; k++) {
            sums[k] += is_there ? quad_size(there[k] - here[k]) / step : (quad)INFINITY;
        }
        at[i] = (quad)x[i];
    }
}

static void check_figure(struct trial *trial, const struct formula *formula, int k, double value,
                         quad truth, quad sensitivity)
{
    const char *name =
        formula->inputs == INPUTS && formula->figures == FIGURES ? dof_names[k] : formula->name;
    if (truth != truth) {
        trial_skip(trial);
    } else if (value == (double)truth) {
        trial_verdict(trial, true, "%s", name);
    } else if (!isfinite(value) || !quad_is_finite(truth)) {
        /* on the border of infinity either is right */
        const bool is_open = !isnan(value) && !quad_is_finite(sensitivity);
        trial_verdict(trial, is_open || (isinf(value) && isinf((double)truth)),
                      "%s %d: %g, not %.17g", name, k, value, (double)truth);
    } else if (isinf((double)truth)) {
        trial_verdict(trial, false, "%s %d: %g of what no double holds", name, k, value);
    } else {
        /* numbers below 2^-1022 have fewer digits */
        const double size = fmax((double)quad_size(truth), DBL_MIN);
        trial_figure(trial, name, (double)quad_size((quad)value - truth), size,
                     fmin((double)sensitivity, DBL_MAX));
    }
}

/* Some figure that is no double any more, or hardly. */
static bool is_out_of_range(const struct formula *formula, const quad *y)
{
    bool is_out = false;
    for (int k = 0; k < formula->figures; k++) {
        const quad size = quad_size(y[k]);
        is_out =
            is_out || size > (quad)(DBL_MAX / 1e3) || (size != 0 && size < (quad)DBL_MIN * 1000);
    }
    return is_out;
}

static void try_formula(struct trial *trial, const struct formula *formula)
{
    double x[INPUTS], y[FIGURES];
    quad at[INPUTS], truth[FIGURES], sensitivity[FIGURES];
    struct error error = {0};
    draw_inputs(trial, formula, x);
    char *text = arena_array(&trial->arena, 300, 1);
    int length = snprintf(text, 300, "%s of", formula->name);
    for (int i = 0; i < formula->inputs; i++) {
        length += snprintf(text + length, 300 - (size_t)length, " %.17g", x[i]);
        at[i] = (quad)x[i];
    }
    snprintf(text + length, 300 - (size_t)length, "\n");
    trial->about = text;
    const bool is_there = formula->truth(at, truth), answers = formula->ask(x, y, &error);
    if (!answers) {
        bool is_given = true;
        for (int i = 0; i < formula->inputs; i++) {
            is_given = is_given && x[i] >= GIVEN_LEAST && x[i] <= GIVEN_MOST;
        }
        trial_verdict(trial, !is_given || !is_there || is_out_of_range(formula, truth),
                      "refused: %s", error.message);
        return;
    }
    if (!trial_verdict(trial, is_there, "is answered with %g", y[0])) {
        return;
    }
    formula_sensitivity(formula, x, sensitivity);
    for (int k = 0; k < formula->figures; k++) {
        check_figure(trial, formula, k, y[k], truth[k], sensitivity[k]);
    }
}

void try_photography(struct trial *trial)
{
    const int last = (int)(sizeof formulas / sizeof formulas[0]) - 1;
    try_formula(trial, &formulas[trial_whole(trial, 0, last)]);
}

void try_depth_of_field(struct trial *trial)
{
    try_formula(trial, &depth);
}
