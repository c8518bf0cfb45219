/* design/solver/solver_dls.c - damped least squares, the classic of lens design. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_engine.h"
#include "design/solver/solver_loss.h"
#include "design/solver/solver_normal.h"
#include "design/solver/solver_step.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Residuals at some parameters, and what is made of them. */
struct place {
    double *parameters, *residuals;
    double cost;   /* half the sum of rho */
    double excess; /* sum of the exact residuals' sizes */
};

/* A descent; parameters are measured in their scales. */
struct descent {
    struct engine_run *run;
    const struct solver_problem *problem;
    size_t n, squares, exact;
    struct place here, there;
    double *jacobian, *weights; /* here */
    double *scale;
    double *normal, *rest;     /* here, of all but what counts on one side only */
    double *gradient, *slopes; /* here; slopes are those of the exact residuals */
    double *diagonal;          /* what the damping is multiplied with */
    double damping, growth;
    double first_cost; /* at the start */
    double price;      /* of the exact residuals against the cost */
    double share;      /* of the exact residuals that a step takes off: less after steps too far */
    double *damped, *low, *high, *move, *none, *before, *wanted;
    double *second, *straight; /* residuals' second derivatives along a step, and that step */
    enum step_side *sides;     /* its sides */
    double *room;              /* of the normal equations */
    struct solver_sided sided;
    struct solver_step step;
    int steady; /* steps in succession that changed next to nothing */
};

/* Exact residuals are met as exactly as anybody asks. */
#define DESCENT_MET 1e-12

/* What a parameter is measured in. */
static inline double descent_scale(const struct descent *descent, size_t i)
{
    return isfinite(descent->scale[i]) ? descent->scale[i] : 1;
}

/*
 * Second-order damping: the damping of a parameter follows the second derivatives of the residuals
 * by it, as the change of the gradient tells that the normal equations do not explain; a share of
 * each step's goes into the mean. At first all are alike in natural scales.
 */
static const double newest = 0.2, first_diagonal = 3e-4, first_damping = 1e-5;

/* Of parameters without scales, which are damped as their derivatives are large. */
static const double plain_damping = 1e-3;

/* A parameter that moved less than this share of the one that moved most tells little. */
static const double least_move = 0.01;

/* Residuals of a place, and derivatives where they are wanted. Result: false: it has no value */
static bool descent_measure(struct descent *descent, struct place *place, double *jacobian)
{
    const struct solver_problem *problem = descent->problem;
    descent->run->evaluations++;
    descent->run->derivatives += jacobian != NULL;
    place->cost = place->excess = NAN;
    if (!problem->evaluate(problem->context, place->parameters, place->residuals, jacobian)) {
        return false;
    }
    place->cost =
        solver_cost(problem, place->residuals, jacobian != NULL ? descent->weights : NULL);
    for (size_t k = 0; k < descent->sided.count && jacobian != NULL; k++) {
        descent->weights[descent->sided.at[k]] = 0; /* they are added by themselves */
    }
    place->excess = 0;
    for (size_t i = 0; i < descent->exact; i++) {
        place->excess += fabs(place->residuals[descent->squares + i]);
    }
    return isfinite(place->cost) && isfinite(place->excess);
}

/* What the descent makes small. */
static double descent_height(const struct descent *descent, const struct place *place)
{
    return place->cost + descent->price * (place->excess > DESCENT_MET ? place->excess : 0);
}

/* Derivatives here times residuals there. */
static struct solver_rows solver_descent_rows_of(const struct descent *descent,
                                                 const double *residuals)
{
    return (struct solver_rows){
        .rows = descent->squares,
        .columns = descent->n,
        .jacobian = descent->jacobian,
        .residuals = residuals,
        .room = descent->room,
        .weights =
            descent->problem->blocks != NULL || descent->sided.count > 0 ? descent->weights : NULL};
}

