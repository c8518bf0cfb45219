/* design/fit/prescription.c - radii, gaps, indices that give a lens what was measured. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/prescription.h"

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
struct prescription_view {
    double *n;    /* count + 1, signed */
    double power; /* by which bfl and ffl are weighed, 1/mm */
};

/* A goal as a linear function of a system's matrix: a m.a + c m.c + d m.d + rest. */
struct prescription_aim {
    double a, c, d, rest;
};

struct prescription_problem {
    const struct lens *lens;
    const struct prescription_goal *goals;
    const struct prescription_part *parts;
    size_t goal_count, part_count, count; /* surfaces */
    struct prescription_view *views;      /* one a goal: indices of the lens as it is */
    double *start;                        /* of the parameters */
    double *c, *t, *n;                    /* of the present trial */
    struct matrix *before;                /* of each surface */
    struct solver_options options;
    bool is_loose;
};

static struct matrix prescription_times(struct matrix m, struct matrix k)
{
    return (struct matrix){m.a * k.a + m.b * k.c, m.a * k.b + m.b * k.d, m.c * k.a + m.d * k.c,
                           m.c * k.b + m.d * k.d};
}

static double prescription_power_of(const struct prescription_problem *fitting, size_t i)
{
    const struct surface *surface = &fitting->lens->surfaces[i];
    return surface_has(surface, SURFACE_HAS_FOCAL)
               ? 1 / surface->focal.value.hi
               : (fitting->n[i + 1] - fitting->n[i]) * fitting->c[i];
}

/* The last space of the medium behind a surface: that of the mirrors that stand in it. */
static size_t last_space(const struct prescription_problem *fitting, size_t surface)
{
    size_t i = surface + 1;
    while (i < fitting->count && surface_reflects(&fitting->lens->surfaces[i])) {
        i++;
    }
    return i;
}

/* The trial's curvatures, gaps and indices for one goal. */
static void set_trial(const struct prescription_problem *fitting, size_t goal,
                      const double *parameters)
{
    const struct lens *lens = fitting->lens;
    memcpy(fitting->n, fitting->views[goal].n, (fitting->count + 1) * sizeof(double));
    for (size_t i = 0; i < fitting->count; i++) {
        fitting->c[i] = surface_curvature(&lens->surfaces[i], SECTION_Y).hi;
        fitting->t[i] = i + 1 < fitting->count ? lens->surfaces[i].thickness.value.hi : 0;
    }
    for (size_t j = 0; j < fitting->part_count; j++) {
        size_t i = fitting->parts[j].what.surface;
        double change = parameters[j] - fitting->start[j];
        if (fitting->parts[j].what.kind == PARAMETER_RADIUS) {
            fitting->c[i] += change;
        } else if (fitting->parts[j].what.kind == PARAMETER_THICKNESS) {
            fitting->t[i] += change;
        } else {
            for (size_t k = i + 1; k <= last_space(fitting, i); k++) {
                fitting->n[k] += fitting->n[k] < 0 ? -change : change;
            }
        }
    }
}

/* The whole system; leaves what lies before each surface. */
static struct matrix prescription_trace(const struct prescription_problem *fitting)
{
    struct matrix m = {1, 0, 0, 1};
    for (size_t i = 0; i < fitting->count; i++) {
        const struct matrix refraction = {1, 0, -prescription_power_of(fitting, i), 1};
        const struct matrix transfer = {1, fitting->t[i] / fitting->n[i + 1], 0, 1};
        fitting->before[i] = m;
        m = prescription_times(transfer, prescription_times(refraction, m));
    }
    return m;
}

/* What lies behind the refraction at a surface is whole (before)^-1 (refraction)^-1. */
static struct matrix by_power(const struct prescription_problem *fitting, struct matrix whole,
                              size_t i)
{
    struct matrix k = fitting->before[i];
    const struct matrix inverse = {k.d, -k.b, -k.c, k.a};
    const struct matrix back = {1, 0, prescription_power_of(fitting, i), 1}, slope = {0, 0, -1, 0};
    return prescription_times(prescription_times(prescription_times(whole, inverse), back),
                              prescription_times(slope, k));
}

