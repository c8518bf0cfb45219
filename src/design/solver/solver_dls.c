/* design/solver/solver_dls.c - damped least squares, the classic of lens design. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_descent.h"
#include "design/solver/solver_loss.h"

#include <stdio.h>
#include <string.h>

/* Go there. Result: false: there are no derivatives there */
static bool solver_dls_accept(struct descent *descent, double gained)
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

static void solver_dls_end(struct engine_run *run, enum engine_end how, const char *why)
{
    run->end = how;
    snprintf(run->message, sizeof run->message, "%s", why);
}

/* Does nothing pull at a parameter that is free? */
static bool solver_dls_is_flat(const struct descent *descent)
{
    double most = 0;
    for (size_t i = 0; i < descent->n; i++) {
        most = fmax(most, fabs(descent->gradient[i]) / descent_scale(descent, i));
    }
    return descent->exact == 0 && most <= descent->run->options.gradient;
}

/* Is the step that was just made one of the last? */
static bool has_arrived(struct descent *descent, double gain, double moved)
{
    const struct solver_options *options = &descent->run->options;
    const bool is_met = descent->exact == 0 || descent->here.excess <= DESCENT_MET;
    const bool small = gain <= options->function * (descent_height(descent, &descent->here) + gain);
    descent->steady = is_met && small ? descent->steady + 1 : 0;
    return descent->steady >= 3 || (is_met && moved <= options->parameter) ||
           solver_dls_is_flat(descent);
}

/* A step that brings nothing. Result: shall a shorter one be tried? */
static bool solver_dls_shorten(struct descent *descent, bool has_value, double promised)
{
    const double cost = descent_height(descent, &descent->here);
    /* rounding moves the cost by as much, or it is nothing against what it was */
    const bool blurred = promised <= 1e-8 * cost || cost <= 1e-20 * descent->first_cost;
    if (!isnan(promised) && !(promised > 1e-16 * cost)) {
        solver_dls_end(descent->run, ENGINE_CONVERGED, "nothing more is gained");
        return false;
    }
    if (has_value && longest(descent) <= 1e-15) {
        solver_dls_end(descent->run, blurred ? ENGINE_CONVERGED : ENGINE_FAILED,
                       blurred ? "nothing more is gained" : "no step lowers the cost");
        return false;
    }
    descent->damping *= has_value ? descent->growth : fmax(descent->growth, 8);
    descent->growth *= 2;
    if (!(descent->price * descent->here.excess < promised / 2)) {
        descent->share /= 2; /* it went far for the exact residuals' sake */
    }
    if (!(descent->damping < 1e200)) {
        solver_dls_end(descent->run, ENGINE_FAILED, "no step has a value");
        return false;
    }
    return true;
}

/* One step. Result: shall it go on? */
static bool solver_dls_advance(struct descent *descent)
{
    double promised;
    const bool has_value = descent_step(descent, &promised);
    const double gain =
        descent_height(descent, &descent->here) - descent_height(descent, &descent->there);
    const double moved = longest(descent);
    descent->run->iterations++;
    if (!has_value || !(gain > 0)) {
        return solver_dls_shorten(descent, has_value, promised);
    }
    if (!solver_dls_accept(descent, gain / promised)) {
        solver_dls_end(descent->run, ENGINE_FAILED, "there are no derivatives where the step led");
        return false;
    }
    if (has_arrived(descent, gain, moved)) {
        solver_dls_end(descent->run, ENGINE_CONVERGED, "the cost does not change");
        return false;
    }
    return true;
}

static void solver_dls_set_sides(const struct descent *descent)
{
    const struct solver_problem *problem = descent->problem;
    for (size_t i = 0; i < descent->n; i++) {
        const double at = descent->here.parameters[i];
        const bool on = (problem->low != NULL && at <= problem->low[i]) ||
                        (problem->high != NULL && at >= problem->high[i]);
        descent->run->at_bound[i] = on && descent->step.side[i] != STEP_FREE;
    }
    memcpy(descent->run->multipliers, descent->step.multipliers, descent->exact * sizeof(double));
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
        solver_dls_end(run, ENGINE_FAILED, "there is no value at the start");
        return;
    }
    descent.first_cost = descent.here.cost;
    descent_set_equations(&descent);
    descent_begin(&descent);
    solver_dls_end(run, ENGINE_LIMIT, "as many iterations as allowed");
    while (run->iterations < run->options.iterations && solver_dls_advance(&descent)) {
        if (!run->watch(run->watch_context, run->iterations, descent.here.cost,
                        descent.here.parameters)) {
            solver_dls_end(run, ENGINE_WATCHED, "stopped");
            break;
        }
    }
    descent_finish(&descent);
    memcpy(run->parameters, descent.here.parameters, descent.n * sizeof(double));
    solver_dls_set_sides(&descent);
}