/* What follows from residuals and derivatives here. */
static void descent_set_equations(struct descent *descent)
{
    const size_t n = descent->n;
    const struct solver_rows rows = solver_descent_rows_of(descent, descent->here.residuals);
    solver_normal(&rows, descent->normal, descent->rest);
    /* Without natural scales a parameter is measured by the largest effect that it had so far. */
    for (size_t i = 0; i < n && descent->problem->scale == NULL; i++) {
        const double effect = sqrt(descent->normal[i * n + i]);
        descent->scale[i] = effect > 0 ? fmin(descent->scale[i], 1 / effect) : descent->scale[i];
    }
    for (size_t i = 0; i < descent->sided.count * n; i++) {
        const size_t from = descent->sided.at[i / n] * n + i % n;
        descent->sided.slopes[i] = descent->jacobian[from] * descent_scale(descent, i % n);
    }
    for (size_t i = 0; i < n; i++) {
        descent->rest[i] *= descent_scale(descent, i);
        for (size_t j = 0; j < n; j++) {
            descent->normal[i * n + j] *= descent_scale(descent, i) * descent_scale(descent, j);
        }
    }
    memcpy(descent->gradient, descent->rest, n * sizeof(double));
    solver_sided_pull(&descent->sided, descent->here.residuals, descent->gradient);
    for (size_t r = 0; r < descent->exact; r++) {
        for (size_t j = 0; j < n; j++) {
            descent->slopes[r * n + j] =
                descent->jacobian[(descent->squares + r) * n + j] * descent_scale(descent, j);
        }
    }
}

/* The pull of the exact residuals, by their multipliers, on top of a gradient. */
static void add_pull(const struct descent *descent, double *gradient)
{
    for (size_t i = 0; i < descent->n; i++) {
        for (size_t r = 0; r < descent->exact; r++) {
            gradient[i] += descent->step.multipliers[r] * descent->slopes[r * descent->n + i];
        }
    }
}

/* The gradient that residuals there would have with the derivatives here. */
static void descent_carry(const struct descent *descent, const double *residuals, double *into)
{
    const struct solver_rows rows = solver_descent_rows_of(descent, residuals);
    solver_normal(&rows, NULL, into);
    for (size_t i = 0; i < descent->n; i++) {
        into[i] *= descent_scale(descent, i);
    }
    solver_sided_pull(&descent->sided, residuals, into);
    add_pull(descent, into);
}

/*
 * Second derivatives by each parameter.
 *
 * Given     explained  the gradient here as descent_carry has it from before the step
 *           from       the parameters before it
 */
static void descent_learn(struct descent *descent, const double *explained, const double *from)
{
    double most = 0;
    for (size_t i = 0; i < descent->n; i++) {
        descent->move[i] = (descent->here.parameters[i] - from[i]) / descent_scale(descent, i);
        most = fmax(most, fabs(descent->move[i]));
    }
    const double little = least_move * most;
    memcpy(descent->none, descent->gradient, descent->n * sizeof(double));
    add_pull(descent, descent->none);
    for (size_t i = 0; i < descent->n; i++) {
        const double moved = descent->move[i], change = descent->none[i] - explained[i];
        const double second = fabs(change * moved) / (moved * moved + little * little);
        if (isfinite(second)) {
            descent->diagonal[i] += newest * (second - descent->diagonal[i]);
        }
    }
    memset(descent->none, 0, descent->n * sizeof(double));
}

