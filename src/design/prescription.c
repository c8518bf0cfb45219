/* design/prescription.c - radii, gaps, indices that give a lens what was measured. */
/* SPDX-License-Identifier: MIT */
#include "design/prescription.h"

#include "optics/paraxial.h"

#include <math.h>
#include <string.h>

/* Pull towards the start where the goals leave parts open, in shares of each part. */
static const double pull = 1e-6;

/* [y'; v'] = [[a, b], [c, d]] [y; v] */
struct matrix {
    double a, b, c, d;
};

/* The lens at the wavelength of one goal, as plain numbers. */
struct view {
    double *n; /* count + 1, signed */
};

struct fitting {
    const struct lens *lens;
    const struct prescription_goal *goals;
    const struct prescription_part *parts;
    size_t goal_count, part_count, count; /* surfaces */
    struct view *views;                   /* one a goal: indices of the lens as it is */
    double *start;                        /* of the parameters */
    double *c, *t, *n;                    /* of the present trial */
    struct matrix *before;                /* of each surface */
    bool is_loose;
};

static struct matrix times(struct matrix m, struct matrix k)
{
    return (struct matrix){m.a * k.a + m.b * k.c, m.a * k.b + m.b * k.d, m.c * k.a + m.d * k.c,
                           m.c * k.b + m.d * k.d};
}

static double power_of(const struct fitting *fitting, size_t i)
{
    const struct surface *surface = &fitting->lens->surfaces[i];
    return surface->kind == SURFACE_THICK ? 1 / surface->focal.value.hi
                                          : (fitting->n[i + 1] - fitting->n[i]) * fitting->c[i];
}

/* The trial's curvatures, gaps and indices for one goal. */
static void set_trial(const struct fitting *fitting, size_t goal, const double *parameters)
{
    const struct lens *lens = fitting->lens;
    memcpy(fitting->n, fitting->views[goal].n, (fitting->count + 1) * sizeof(double));
    for (size_t i = 0; i < fitting->count; i++) {
        fitting->c[i] = surface_curvature(&lens->surfaces[i], SECTION_Y).hi;
        fitting->t[i] = i + 1 < fitting->count ? lens->surfaces[i].thickness.value.hi : 0;
    }
    for (size_t j = 0; j < fitting->part_count; j++) {
        size_t i = fitting->parts[j].surface;
        double change = parameters[j] - fitting->start[j];
        if (fitting->parts[j].kind == PART_RADIUS) {
            fitting->c[i] += change;
        } else if (fitting->parts[j].kind == PART_GAP) {
            fitting->t[i] += change;
        } else {
            fitting->n[i + 1] += fitting->n[i + 1] < 0 ? -change : change;
        }
    }
}

/* The whole system; leaves what lies before each surface. */
static struct matrix trace(const struct fitting *fitting)
{
    struct matrix m = {1, 0, 0, 1};
    for (size_t i = 0; i < fitting->count; i++) {
        const struct matrix refraction = {1, 0, -power_of(fitting, i), 1};
        const struct matrix transfer = {1, fitting->t[i] / fitting->n[i + 1], 0, 1};
        fitting->before[i] = m;
        m = times(transfer, times(refraction, m));
    }
    return m;
}

/* What lies behind the refraction at a surface is whole (before)^-1 (refraction)^-1. */
static struct matrix by_power(const struct fitting *fitting, struct matrix whole, size_t i)
{
    struct matrix k = fitting->before[i];
    const struct matrix inverse = {k.d, -k.b, -k.c, k.a};
    const struct matrix back = {1, 0, power_of(fitting, i), 1}, slope = {0, 0, -1, 0};
    return times(times(times(whole, inverse), back), times(slope, k));
}

/* By t/n of the gap behind a surface. */
static struct matrix by_gap(const struct fitting *fitting, struct matrix whole, size_t i)
{
    const struct matrix refraction = {1, 0, -power_of(fitting, i), 1}, slope = {0, 1, 0, 0};
    struct matrix k = times(refraction, fitting->before[i]);
    const struct matrix inverse = {k.d, -k.b, -k.c, k.a};
    const struct matrix back = {1, -fitting->t[i] / fitting->n[i + 1], 0, 1};
    return times(times(times(whole, inverse), back), times(slope, k));
}

static void add(struct matrix *sum, struct matrix m, double factor)
{
    sum->a += factor * m.a;
    sum->b += factor * m.b;
    sum->c += factor * m.c;
    sum->d += factor * m.d;
}

