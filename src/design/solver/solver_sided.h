/* design/solver/solver_sided.h - residuals that count on one side of 0 only, within a step. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_SIDED_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_SIDED_H

#include "design/solver/solver.h"
#include "design/solver/solver_step.h"

/*
 * Half the square of max(r, 0) has a kink in its slope: a model of it by what is off where the
 * step begins knows nothing of the residuals that the step runs into, and holds on to those that
 * it leaves behind. So the step is that of the sum of squares of what counts where it ends.
 */
struct solver_sided {
    const enum solver_side *sides;
    size_t count, columns;
    size_t *at;              /* which residuals */
    double *slopes;          /* count x columns: of them, in the scales of the step */
    bool *counts;            /* where the step ends */
    double *h, *g;           /* of the step, with what counts */
    double *from;            /* the step before */
    double *carried, *along; /* the residuals there, and their changes to the next */
};

void solver_sided_open(const struct solver_problem *problem, struct arena *arena,
                       struct solver_sided *sided);

/* Derivatives by the parameters into slopes, which the caller scales. */
void solver_sided_set(struct solver_sided *sided, const double *jacobian);

/* Add what of these residuals counts, times the slopes, to a gradient. */
void solver_sided_pull(const struct solver_sided *sided, const double *residuals, double *gradient);

/* What the step takes off half the sum of their squares, as far as slopes tell. */
double solver_sided_gain(const struct solver_sided *sided, const double *residuals,
                         const double *d);

/*
 * solver_step_find with them.
 *
 * Given     residuals  where the step begins
 *           h, g       of all others, damped
 * Formula   steps with those that count where the one before ended, until the same do; each as
 *           far only as the whole, which is convex, falls on the way
 * Source    derived here: Newton's method for a piecewise quadratic function; [Nocedal06] 16.5
 */
bool solver_sided_find(struct solver_sided *sided, const double *residuals, const double *h,
                       const double *g, struct solver_step *step);

#endif