/* Room, of the problem of a run. */
static void descent_open(struct descent *descent, struct arena *arena)
{
    const size_t n = descent->n, m = descent->squares + descent->exact;
    double **const of_parameters[] = {&descent->here.parameters,
                                      &descent->there.parameters,
                                      &descent->scale,
                                      &descent->rest,
                                      &descent->gradient,
                                      &descent->diagonal,
                                      &descent->low,
                                      &descent->high,
                                      &descent->none,
                                      &descent->before,
                                      &descent->straight};
    double **const of_residuals[] = {&descent->here.residuals, &descent->there.residuals,
                                     &descent->weights, &descent->second};
    for (size_t i = 0; i < sizeof of_parameters / sizeof of_parameters[0]; i++) {
        *of_parameters[i] = ARENA_ARRAY(arena, n, double);
    }
    for (size_t i = 0; i < sizeof of_residuals / sizeof of_residuals[0]; i++) {
        *of_residuals[i] = ARENA_ARRAY(arena, m + 1, double);
    }
    descent->jacobian = ARENA_ARRAY(arena, m * n, double);
    descent->normal = ARENA_ARRAY(arena, n * n, double);
    descent->damped = ARENA_ARRAY(arena, n * n, double);
    descent->slopes = ARENA_ARRAY(arena, descent->exact * n + 1, double);
    descent->move = ARENA_ARRAY(arena, n + descent->exact, double);
    descent->wanted = ARENA_ARRAY(arena, descent->exact + 1, double);
    descent->sides = ARENA_ARRAY(arena, n, enum step_side);
    solver_sided_open(descent->problem, arena, &descent->sided);
    descent->room = solver_normal_room(n, arena);
    solver_step_open(&descent->step, n, descent->exact, arena);
    descent->step.low = descent->low;
    descent->step.high = descent->high;
    descent->step.slopes = descent->slopes;
}

/* A share of the step, behind which the second derivative along it is looked for. */
static const double probe = 0.1;

/* What the step may bend by, of its own length. */
static const double most_bend = 0.75;

static double length(const struct descent *descent, const double *d)
{
    double sum = 0;
    for (size_t i = 0; i < descent->n; i++) {
        sum += d[i] * d[i] * descent->diagonal[i];
    }
    return sqrt(sum);
}

/*
 * Bend the step that was found, which leads straight from here.
 *
 * Formula   d + a/2 with (J^T J + l D) a = -J^T r'', r'' the second derivative along d from the
 *           residuals at a tenth of it; not where a is long against d
 * Source    [Transtrum11] (geodesic acceleration)
 */
static void descent_bend(struct descent *descent)
{
    const size_t n = descent->n;
    struct solver_step *step = &descent->step;
    double *d = descent->straight;
    memcpy(d, step->d, n * sizeof *d);
    memcpy(descent->sides, step->side, n * sizeof *descent->sides);
    for (size_t i = 0; i < n; i++) {
        descent->there.parameters[i] =
            descent->here.parameters[i] + probe * d[i] * descent_scale(descent, i);
    }
    if (!descent_measure(descent, &descent->there, NULL)) {
        return;
    }
    /* r'' along the step d, from r there: 2/h ((r(h d) - r)/h - J d). */
    for (size_t k = 0; k < descent->squares; k++) {
        const double *row = descent->jacobian + k * n;
        double along = 0;
        for (size_t j = 0; j < n; j++) {
            along += row[j] * descent_scale(descent, j) * d[j];
        }
        const double change = descent->there.residuals[k] - descent->here.residuals[k];
        descent->second[k] = 2 / probe * (change / probe - along);
    }
    for (size_t k = 0; k < descent->sided.count; k++) {
        descent->second[descent->sided.at[k]] = 0; /* straight, as far as the step goes */
    }
    /* the bend a within bounds that leave d + a/2 in those of d; who is on a bound stays there */
    for (size_t i = 0; i < descent->n; i++) {
        const bool is_held = step->side[i] != STEP_FREE;
        descent->low[i] = is_held ? 0 : 2 * (descent->low[i] - d[i]);
        descent->high[i] = is_held ? 0 : 2 * (descent->high[i] - d[i]);
    }
    descent_carry(descent, descent->second, descent->before);
    step->g = descent->before;
    const bool found = solver_step_find(step);
    const bool bends = found && 2 * length(descent, step->d) <= most_bend * length(descent, d);
    for (size_t i = 0; i < n; i++) {
        step->d[i] = d[i] + (bends ? step->d[i] / 2 : 0);
    }
    memcpy(step->side, descent->sides, n * sizeof *descent->sides);
}

static void bound_step(struct descent *descent, const double *from)
{
    for (size_t i = 0; i < descent->n; i++) {
        const double scale = descent_scale(descent, i);
        const bool is_free = descent->run->is_free[i];
        descent->low[i] = is_free ? (solver_low(descent->problem, i) - from[i]) / scale : 0;
        descent->high[i] = is_free ? (solver_high(descent->problem, i) - from[i]) / scale : 0;
    }
}