/* The derivative of the whole by one part. */
static struct matrix derive(const struct fitting *fitting, struct matrix whole,
                            const struct prescription_part *part)
{
    size_t i = part->surface;
    double n = fitting->n[i + 1], sign = n < 0 ? -1 : 1;
    struct matrix sum = {0, 0, 0, 0};
    if (part->kind == PART_RADIUS) {
        add(&sum, by_power(fitting, whole, i), n - fitting->n[i]);
    } else if (part->kind == PART_GAP) {
        add(&sum, by_gap(fitting, whole, i), 1 / n);
    } else {
        add(&sum, by_power(fitting, whole, i), sign * fitting->c[i]);
        add(&sum, by_power(fitting, whole, i + 1), -sign * fitting->c[i + 1]);
        add(&sum, by_gap(fitting, whole, i), -sign * fitting->t[i] / (n * n));
    }
    return sum;
}

/* The figure of a goal; with dm its derivative by what dm is by. */
static double figure_value(const struct fitting *fitting, const struct prescription_goal *goal,
                           struct matrix m)
{
    double n = fitting->n[0], last = fitting->n[fitting->count], sum = 0;
    switch (goal->kind) {
    case GOAL_BFL:
        return -last * m.a / m.c;
    case GOAL_FFL:
        return n * m.d / m.c;
    case GOAL_HEIGHT:
        return -n * tan(goal->field) / m.c;
    case GOAL_LENGTH:
        for (size_t i = 0; i < fitting->count; i++) {
            const struct surface *surface = &fitting->lens->surfaces[i];
            sum += fitting->t[i];
            sum += surface->kind == SURFACE_THICK ? surface->hiatus.value.hi : 0;
        }
        return sum;
    case GOAL_EFL:
    case GOAL_KINDS:
        break;
    }
    return -1 / m.c;
}

static double figure_slope(const struct fitting *fitting, const struct prescription_goal *goal,
                           struct matrix m, struct matrix dm, const struct prescription_part *part)
{
    double n = fitting->n[0], last = fitting->n[fitting->count], square = m.c * m.c;
    switch (goal->kind) {
    case GOAL_BFL:
        return -last * (dm.a * m.c - m.a * dm.c) / square;
    case GOAL_FFL:
        return n * (dm.d * m.c - m.d * dm.c) / square;
    case GOAL_HEIGHT:
        return n * tan(goal->field) * dm.c / square;
    case GOAL_LENGTH:
        return part->kind == PART_GAP ? 1 : 0;
    case GOAL_EFL:
    case GOAL_KINDS:
        break;
    }
    return dm.c / square;
}

static double size_of(const struct fitting *fitting, size_t part)
{
    double start = fabs(fitting->start[part]);
    return fitting->parts[part].kind == PART_RADIUS ? fmax(start, 1e-4) : fmax(start, 0.1);
}

static bool evaluate(void *context, const double *parameters, double *residuals, double *jacobian)
{
    const struct fitting *fitting = context;
    size_t columns = fitting->part_count;
    for (size_t g = 0; g < fitting->goal_count; g++) {
        const struct prescription_goal *goal = &fitting->goals[g];
        set_trial(fitting, g, parameters);
        struct matrix m = trace(fitting);
        residuals[g] = (figure_value(fitting, goal, m) - goal->value) / goal->deviation;
        for (size_t j = 0; j < columns && jacobian != NULL; j++) {
            const struct prescription_part *part = &fitting->parts[j];
            struct matrix dm = derive(fitting, m, part);
            jacobian[g * columns + j] = figure_slope(fitting, goal, m, dm, part) / goal->deviation;
        }
    }
    for (size_t j = 0; j < columns && fitting->is_loose; j++) {
        size_t row = fitting->goal_count + j;
        residuals[row] = pull * (parameters[j] - fitting->start[j]) / size_of(fitting, j);
        for (size_t k = 0; k < columns && jacobian != NULL; k++) {
            jacobian[row * columns + k] = k == j ? pull / size_of(fitting, j) : 0;
        }
    }
    return true;
}