/* By t/n of the gap behind a surface. */
static struct matrix by_gap(const struct prescription_problem *fitting, struct matrix whole,
                            size_t i)
{
    const struct matrix refraction = {1, 0, -prescription_power_of(fitting, i), 1},
                        slope = {0, 1, 0, 0};
    struct matrix k = prescription_times(refraction, fitting->before[i]);
    const struct matrix inverse = {k.d, -k.b, -k.c, k.a};
    const struct matrix back = {1, -fitting->t[i] / fitting->n[i + 1], 0, 1};
    return prescription_times(prescription_times(prescription_times(whole, inverse), back),
                              prescription_times(slope, k));
}

static void prescription_add(struct matrix *sum, struct matrix m, double factor)
{
    sum->a += factor * m.a;
    sum->b += factor * m.b;
    sum->c += factor * m.c;
    sum->d += factor * m.d;
}

/* The derivative of the whole by one part. */
static struct matrix prescription_derive(const struct prescription_problem *fitting,
                                         struct matrix whole, const struct prescription_part *part)
{
    size_t i = part->what.surface;
    double n = fitting->n[i + 1];
    struct matrix sum = {0, 0, 0, 0};
    if (part->what.kind == PARAMETER_RADIUS) {
        prescription_add(&sum, by_power(fitting, whole, i), n - fitting->n[i]);
    } else if (part->what.kind == PARAMETER_THICKNESS) {
        prescription_add(&sum, by_gap(fitting, whole, i), 1 / n);
    } else {
        /* the index of a medium, in each of its spaces: k lies between surfaces k - 1 and k */
        for (size_t k = i + 1; k <= last_space(fitting, i); k++) {
            const double at = fitting->n[k], sign = at < 0 ? -1 : 1;
            prescription_add(&sum, by_power(fitting, whole, k - 1), sign * fitting->c[k - 1]);
            prescription_add(&sum, by_gap(fitting, whole, k - 1),
                             -sign * fitting->t[k - 1] / (at * at));
            if (k < fitting->count) {
                prescription_add(&sum, by_power(fitting, whole, k), -sign * fitting->c[k]);
            }
        }
    }
    return sum;
}

static double prescription_length_of(const struct prescription_problem *fitting)
{
    double sum = 0;
    for (size_t i = 0; i < fitting->count; i++) {
        const struct surface *surface = &fitting->lens->surfaces[i];
        sum += fitting->t[i];
        sum += surface_hiatus(surface).hi;
    }
    return sum;
}

/* The figure of a goal, mm. */
static double figure_value(const struct prescription_problem *fitting,
                           const struct prescription_goal *goal, struct matrix m)
{
    double n = fitting->n[0], last = fitting->n[fitting->count];
    switch (goal->kind) {
    case GOAL_BFL:
        return -last * m.a / m.c;
    case GOAL_FFL:
        return n * m.d / m.c;
    case GOAL_HEIGHT:
        return -n * tan(goal->field) / m.c;
    case GOAL_LENGTH:
        return prescription_length_of(fitting);
    case GOAL_EFL:
    case GOAL_KINDS:
        break;
    }
    return -1 / m.c;
}

/*
 * What is made 0: near the goal it is (figure - value)/deviation, but it has no poles, so that a
 * lens may pass through no power on its way, and no minimum where the power is endless.
 */