static void damp(struct descent *descent)
{
    const size_t n = descent->n;
    memcpy(descent->damped, descent->normal, n * n * sizeof(double));
    for (size_t i = 0; i < n; i++) {
        descent->damped[i * n + i] += descent->damping * descent->diagonal[i];
    }
}

/* Set parameters that much further, and not beyond bounds by rounding. */
static void solver_move(const struct descent *descent, const double *from, double *to)
{
    const enum step_side *side = descent->step.side;
    for (size_t i = 0; i < descent->n; i++) {
        const double low = solver_low(descent->problem, i), high = solver_high(descent->problem, i);
        to[i] = from[i] + descent->step.d[i] * descent_scale(descent, i);
        to[i] = isfinite(low) && (side[i] == STEP_AT_LOW || to[i] < low) ? low : to[i];
        to[i] = isfinite(high) && (side[i] == STEP_AT_HIGH || to[i] > high) ? high : to[i];
        to[i] = descent->run->is_free[i] ? to[i] : from[i];
    }
}

/* By how much the step lowers the height, as far as the equations tell. */
static double promise(const struct descent *descent)
{
    const size_t n = descent->n;
    const double *d = descent->step.d;
    double sum = descent->price * descent->here.excess +
                 solver_sided_gain(&descent->sided, descent->here.residuals, d);
    for (size_t i = 0; i < n; i++) {
        double slope = descent->rest[i];
        for (size_t j = 0; j < n; j++) {
            slope += descent->normal[i * n + j] * d[j] / 2;
        }
        sum -= d[i] * slope;
    }
    for (size_t r = 0; r < descent->exact; r++) {
        double left = descent->here.residuals[descent->squares + r];
        for (size_t j = 0; j < n; j++) {
            left += descent->slopes[r * n + j] * d[j];
        }
        sum -= descent->price * fabs(left);
    }
    return sum;
}

/* Back to where the exact residuals are 0, which bend away from the step, by its derivatives. */
static bool return_to_exact(struct descent *descent)
{
    double *d = descent->step.d, *other = descent->before;
    for (int i = 0; i < 4 && descent->there.excess > DESCENT_MET; i++) {
        const double excess = descent->there.excess;
        bound_step(descent, descent->there.parameters);
        /* Who lies on a bound stays there. */
        for (size_t k = 0; k < descent->n; k++) {
            if (descent->step.side[k] != STEP_FREE) {
                descent->low[k] = descent->high[k] = 0;
            }
        }
        descent->step.h = descent->damped;
        descent->step.g = descent->none;
        descent->step.excess = descent->there.residuals + descent->squares;
        if (!solver_step_find(&descent->step)) {
            break;
        }
        memcpy(other, descent->there.parameters, descent->n * sizeof *d);
        solver_move(descent, other, descent->there.parameters);
        if (!descent_measure(descent, &descent->there, NULL)) {
            return false;
        }
        if (!(descent->there.excess < excess / 2)) {
            break;
        }
    }
    return true;
}