static bool check_part(const struct lens *lens, const struct prescription_part *part,
                       struct error *error)
{
    size_t number = part->surface + 1, count = lens->surface_count;
    const struct surface *surface = &lens->surfaces[part->surface < count ? part->surface : 0];
    if (part->surface >= count || (part->kind != PART_RADIUS && number >= count)) {
        return fail(error, ERROR_DOMAIN,
                    "there is no %s %zu to vary: the lens has %zu surfaces, and %zu gaps between "
                    "them",
                    part->kind == PART_RADIUS ? "radius"
                    : part->kind == PART_GAP  ? "gap"
                                              : "index",
                    number, count, count - 1);
    }
    if (part->kind == PART_RADIUS &&
        (surface->kind == SURFACE_STOP || surface->kind == SURFACE_THICK)) {
        return fail(error, ERROR_DOMAIN, "surface %zu has no radius to vary", number);
    }
    bool number_medium =
        surface->medium.kind == MEDIUM_CONSTANT || surface->medium.kind == MEDIUM_MODEL;
    if (part->kind == PART_INDEX && (!number_medium || surface->kind == SURFACE_REFLECT)) {
        return fail(error, ERROR_DOMAIN,
                    "the medium %.*s after surface %zu has no index of its own to vary: only a "
                    "number or nd/Vd has",
                    (int)surface->medium.written.length, surface->medium.written.start, number);
    }
    return true;
}

/* Bounds of a radius as those of the curvature. */
static bool curvature_bounds(const struct prescription_part *part, double *low, double *high,
                             struct error *error)
{
    bool has_low = isfinite(part->low), has_high = isfinite(part->high);
    *low = -INFINITY;
    *high = INFINITY;
    if (!has_low && !has_high) {
        return true;
    }
    if (!has_low || !has_high || !(part->low * part->high > 0) || !(part->low < part->high)) {
        return fail(error, ERROR_DOMAIN,
                    "the bounds of radius %zu must both be of one sign, the lower first",
                    part->surface + 1);
    }
    *low = 1 / part->high;
    *high = 1 / part->low;
    return true;
}

static double start_of(const struct fitting *fitting, size_t part)
{
    size_t i = fitting->parts[part].surface;
    const struct surface *surface = &fitting->lens->surfaces[i];
    return fitting->parts[part].kind == PART_RADIUS ? surface_curvature(surface, SECTION_Y).hi
           : fitting->parts[part].kind == PART_GAP  ? surface->thickness.value.hi
                                                    : fabs(fitting->views[0].n[i + 1]);
}

static bool open_views(struct fitting *fitting, struct arena *arena, struct error *error)
{
    fitting->views = ARENA_ARRAY(arena, fitting->goal_count, struct view);
    for (size_t g = 0; g < fitting->goal_count; g++) {
        struct paraxial_system system;
        if (!paraxial_compile(fitting->lens, fitting->goals[g].wavelength, SECTION_Y, arena,
                              &system, error)) {
            return false;
        }
        fitting->views[g].n = ARENA_ARRAY(arena, fitting->count + 1, double);
        for (size_t i = 0; i <= fitting->count; i++) {
            fitting->views[g].n[i] = system.index[i].hi;
        }
    }
    return true;
}

static bool open_parts(struct fitting *fitting, double *low, double *high, struct error *error)
{
    for (size_t j = 0; j < fitting->part_count; j++) {
        const struct prescription_part *part = &fitting->parts[j];
        if (!check_part(fitting->lens, part, error)) {
            return false;
        }
        fitting->start[j] = start_of(fitting, j);
        low[j] = part->low;
        high[j] = part->high;
        if (part->kind == PART_RADIUS && !curvature_bounds(part, &low[j], &high[j], error)) {
            return false;
        }
        if (!(low[j] <= fitting->start[j] && fitting->start[j] <= high[j])) {
            double shown = part->kind == PART_RADIUS ? 1 / fitting->start[j] : fitting->start[j];
            return fail(error, ERROR_DOMAIN,
                        "the %.10g of surface %zu lies outside its bounds %.10g to %.10g", shown,
                        part->surface + 1, part->low, part->high);
        }
    }
    return true;
}

static void set_result(struct fitting *fitting, const double *parameters,
                       struct prescription_fit *fit)
{
    for (size_t j = 0; j < fitting->part_count; j++) {
        bool radius = fitting->parts[j].kind == PART_RADIUS;
        double p = parameters[j], error = fit->summary.standard_error[j];
        fit->before[j] = radius ? 1 / fitting->start[j] : fitting->start[j];
        fit->values[j] = radius ? 1 / p : p;
        fit->errors[j] = fit->is_loose ? NAN : radius ? error / (p * p) : error;
    }
    for (size_t g = 0; g < fitting->goal_count; g++) {
        set_trial(fitting, g, parameters);
        fit->reached[g] = figure_value(fitting, &fitting->goals[g], trace(fitting));
    }
}