static struct prescription_aim prescription_aim_of(const struct prescription_problem *fitting,
                                                   size_t g)
{
    const struct prescription_goal *goal = &fitting->goals[g];
    double n = fitting->n[0], last = fitting->n[fitting->count], value = goal->value;
    double power = fitting->views[g].power, turned = n * tan(goal->field);
    switch (goal->kind) {
    case GOAL_BFL:
        return (struct prescription_aim){last / (power * goal->deviation),
                                         value / (power * goal->deviation), 0, 0};
    case GOAL_FFL:
        return (struct prescription_aim){0, value / (power * goal->deviation),
                                         -n / (power * goal->deviation), 0};
    case GOAL_HEIGHT:
        return (struct prescription_aim){0, value * value / (turned * goal->deviation), 0,
                                         value / goal->deviation};
    case GOAL_LENGTH:
        return (struct prescription_aim){
            0, 0, 0, (prescription_length_of(fitting) - value) / goal->deviation};
    case GOAL_EFL:
    case GOAL_KINDS:
        break;
    }
    return (struct prescription_aim){0, value * value / goal->deviation, 0,
                                     value / goal->deviation};
}

static double prescription_size_of(const struct prescription_problem *fitting, size_t part)
{
    double start = fabs(fitting->start[part]);
    return fitting->parts[part].what.kind == PARAMETER_RADIUS ? fmax(start, 1e-4)
                                                              : fmax(start, 0.1);
}

static bool prescription_evaluate(void *context, const double *parameters, double *residuals,
                                  double *jacobian)
{
    const struct prescription_problem *fitting = context;
    size_t columns = fitting->part_count;
    for (size_t g = 0; g < fitting->goal_count; g++) {
        const struct prescription_goal *goal = &fitting->goals[g];
        set_trial(fitting, g, parameters);
        struct matrix m = prescription_trace(fitting);
        const struct prescription_aim aim = prescription_aim_of(fitting, g);
        residuals[g] = aim.a * m.a + aim.c * m.c + aim.d * m.d + aim.rest;
        for (size_t j = 0; j < columns && jacobian != NULL; j++) {
            const struct prescription_part *part = &fitting->parts[j];
            struct matrix dm = prescription_derive(fitting, m, part);
            bool adds = goal->kind == GOAL_LENGTH && part->what.kind == PARAMETER_THICKNESS;
            jacobian[g * columns + j] =
                aim.a * dm.a + aim.c * dm.c + aim.d * dm.d + (adds ? 1 / goal->deviation : 0);
        }
    }
    for (size_t j = 0; j < columns && fitting->is_loose; j++) {
        size_t row = fitting->goal_count + j;
        residuals[row] =
            pull * (parameters[j] - fitting->start[j]) / prescription_size_of(fitting, j);
        for (size_t k = 0; k < columns && jacobian != NULL; k++) {
            jacobian[row * columns + k] = k == j ? pull / prescription_size_of(fitting, j) : 0;
        }
    }
    return true;
}

bool prescription_fits(enum parameter_kind kind)
{
    return kind == PARAMETER_RADIUS || kind == PARAMETER_THICKNESS || kind == PARAMETER_INDEX;
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
    bool through_plane = part->low > 0 && part->high < 0;
    if (!through_plane && (!(part->low * part->high > 0) || !(part->low < part->high))) {
        return fail(error, ERROR_DOMAIN,
                    "the bounds of radius %zu must both be of one sign, the lower first; [50,-60] "
                    "leads through a plane",
                    part->what.surface + 1);
    }
    *low = 1 / part->high;
    *high = 1 / part->low;
    return true;
}

