/* analysis/rays/distortion_fit.c - models fitted to exact chief rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/distortion_fit.h"

#include "base/constants.h"
#include "base/linear.h"
#include "base/roots.h"

#include <math.h>

/* -------- the profile -------- */

enum { FIELDS = 128, STEPS = 24, HALVINGS = 40 };

static const double UP[2] = {0, 1};

/* A walk along the radius of the image. */
struct fit_walk {
    const struct distortion_map *map;
    double radius; /* goal, mm */
    double stated; /* as far as the lens says that it is made for */
    bool is_open;  /* no diameter of a surface ends the field by itself */
    double sign;   /* -1: the image is upside down */
    struct error *error;
};

static bool fit_look(const struct fit_walk *walk, double amount, struct distortion_point *point)
{
    if (!distortion_towards(walk->map, UP, amount, point, walk->error)) {
        return false;
    }
    if (amount <= walk->stated) {
        return true;
    }
    return (point->is_lit ||
            fail(walk->error, ERROR_DOMAIN, "clear apertures stop the chief ray")) &&
           (!(walk->is_open && walk->stated > 0) ||
            fail(walk->error, ERROR_DOMAIN, "it is beyond the field of the lens"));
}

static double fit_beyond(double amount, const void *context)
{
    const struct fit_walk *walk = context;
    struct distortion_point point;
    return fit_look(walk, amount, &point) ? walk->sign * point.height - walk->radius : (double)NAN;
}

/* The last field between one that is seen and one that is not. */
static double last_between(const struct fit_walk *walk, double seen, double lost, double height)
{
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = (seen + lost) / 2;
        struct distortion_point point;
        bool good = fit_look(walk, middle, &point) && walk->sign * point.height > height;
        if (good) {
            seen = middle;
            height = walk->sign * point.height;
        } else {
            lost = middle;
        }
    }
    return seen;
}

/* The field at the goal, or the last before it. 0: there is none. */
static double walk_out(const struct fit_walk *walk, double step)
{
    double amount = 0, height = 0, edge;
    bool ended = false;
    while (!ended) {
        struct distortion_point point;
        double next = amount + step;
        ended = !fit_look(walk, next, &point) || !(walk->sign * point.height > height);
        if (ended) {
            next = last_between(walk, amount, next, height);
        }
        if (!fit_look(walk, next, &point)) {
            return amount;
        }
        height = walk->sign * point.height;
        if (height >= walk->radius) {
            return root_find(fit_beyond, walk, amount, next, &edge, walk->error) ? edge : amount;
        }
        amount = next;
    }
    return amount;
}

/* Fields evenly spaced as far as `edge`. */
static bool distortion_sample(const struct fit_walk *walk, double edge, double distance,
                              struct distortion_profile *profile, struct error *error)
{
    struct distortion_point point;
    if (!distortion_towards(walk->map, UP, 1e-4 * edge, &point, error)) {
        return false;
    }
    const double scale = walk->map->scale * (point.height / point.ideal);
    profile->focal = fabs(scale * distance);
    for (size_t i = 0; i < FIELDS; i++) {
        const double amount = i + 1 < FIELDS ? edge * (double)(i + 1) / FIELDS : edge;
        if (!distortion_towards(walk->map, UP, amount, &point, error)) {
            return false;
        }
        profile->ideal[i] = fabs(point.ideal / (walk->map->scale * distance));
        profile->real[i] = walk->sign * point.height;
    }
    profile->count = FIELDS;
    profile->reached = profile->real[FIELDS - 1];
    const double *r = profile->real;
    const size_t last = profile->count - 1;
    for (size_t i = 0; i <= last; i++) {
        const double before = i > 0 ? r[i - 1] : 0;
        profile->weight[i] = (r[i < last ? i + 1 : last] - before) / 2;
    }
    return true;
}

/* Has no surface but the stop a clear aperture? */
static bool distortion_fit_is_open(const struct lens *lens)
{
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        if (i != lens->stop && (surface->has_diameter || surface->aperture_count > 0)) {
            return false;
        }
    }
    return true;
}

