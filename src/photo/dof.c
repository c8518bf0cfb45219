/* photo/dof.c - geometric depth of field of a thin lens with a pupil magnification. */
/* SPDX-License-Identifier: MIT */
#include "photo/dof.h"

#include <math.h>

#include "photo/given.h"

const struct word dof_models[DOF_MODELS + 1] = {
    [DOF_EXACT] = {"exact", "thin lens with pupils, no approximation"},
    [DOF_NO_F] = {"no-f",
                  "H = f^2/(N c) without + f, near and far H s/(H +- (s - f)); pupils ignored"},
    [DOF_POPULAR] = {"popular", "H = f^2/(N c), near and far H s/(H +- s); too deep by 1 + m"},
    [DOF_CLOSE_UP] = {"close-up", "depth 2 N c (1 + m)/m^2, half on each side; only far below H"},
};

/* The refusals of dof_check; apart, so that the checks in the hot path are one branch. */
static bool dof_refuse(const struct dof_setting *a, struct error *error)
{
    if (!check_positive("focal length", " mm", a->f, error) ||
        !check_positive("f-number", "", a->N, error) ||
        !check_not_negative("circle of confusion", " mm", a->c, error) ||
        !check_positive("pupil magnification", "", a->P, error)) {
        return false;
    }
    if (isfinite(a->s) && a->s > GIVEN_MOST) {
        return check_positive("distance", " mm", a->s, error);
    }
    if (isnan(a->s)) {
        return fail(error, ERROR_DOMAIN, "{distance} is not a number; it must be above %.15g mm",
                    a->f);
    }
    return fail(error, ERROR_DOMAIN,
                "{distance} %.15g mm lies within {the focal length} %.15g mm: no real image", a->s,
                a->f);
}

static bool legal(const struct dof_setting *a)
{
    return a->f >= GIVEN_LEAST && a->N >= GIVEN_LEAST && (a->c >= GIVEN_LEAST || a->c == 0) &&
           a->P >= GIVEN_LEAST && a->s > a->f && a->f <= GIVEN_MOST && a->N <= GIVEN_MOST &&
           a->c <= GIVEN_MOST && a->P <= GIVEN_MOST && (a->s <= GIVEN_MOST || a->s == INFINITY);
}

static bool refuse_range(const struct dof_setting *a, struct error *error)
{
    return fail(error, ERROR_DOMAIN,
                "{focal length} %.15g mm, {f-number} %.15g, {circle of confusion} %.15g mm, "
                "{distance} %.15g mm, {pupil magnification} %.15g: the result is outside the range "
                "of numbers (1e-308 to 1e308)",
                a->f, a->N, a->c, a->s, a->P);
}

/* Near and far limit for e > 0; m, image and the like are already there. */
static inline void limits(const struct dof_setting *a, double e, double p, struct dof *d)
{
    double f = a->f, s = a->s, m = d->magnification;
    double gap = s - f, fp = f * p, ep = e * p;
    double q = f - fp, X = gap + fp, eps = e * gap / f;

    /* near: every length times `unit`, which is m from H on, so that infinity stays finite */
    bool finite = eps < 1;
    double unit = finite ? 1 : m, weight = finite ? eps : e;
    double subject = finite ? s : d->image, room = finite ? X : f + fp * m;
    double den = unit + weight, num = subject + q * weight;
    double scale = 1 / (den * num);
    double C = -room * weight * scale, S = subject * unit * (1 - ep) * scale;
    d->hyperfocal = f / e + f;
    d->near = num / den;
    d->near_vergence = den / num;
    d->near_condition = fabs(1 - S - C) + fabs(S) + 2 * fabs(C);
    d->front = X * (weight / den);
    d->image_near = ep < 1 ? f + f * ((m + e) / (1 - ep)) : INFINITY;

    if (finite) {
        double rest = 1 - eps;
        scale = 1 / (rest * (s - q * eps));
        double behind = X * eps / rest;
        C = X * eps * scale;
        S = s * (1 + ep) * scale;
        d->behind = behind;
        d->far = s + behind;
        d->far_vergence = 1 / d->far;
        d->far_condition = fabs(1 - S - C) + fabs(S) + 2 * fabs(C);
        d->image_far = f + f * ((m - e) / (1 + ep));
    } else {
        d->far = d->behind = d->far_condition = INFINITY;
        d->far_vergence = 0;
        d->image_far = f;
    }
    d->total = d->front + d->behind;
}

/* The exact answer; false when a number overflows. */
static inline bool exact(const struct dof_setting *a, struct dof *d)
{
    double f = a->f, Nc = a->N * a->c, p = 1 / a->P;
    double m = f / (a->s - f), e = Nc / f, pupil = 1 + m * p;
    d->magnification = m;
    d->depth_of_focus = 2 * Nc * pupil;
    d->blur_at_infinity = f * m / a->N;
    d->image = f + f * m;
    d->working_fnumber = a->N * pupil;
    double range = d->depth_of_focus + d->blur_at_infinity + d->image + d->working_fnumber;
    if (!(e > 0)) {
        /* Limits that coincide with the subject: nothing is blurred less than not at all. */
        double s = a->s;
        d->hyperfocal = INFINITY;
        d->near = d->far = s;
        d->front = d->behind = d->total = 0;
        d->image_near = d->image_far = d->image;
        d->near_vergence = d->far_vergence = 1 / s;
        d->near_condition = d->far_condition = s < INFINITY ? 1 : INFINITY;
        return range < INFINITY;
    }
    limits(a, e, p, d);
    return range + d->hyperfocal + fabs(d->near) < INFINITY && d->near_condition >= 0;
}

