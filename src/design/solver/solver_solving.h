/* design/solver/solver_solving.h - a problem being solved: what the parts of the solver share. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_SOLVING_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_SOLVING_H

#include "design/solver/solver_engine.h"

#include <math.h>

/* A problem being solved. */
struct solver_state {
    const struct solver_problem *problem;
    const struct engine *engine;
    struct solver_options options;
    struct arena *arena;
    double *residuals, *jacobian, *gradient, *weights; /* at the parameters last looked at */
    double *seen, seen_cost;                           /* those; NaN = none yet */
    bool *held;     /* at a bound, for as long as the cost falls beyond it */
    bool *on;       /* lay on a bound when this round began */
    bool *at_bound; /* of an engine that keeps bounds by itself */
    double *multipliers;
    bool stopped; /* by the caller */
    int done;     /* iterations of earlier rounds */
};

static inline double solving_low(const struct solver_problem *problem, size_t i)
{
    return problem->low != NULL ? problem->low[i] : -INFINITY;
}

static inline double solving_high(const struct solver_problem *problem, size_t i)
{
    return problem->high != NULL ? problem->high[i] : INFINITY;
}

/* Errors    as solver_run, but for the start without finite residuals */
bool solver_check(const struct solver_problem *problem, const struct solver_options *options,
                  const double *parameters, struct error *error);

/* The problem for an engine that knows nothing of sides: what does not count is 0. */
struct solver_problem solver_without_sides(struct solver_problem *problem);

/* Residuals, derivatives, weights and the gradient at these parameters; false: not all finite. */
bool solving_look(struct solver_state *solving, const double *parameters, double *cost);

/*
 * Near the end the cost no longer tells better from worse, but the gradient does: a few undamped
 * steps, for as long as what the next one promises gets smaller.
 */
void solving_polish(struct solver_state *solving, double *parameters, double cost);

/* What a summary says of the residuals where the solver looked last. */
void solving_tell(const struct solver_state *solving, struct solver_summary *summary);

/* And of the errors of the parameters. */
void solving_errors(struct solver_state *solving, struct solver_summary *summary);

#endif