bool distortion_trace(const struct distortion_map *map, double radius, struct arena *arena,
                      struct distortion_profile *profile, struct error *error)
{
    struct fit_walk walk = {
        .map = map, .radius = radius, .sign = map->scale < 0 ? -1 : 1, .error = error};
    const bool far = map->setup.object.is_infinite;
    /* from where a near object is seen: the distance to the entrance pupil */
    const double distance =
        far ? 1 : map->setup.object.distance.hi + map->setup.first.entrance_pupil;
    const double first = radius / fabs(map->scale);
    *profile = (struct distortion_profile){.ideal = ARENA_ARRAY(arena, FIELDS, double),
                                           .real = ARENA_ARRAY(arena, FIELDS, double),
                                           .weight = ARENA_ARRAY(arena, FIELDS, double)};
    if (!lens_is_round(map->setup.lens)) {
        return fail(error, ERROR_DOMAIN,
                    "the lens is not the same all about its axis, as models of distortion are");
    }
    if (!isfinite(distance)) {
        return fail(error, ERROR_DOMAIN,
                    "the entrance pupil is infinitely far away: no focal length makes heights of "
                    "the object into angles");
    }
    /* As far as the lens says that it is made for, whatever is asked; 0: it does not say. */
    const struct lens *lens = map->setup.lens;
    const struct field_point largest = {lens->field_kind, {0, lens_field_extent(lens)}};
    double towards[2], amount;
    struct error none;
    walk.stated =
        lens->field_count > 0 && distortion_direction(map, &largest, towards, &amount, &none)
            ? amount
            : 0;
    walk.is_open = distortion_fit_is_open(map->setup.lens);
    const double edge = walk_out(&walk, (far ? atan(first) : first) / STEPS);
    if (!(edge > 1e-6 * first)) {
        return error_prefix(error, "no field off the axis is imaged: ");
    }
    if (!distortion_sample(&walk, edge, distance, profile, error)) {
        return false;
    }
    /* Towards 90 degrees the rectilinear image grows beyond all bounds. */
    const double ideal = profile->focal * profile->ideal[profile->count - 1];
    return ideal <= 8 * profile->reached ||
           fail(error, ERROR_DOMAIN,
                "the picture shows fields of %.4g deg, which the %s projection images %.3g times "
                "as far out: that is beyond polynomials, use another {projection}",
                edge * DEGREES_PER_RADIAN, projections[map->projection].word,
                ideal / profile->reached);
}

/* -------- the fit -------- */

/* One way: out = (slope in + sum c_j in^p_j)/(1 + sum c_j in^p_j), the last terms below. */
struct fit_equations {
    const struct distortion_profile *profile;
    const struct model_facts *facts;
    const double *in, *out;
    bool is_free; /* the slope is to be found */
    double slope;
    double c[MODEL_TERMS];
};

/* Is the j-th term below the line? */
static bool is_below(const struct model_facts *facts, size_t j)
{
    return j + facts->below >= facts->terms;
}

/* What the coefficients make of a height, and what of it stands below the line. */
static double fit_make(const struct fit_equations *equations, double in, double *below)
{
    const struct model_facts *facts = equations->facts;
    double above = equations->slope * in;
    *below = 1;
    for (size_t j = 0; j < facts->terms; j++) {
        double *side = is_below(facts, j) ? below : &above;
        *side += equations->c[j] * distortion_power(in, facts->powers[j]);
    }
    return above / *below;
}

/* The square of what is left; infinite with a pole among the heights. */
static double distortion_fit_left_over(const struct fit_equations *equations)
{
    double sum = 0, below;
    for (size_t i = 0; i < equations->profile->count; i++) {
        const double off = equations->out[i] - fit_make(equations, equations->in[i], &below);
        sum += below > 0 ? equations->profile->weight[i] * off * off : (double)INFINITY;
    }
    return sum;
}

/*
 * Least squares of the equations times what stands below the line, with that of the coefficients
 * before; is_step: of their differences.
 */
static void distortion_fit_solve_linear(const struct fit_equations *equations, bool is_step,
                                        struct arena *arena, double *x)
{
    const struct arena_mark mark = arena_mark(arena);
    const struct model_facts *facts = equations->facts;
    const size_t rows = equations->profile->count, terms = facts->terms;
    const size_t columns = terms + (equations->is_free ? 1 : 0);
    double *a = ARENA_ARRAY(arena, rows * columns, double), *b = ARENA_ARRAY(arena, rows, double);
    for (size_t i = 0; i < rows; i++) {
        const double in = equations->in[i], out = equations->out[i];
        double below, made = fit_make(equations, in, &below);
        const double root = sqrt(equations->profile->weight[i]), over = root / below;
        const double divided = is_step ? made : out, known = equations->slope * in;
        for (size_t j = 0; j < terms; j++) {
            const double factor = is_below(facts, j) ? -divided : 1;
            a[i * columns + j] = over * factor * distortion_power(in, facts->powers[j]);
        }
        if (equations->is_free) {
            a[i * columns + terms] = over * in;
        }
        if (is_step) {
            b[i] = root * (out - made);
        } else {
            b[i] = over * (equations->is_free ? out : out - known);
        }
    }
    const struct linear_factors factors = linear_factor(a, rows, columns, 1e-12, arena);
    x[terms] = 0;
    linear_solve(&factors, b, x);
    arena_reset(arena, mark);
}

/* Solved as linear ones, with what stood below the line before. */
static struct fit_equations solved(const struct fit_equations *equations, struct arena *arena)
{
    struct fit_equations next = *equations;
    double x[MODEL_TERMS + 1];
    distortion_fit_solve_linear(equations, false, arena, x);
    for (size_t j = 0; j < equations->facts->terms; j++) {
        next.c[j] = x[j];
    }
    next.slope = equations->is_free ? x[equations->facts->terms] : equations->slope;
    return next;
}