/* Find the step and what there is behind it. Result: false: no value there; NaN promise: no step */
static bool descent_step(struct descent *descent, double *promised)
{
    static const double little = 0.1; /* of the height */
    struct solver_step *step = &descent->step;
    damp(descent);
    bound_step(descent, descent->here.parameters);
    for (size_t r = 0; r < descent->exact; r++) {
        descent->wanted[r] = descent->share * descent->here.residuals[descent->squares + r];
    }
    step->excess = descent->wanted;
    *promised = NAN;
    if (!solver_sided_find(&descent->sided, descent->here.residuals, descent->damped, descent->rest,
                           step)) {
        return false;
    }
    /* above all multipliers, so that nothing is gained by leaving the exact residuals; but what
       they were far from the end is forgotten */
    double most = 0;
    for (size_t r = 0; r < descent->exact; r++) {
        most = fmax(most, fmin(fabs(descent->step.multipliers[r]), 1e150));
    }
    descent->price = fmin(fmax(descent->price, 2 * most), 20 * most);
    *promised = promise(descent);
    /* where a step gains little, in a narrow valley, it is worth one more evaluation that it
       follows the bends of it; far from there steps are to lead elsewhere anyway */
    if (descent->exact == 0 && descent->problem->scale != NULL &&
        *promised < little * descent_height(descent, &descent->here)) {
        descent_bend(descent);
    }
    solver_move(descent, descent->here.parameters, descent->there.parameters);
    if (!descent_measure(descent, &descent->there, NULL)) {
        return false;
    }
    if (descent->there.excess > DESCENT_MET && !(descent->share < 1)) {
        memcpy(descent->move, step->multipliers, descent->exact * sizeof(double));
        const bool good = return_to_exact(descent);
        memcpy(step->multipliers, descent->move, descent->exact * sizeof(double));
        return good;
    }
    return true;
}

static double longest(const struct descent *descent)
{
    double most = 0;
    for (size_t i = 0; i < descent->n; i++) {
        const double moved = descent->there.parameters[i] - descent->here.parameters[i];
        const double size = fabs(descent->here.parameters[i]) + 1e-6 * descent_scale(descent, i);
        most = fmax(most, fabs(moved) / size);
    }
    return most;
}

/* How it ended. Returns false. */
static bool descent_end(const struct descent *descent, enum engine_end how, const char *why)
{
    descent->run->end = how;
    snprintf(descent->run->message, sizeof descent->run->message, "%s", why);
    return false;
}

/* Is the step that was just made one of the last? */
static bool has_arrived(struct descent *descent, double gain, double moved)
{
    const struct solver_options *options = &descent->run->options;
    const bool is_met = descent->exact == 0 || descent->here.excess <= DESCENT_MET;
    const bool small = gain <= options->function * (descent_height(descent, &descent->here) + gain);
    descent->steady = is_met && small ? descent->steady + 1 : 0;
    double most = 0; /* of what pulls at a parameter that is free */
    for (size_t i = 0; i < descent->n; i++) {
        most = fmax(most, fabs(descent->gradient[i]) / descent_scale(descent, i));
    }
    return descent->steady >= 3 || (is_met && moved <= options->parameter) ||
           (descent->exact == 0 && most <= options->gradient);
}

/* A step that brings nothing. Result: shall a shorter one be tried? */
static bool descent_shorten(struct descent *descent, bool has_value, double promised)
{
    const double cost = descent_height(descent, &descent->here);
    /* rounding moves the cost by as much, or it is nothing against what it was */
    const bool blurred = promised <= 1e-8 * cost || cost <= 1e-20 * descent->first_cost;
    if (!isnan(promised) && !(promised > 1e-16 * cost)) {
        return descent_end(descent, ENGINE_CONVERGED, "nothing more is gained");
    }
    if (has_value && longest(descent) <= 1e-15) {
        return descent_end(descent, blurred ? ENGINE_CONVERGED : ENGINE_FAILED,
                           blurred ? "nothing more is gained" : "no step lowers the cost");
    }
    descent->damping *= has_value ? descent->growth : fmax(descent->growth, 8);
    descent->growth *= 2;
    if (!(descent->price * descent->here.excess < promised / 2)) {
        descent->share /= 2; /* it went far for the exact residuals' sake */
    }
    return descent->damping < 1e200 || descent_end(descent, ENGINE_FAILED, "no step has a value");
}

/* Go there, after a step that gained a share of what it promised. Result: false: there are no
   derivatives there, and it is back where it was */