/* Image distance of a plane at x from the front principal plane; inf when it is not real. */
static double conjugate(double f, double x)
{
    return x > f ? f + f * (f / (x - f)) : INFINITY;
}

/* Half of 2 N c (1 + m)/m^2 on each side. */
static bool close_up_limits(const struct dof_setting *a, struct dof *d, struct error *error)
{
    double m = d->magnification, half = a->N * a->c * (1 + m) / (m * m);
    if (!(half < a->s)) {
        return fail(error, ERROR_DOMAIN,
                    "the close-up formula puts the near limit behind the lens at %.15g mm; it "
                    "needs a distance below the hyperfocal %.15g mm",
                    a->s, d->hyperfocal);
    }
    d->front = d->behind = half;
    d->near = a->s - half;
    d->far = a->s + half;
    return true;
}

/* What another program would print, beside the exact rest. */
static bool short_cut(const struct dof_setting *a, enum dof_model model, struct dof *d,
                      struct error *error)
{
    if (!(a->N * a->c / a->f > 0)) {
        return true; /* without blur all models agree */
    }
    if (model == DOF_CLOSE_UP && !close_up_limits(a, d, error)) {
        return false;
    }
    if (model != DOF_CLOSE_UP) {
        d->hyperfocal = a->f / (a->N * a->c / a->f);
    }
    if (model == DOF_POPULAR) {
        /* Near and far limit of H s/(H +- s), written with r = s/H. */
        double H = d->hyperfocal, r = a->s / H;
        d->near = a->s < INFINITY ? a->s / (1 + r) : H;
        d->front = a->s / (1 + H / a->s);
        d->behind = r < 1 ? a->s * (r / (1 - r)) : INFINITY;
        d->far = a->s + d->behind;
    }
    d->total = d->front + d->behind;
    d->near_vergence = 1 / d->near;
    d->far_vergence = 1 / d->far;
    d->image_near = conjugate(a->f, d->near);
    d->image_far = d->far < INFINITY ? conjugate(a->f, d->far) : a->f;
    return true;
}

bool dof_check(const struct dof_setting *setting, struct error *error)
{
    return legal(setting) || dof_refuse(setting, error);
}

bool dof_compute(const struct dof_setting *setting, enum dof_model model, struct dof *dof,
                 struct error *error)
{
    if (!legal(setting)) {
        return dof_refuse(setting, error);
    }
    if (model == DOF_EXACT) {
        return exact(setting, dof) || refuse_range(setting, error);
    }
    struct dof_setting thin = *setting;
    thin.P = 1;
    return (exact(&thin, dof) || refuse_range(setting, error)) &&
           short_cut(&thin, model, dof, error);
}

double dof_hyperfocal(double f, double N, double c)
{
    return f / (N * c / f) + f;
}

double dof_near_at_hyperfocal(double f, double N, double c, double P)
{
    return (dof_hyperfocal(f, N, c) + (f - f / P)) / 2;
}

double dof_hyperfocal_of_near(double f, double P, double Nc, double near)
{
    if (isnan(f)) {
        double b = 2 - 1 / P;
        f = 4 * near / (b + sqrt(b * b + 8 * near / Nc));
    }
    return 2 * near - f * (1 - 1 / P);
}

bool dof_blur_at(const struct dof_setting *a, double x, double *blur, struct error *error)
{
    const double pupil = a->f * (1 - 1 / a->P), pupil_diameter = a->f / a->N;
    if (!(x > pupil)) {
        return fail(error, ERROR_DOMAIN,
                    "a point %.6g mm from the front principal plane lies behind the entrance "
                    "pupil, at %.6g mm: it is not in the picture",
                    x, pupil);
    }
    /* m |x - s|/(x - q); s and x are not subtracted from infinity */
    double part;
    if (isinf(a->s)) {
        part = isinf(x) ? 0 : a->f / (x - pupil);
    } else {
        const double m = a->f / (a->s - a->f);
        part = isinf(x) ? m : m * (fabs(x - a->s) / (x - pupil));
    }
    *blur = pupil_diameter * part;
    return *blur < INFINITY ||
           fail(error, ERROR_DOMAIN, "the blur of a point at %.6g mm is too large for a number", x);
}

void dof_vergences(const struct dof_setting *a, double N, double *near, double *far)
{
    double m = a->f / (a->s - a->f), e = N * a->c / a->f;
    double room = a->f * (1 + m / a->P), q = a->f * (1 - 1 / a->P);
    *near = (m + e) / (room + q * (m + e));
    *far = (m - e) / (room + q * (m - e));
}