/* A step of Gauss and Newton, halved until it leaves less; false: none does. */
static bool distortion_fit_improve(struct fit_equations *equations, struct arena *arena)
{
    const double before = distortion_fit_left_over(equations);
    double step[MODEL_TERMS + 1];
    distortion_fit_solve_linear(equations, true, arena, step);
    for (double share = 1; share > 1e-4; share /= 2) {
        /* Coefficients and slope by so much of a step more. */
        struct fit_equations next = *equations;
        const size_t terms = equations->facts->terms;
        for (size_t j = 0; j < terms; j++) {
            next.c[j] += share * step[j];
        }
        next.slope += equations->is_free ? share * step[terms] : 0;
        const double after = distortion_fit_left_over(&next);
        if (after < before) {
            *equations = next;
            return after < before * (1 - 1e-9);
        }
    }
    return false;
}

/* Polynomials at once; quotients from there, and from linear equations made from them. */
static void distortion_fit_solve(struct fit_equations *equations, struct arena *arena)
{
    enum { ROUNDS = 8, MOST = 200 };
    if (equations->facts->below == 0) {
        *equations = solved(equations, arena);
        return;
    }
    struct fit_equations next = *equations;
    for (int round = 0; round < ROUNDS; round++) {
        next = solved(&next, arena);
        if (distortion_fit_left_over(&next) < distortion_fit_left_over(equations)) {
            *equations = next;
        }
    }
    for (int step = 0; step < MOST && distortion_fit_improve(equations, arena); step++) {
    }
}

/* What the polynomial leaves of the heights it makes. */
static void fit_measure(const struct distortion_profile *profile, const struct distortion_fit *fit,
                        enum distortion_way way, struct distortion_polynomial *polynomial)
{
    double sum = 0, weight = 0;
    polynomial->largest = 0;
    for (size_t i = 0; i < profile->count; i++) {
        const double ideal = fit->focal * profile->ideal[i], real = profile->real[i];
        const double in = way == WAY_DISTORT ? ideal : real;
        const double out = way == WAY_DISTORT ? real : ideal;
        const double made =
            fit->unit * distortion_apply(fit->model, polynomial->reduced, in / fit->unit);
        sum += profile->weight[i] * (made - out) * (made - out);
        weight += profile->weight[i];
        polynomial->largest = fmax(polynomial->largest, fabs(made - out));
    }
    polynomial->rms = sqrt(sum / weight);
}

/* A free focal length is found by the first way, and is then that of the other. */
static bool fit_way(const struct distortion_profile *profile, const struct sensor *sensor,
                    enum distortion_way way, struct arena *arena, struct distortion_fit *fit,
                    struct error *error)
{
    const struct model_facts *facts = &distortion_models[fit->model];
    const bool is_free = isnan(fit->focal), distorts = way == WAY_DISTORT;
    double *product = ARENA_ARRAY(arena, profile->count, double);
    for (size_t i = 0; i < profile->count; i++) {
        product[i] = (is_free ? 1 : fit->focal) * profile->ideal[i];
    }
    const double *ideal = product;
    struct fit_equations equations = {.profile = profile,
                                      .facts = facts,
                                      .in = distorts ? ideal : profile->real,
                                      .out = distorts ? profile->real : ideal,
                                      .is_free = is_free,
                                      .slope = 1};
    if (is_free) {
        equations.slope = equations.out[0] / equations.in[0];
    }
    struct distortion_polynomial *polynomial = &fit->ways[way];
    distortion_fit_solve(&equations, arena);
    if (is_free) {
        fit->focal = distorts ? equations.slope : 1 / equations.slope;
    }
    /* The length of r = 1, mm. */
    const double units[] = {[UNIT_MILLIMETRE] = 1,
                            [UNIT_FOCAL] = fit->focal,
                            [UNIT_HALF_SIDE] = fmin(sensor->width, sensor->height) / 2};
    fit->unit = units[distortion_models[fit->model].unit];
    for (size_t j = 0; j < facts->terms; j++) {
        const bool below = is_below(facts, j);
        double mm = 1;
        if (is_free) { /* what was found of a focal length of 1 becomes mm */
            if (distorts) {
                mm = 1 / distortion_power(fit->focal, facts->powers[j]);
            } else if (!below) {
                mm = fit->focal;
            }
        }
        polynomial->reduced[j] =
            equations.c[j] * mm * distortion_power(fit->unit, facts->powers[j] - (below ? 0 : 1));
    }
    fit_measure(profile, fit, way, polynomial);
    return distortion_publish(fit->model, polynomial->reduced, polynomial->published) ||
           fail(error, ERROR_DOMAIN,
                "the distortion is too strong for {the fit} %s, which keeps the middle of the "
                "picture's longer sides in its place",
                facts->word.word);
}

bool distortion_fit(const struct distortion_profile *profile,
                    const struct distortion_question *question, struct arena *arena,
                    struct distortion_fit *fit, struct error *error)
{
    const enum distortion_way first = distortion_models[question->model].way;
    const enum distortion_way second = first == WAY_DISTORT ? WAY_UNDISTORT : WAY_DISTORT;
    *fit = (struct distortion_fit){.model = question->model, .focal = question->focal};
    return fit_way(profile, &question->sensor, first, arena, fit, error) &&
           fit_way(profile, &question->sensor, second, arena, fit, error);
}