static bool descent_accept(struct descent *descent, double gained)
{
    const bool learns = descent->problem->scale != NULL;
    double *explained = descent->before;
    const double share = 2 * gained - 1;
    if (learns) {
        descent_carry(descent, descent->there.residuals, explained);
    }
    const struct place left = descent->here;
    descent->here = descent->there;
    descent->there = left;
    if (!descent_measure(descent, &descent->here, descent->jacobian)) {
        descent->there = descent->here;
        descent->here = left;
        if (descent_measure(descent, &descent->here, descent->jacobian)) {
            descent_set_equations(descent);
        }
        return false;
    }
    descent_set_equations(descent);
    if (learns) {
        descent_learn(descent, explained, left.parameters);
    }
    /* [Nielsen99] (2.4): no jumps between what is good and what is not */
    descent->damping *= fmax(1.0 / 3, 1 - share * share * share);
    descent->growth = 2;
    descent->share = fmin(1, 2 * descent->share);
    return true;
}

/* One step. Result: shall it go on? */
static bool descent_advance(struct descent *descent)
{
    double promised;
    const bool has_value = descent_step(descent, &promised);
    const double gain =
        descent_height(descent, &descent->here) - descent_height(descent, &descent->there);
    const double moved = longest(descent);
    descent->run->iterations++;
    if (!has_value || !(gain > 0)) {
        return descent_shorten(descent, has_value, promised);
    }
    if (!descent_accept(descent, gain / promised)) {
        return isfinite(descent->here.cost)
                   ? descent_shorten(descent, false, promised)
                   : descent_end(descent, ENGINE_FAILED, "there are no derivatives any more");
    }
    return !has_arrived(descent, gain, moved) ||
           descent_end(descent, ENGINE_CONVERGED, "the cost does not change");
}

void dls_minimize(struct engine_run *run)
{
    const struct solver_problem *problem = run->problem;
    struct descent descent = {.run = run,
                              .problem = problem,
                              .n = problem->parameter_count,
                              .squares = solver_squares(problem),
                              .exact = problem->exact_count};
    descent_open(&descent, run->arena);
    for (size_t i = 0; i < descent.n; i++) {
        descent.scale[i] = problem->scale != NULL ? problem->scale[i] : INFINITY;
        descent.here.parameters[i] = run->parameters[i];
    }
    if (!descent_measure(&descent, &descent.here, descent.jacobian)) {
        descent_end(&descent, ENGINE_FAILED, "there is no value at the start");
        return;
    }
    descent.first_cost = descent.here.cost;
    descent_set_equations(&descent);
    /* Damping at the start. */
    const bool learns = problem->scale != NULL;
    double most = 0;
    for (size_t i = 0; i < descent.n; i++) {
        most = fmax(most, descent.normal[i * descent.n + i]);
    }
    most = most > 0 ? most : 1;
    const double diagonal = learns ? first_diagonal : 1;
    for (size_t i = 0; i < descent.n; i++) {
        descent.diagonal[i] = diagonal * most;
    }
    descent.damping = (learns ? first_damping : plain_damping) / diagonal;
    descent.growth = 2;
    descent.share = 1;
    descent_end(&descent, ENGINE_LIMIT, "as many iterations as allowed");
    while (run->iterations < run->options.iterations && descent_advance(&descent)) {
        if (!run->watch(run->watch_context, run->iterations, descent.here.cost,
                        descent.here.parameters)) {
            descent_end(&descent, ENGINE_WATCHED, "stopped");
            break;
        }
    }
    /* the last thing: exact residuals are 0 as nearly as can be */
    if (descent.here.excess > DESCENT_MET) {
        struct place *here = &descent.here, *there = &descent.there;
        memcpy(there->parameters, here->parameters, descent.n * sizeof(double));
        memcpy(there->residuals, here->residuals, problem->residual_count * sizeof(double));
        there->cost = here->cost;
        there->excess = here->excess;
        damp(&descent);
        if (return_to_exact(&descent) && there->excess < here->excess) {
            *here = *there;
        }
    }
    memcpy(run->parameters, descent.here.parameters, descent.n * sizeof(double));
    for (size_t i = 0; i < descent.n; i++) {
        const double at = descent.here.parameters[i];
        run->at_bound[i] = (at <= solver_low(problem, i) || at >= solver_high(problem, i)) &&
                           descent.step.side[i] != STEP_FREE;
    }
    memcpy(run->multipliers, descent.step.multipliers, descent.exact * sizeof(double));
}