static bool prescription_open_parts(struct prescription_problem *fitting, double *low, double *high,
                                    struct error *error)
{
    for (size_t j = 0; j < fitting->part_count; j++) {
        const struct prescription_part *part = &fitting->parts[j];
        const struct lens *lens = fitting->lens;
        const struct parameter_type *type = parameter_type(part->what.kind);
        const size_t number = part->what.surface + 1;
        const bool is_radius = part->what.kind == PARAMETER_RADIUS;
        if (!prescription_fits(part->what.kind)) {
            return fail(error, ERROR_DOMAIN, "no %s is fitted: only radii, thicknesses and indices",
                        type->words);
        }
        if ((type->is & PARAMETER_IS_BEHIND) != 0 && number == lens->surface_count) {
            return fail(error, ERROR_DOMAIN,
                        "there is no %s %zu to vary: the lens has %zu gaps between its surfaces",
                        type->words, number, lens->surface_count - 1);
        }
        if (!parameter_check(lens, part->what, error)) {
            return false;
        }
        const struct surface *surface = &lens->surfaces[part->what.surface];
        low[j] = part->low;
        high[j] = part->high;
        if (is_radius) {
            fitting->start[j] = surface_curvature(surface, SECTION_Y).hi;
        } else if (part->what.kind == PARAMETER_THICKNESS) {
            fitting->start[j] = surface->thickness.value.hi;
        } else {
            fitting->start[j] = fabs(fitting->views[0].n[number]);
        }
        if (is_radius && !curvature_bounds(part, &low[j], &high[j], error)) {
            return false;
        }
        if (!(low[j] <= fitting->start[j] && fitting->start[j] <= high[j])) {
            double shown = is_radius ? 1 / fitting->start[j] : fitting->start[j];
            return fail(error, ERROR_DOMAIN,
                        "the %.10g of surface %zu lies outside its bounds %.10g to %.10g", shown,
                        part->what.surface + 1, part->low, part->high);
        }
    }
    return true;
}

/* The power that a goal is weighed by at first: what another goal wants, or what the lens has. */
static double first_power(const struct prescription_problem *fitting, size_t g)
{
    double longest = 1;
    for (size_t i = 0; i < fitting->goal_count; i++) {
        const struct prescription_goal *goal = &fitting->goals[i];
        if (goal->kind == GOAL_EFL || goal->kind == GOAL_HEIGHT) {
            double turned = goal->kind == GOAL_EFL ? 1 : fitting->views[i].n[0] * tan(goal->field);
            return turned / goal->value;
        }
        longest = fmax(longest, fabs(goal->value));
    }
    set_trial(fitting, g, fitting->start);
    double power = -prescription_trace(fitting).c;
    /* a lens without power begins somewhere */
    return fabs(power) > 1e-3 / longest ? power : 1 / longest;
}

/* A few rounds: the weights of bfl and ffl follow the power of the lens that is found. */
static bool prescription_solve(struct prescription_problem *fitting,
                               const struct solver_problem *problem, double *parameters,
                               struct arena *arena, struct prescription_fit *fit,
                               struct error *error)
{
    for (size_t g = 0; g < fitting->goal_count; g++) {
        fitting->views[g].power = first_power(fitting, g);
    }
    struct solver_options options = fitting->options;
    options.engine = SOLVER_CERES;
    for (int round = 0; round < 20; round++) {
        if (!solver_run(problem, &options, parameters, arena, &fit->summary, error)) {
            return false;
        }
        /* weigh by the power that was found */
        bool changes = false;
        for (size_t g = 0; g < fitting->goal_count; g++) {
            const enum goal_kind kind = fitting->goals[g].kind;
            set_trial(fitting, g, parameters);
            const double power = -prescription_trace(fitting).c;
            if ((kind == GOAL_BFL || kind == GOAL_FFL) && fabs(power) > 0) {
                changes = changes || fabs(power / fitting->views[g].power - 1) > 1e-9;
                fitting->views[g].power = power;
            }
        }
        if (fit->summary.status == SOLVER_STOPPED || !changes) {
            break;
        }
    }
    return true;
}

static void prescription_set_result(struct prescription_problem *fitting, const double *parameters,
                                    struct prescription_fit *fit)
{
    for (size_t j = 0; j < fitting->part_count; j++) {
        bool radius = fitting->parts[j].what.kind == PARAMETER_RADIUS;
        double p = parameters[j], error = fit->summary.standard_error[j];
        fit->before[j] = radius ? 1 / fitting->start[j] : fitting->start[j];
        fit->values[j] = radius ? 1 / p : p;
        if (radius && fit->summary.at_bound[j] && fabs(fitting->parts[j].low) < INFINITY) {
            /* 1/(1/R) may be off by a bit, and outside */
            fit->values[j] =
                fmin(fmax(fit->values[j], fitting->parts[j].low), fitting->parts[j].high);
        }
        if (fit->is_loose) {
            fit->errors[j] = NAN;
        } else if (radius) {
            fit->errors[j] = error / (p * p);
        } else {
            fit->errors[j] = error;
        }
    }
    for (size_t g = 0; g < fitting->goal_count; g++) {
        set_trial(fitting, g, parameters);
        fit->reached[g] = figure_value(fitting, &fitting->goals[g], prescription_trace(fitting));
    }
}