bool prescription_fit(const struct lens *lens, const struct prescription_goal *goals,
                      size_t goal_count, const struct prescription_part *parts, size_t part_count,
                      struct arena *arena, struct prescription_fit *fit, struct error *error)
{
    size_t count = lens->surface_count;
    struct fitting fitting = {.lens = lens,
                              .goals = goals,
                              .parts = parts,
                              .goal_count = goal_count,
                              .part_count = part_count,
                              .count = count,
                              .is_loose = goal_count < part_count};
    if (goal_count == 0 || part_count == 0) {
        return fail(error, ERROR_DOMAIN,
                    goal_count == 0 ? "nothing was measured: no goals"
                                    : "nothing may change: no R, t or n");
    }
    fitting.start = ARENA_ARRAY(arena, part_count, double);
    fitting.c = ARENA_ARRAY(arena, count, double);
    fitting.t = ARENA_ARRAY(arena, count, double);
    fitting.n = ARENA_ARRAY(arena, count + 1, double);
    fitting.before = ARENA_ARRAY(arena, count, struct matrix);
    double *low = ARENA_ARRAY(arena, part_count, double);
    double *high = ARENA_ARRAY(arena, part_count, double);
    double *parameters = ARENA_ARRAY(arena, part_count, double);
    *fit = (struct prescription_fit){.values = ARENA_ARRAY(arena, part_count, double),
                                     .errors = ARENA_ARRAY(arena, part_count, double),
                                     .before = ARENA_ARRAY(arena, part_count, double),
                                     .reached = ARENA_ARRAY(arena, goal_count, double),
                                     .is_loose = fitting.is_loose};
    if (!open_views(&fitting, arena, error) || !open_parts(&fitting, low, high, error)) {
        return false;
    }
    memcpy(parameters, fitting.start, part_count * sizeof(double));
    const struct solver_problem problem = {.parameter_count = part_count,
                                           .residual_count =
                                               goal_count + (fitting.is_loose ? part_count : 0),
                                           .evaluate = evaluate,
                                           .context = &fitting,
                                           .low = low,
                                           .high = high};
    if (!solver_run(&problem, NULL, parameters, arena, &fit->summary, error)) {
        return false;
    }
    set_result(&fitting, parameters, fit);
    return true;
}

/* A medium whose index is another one. */
static struct medium medium_with(const struct medium *medium, double change, struct arena *arena)
{
    struct medium all = *medium;
    all.index = pair_add(medium->index, pair_of(change));
    all.index = pair_of(all.index.hi);
    char index[NUMBER_LENGTH], abbe[NUMBER_LENGTH];
    char *end = number_write_shortest(index, all.index.hi);
    char *abbe_end = number_write_shortest(abbe, medium->abbe.hi);
    all.written = text_of(medium->kind == MEDIUM_MODEL
                              ? arena_printf(arena, "%.*s/%.*s", (int)(end - index), index,
                                             (int)(abbe_end - abbe), abbe)
                              : arena_printf(arena, "%.*s", (int)(end - index), index));
    return all;
}

struct lens prescription_apply(const struct lens *lens, const struct prescription_part *parts,
                               size_t part_count, const struct prescription_fit *fit,
                               struct arena *arena)
{
    struct lens all = *lens;
    all.surfaces = ARENA_ARRAY(arena, lens->surface_count, struct surface);
    memcpy(all.surfaces, lens->surfaces, lens->surface_count * sizeof(struct surface));
    for (size_t j = 0; j < part_count; j++) {
        struct surface *surface = &all.surfaces[parts[j].surface];
        const struct figure figure = {{fit->values[j], 0}, {NULL, 0}, LENS_NONE};
        if (parts[j].kind == PART_GAP) {
            surface->thickness = figure;
        } else if (parts[j].kind == PART_INDEX) {
            surface->medium = medium_with(&surface->medium, fit->values[j] - fit->before[j], arena);
        } else {
            /* 2 A2 is a part of the curvature that stays */
            double a2 = 2 * surface->coefficient[0].value.hi, c = 1 / fit->values[j] - a2;
            surface->has_curvature = false;
            surface->is_plane = !(fabs(c) > 0);
            surface->radius = (struct figure){{1 / c, 0}, {NULL, 0}, LENS_NONE};
        }
    }
    return all;
}