bool prescription_fit(const struct lens *lens, const struct prescription_task *task,
                      struct arena *arena, struct prescription_fit *fit, struct error *error)
{
    size_t count = lens->surface_count, goal_count = task->goal_count;
    size_t part_count = task->part_count;
    struct prescription_problem fitting = {.lens = lens,
                                           .goals = task->goals,
                                           .parts = task->parts,
                                           .goal_count = goal_count,
                                           .part_count = part_count,
                                           .count = count,
                                           .options = task->options,
                                           .is_loose = goal_count < part_count};
    if (goal_count == 0 || part_count == 0) {
        return fail(error, ERROR_DOMAIN,
                    goal_count == 0 ? "nothing was measured: no goals"
                                    : "nothing may change: no R, t or n");
    }
    for (size_t g = 0; g < goal_count; g++) {
        const struct prescription_goal *goal = &task->goals[g];
        bool height = goal->kind == GOAL_HEIGHT;
        if (height && !(fabs(tan(goal->field)) > 0)) {
            return fail(error, ERROR_DOMAIN,
                        "the height of an image on the axis is 0 for every lens");
        }
        if ((height || goal->kind == GOAL_EFL) && !(fabs(goal->value) > 0)) {
            return fail(error, ERROR_DOMAIN, "no lens has %s of 0 mm: its power is endless",
                        height ? "an image height" : "a focal length");
        }
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
    fitting.views = ARENA_ARRAY(arena, fitting.goal_count, struct prescription_view);
    for (size_t g = 0; g < fitting.goal_count; g++) {
        struct paraxial_system system;
        if (!paraxial_compile(fitting.lens, fitting.goals[g].wavelength, SECTION_Y, arena, &system,
                              error)) {
            return false;
        }
        fitting.views[g].n = ARENA_ARRAY(arena, fitting.count + 1, double);
        for (size_t i = 0; i <= fitting.count; i++) {
            fitting.views[g].n[i] = system.index[i].hi;
        }
    }
    if (!prescription_open_parts(&fitting, low, high, error)) {
        return false;
    }
    memcpy(parameters, fitting.start, part_count * sizeof(double));
    const struct solver_problem problem = {.parameter_count = part_count,
                                           .residual_count =
                                               goal_count + (fitting.is_loose ? part_count : 0),
                                           .evaluate = prescription_evaluate,
                                           .context = &fitting,
                                           .low = low,
                                           .high = high};
    if (!prescription_solve(&fitting, &problem, parameters, arena, fit, error)) {
        return false;
    }
    prescription_set_result(&fitting, parameters, fit);
    return true;
}

struct lens prescription_apply(const struct lens *lens, const struct prescription_part *parts,
                               size_t part_count, const struct prescription_fit *fit,
                               struct arena *arena)
{
    struct lens *all = parameter_apply(lens, NULL, NULL, 0, arena);
    for (size_t j = 0; j < part_count; j++) {
        const struct surface *surface = &all->surfaces[parts[j].what.surface];
        double value = fit->values[j];
        if (parts[j].what.kind == PARAMETER_RADIUS) {
            value = 1 / (1 / value - 2 * surface->coefficient[0].value.hi);
        } else if (parts[j].what.kind == PARAMETER_INDEX) {
            /* that at the primary wavelength is not that at the goal's */
            value = pair_add(surface->medium.index, pair_of(value - fit->before[j])).hi;
        }
        parameter_set(all, parts[j].what, value, arena);
    }
    return *all;
}
