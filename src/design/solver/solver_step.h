/* design/solver/solver_step.h - a step that stays inside bounds and keeps conditions. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_STEP_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_STEP_H

#include "base/arena.h"
#include "design/solver/solver.h"

#include <stdbool.h>
#include <stddef.h>

enum step_side { STEP_FREE, STEP_AT_LOW, STEP_AT_HIGH };

struct step_system;

/* A convex quadratic problem, and its solution. */
struct solver_step {
    size_t count, exact;        /* of parameters, of conditions */
    const double *h;            /* count x count, positive definite */
    const double *g;            /* count */
    const double *low, *high;   /* of d: low <= 0 <= high, infinite where there is none */
    const double *slopes;       /* exact x count: of the conditions */
    const double *excess;       /* exact: what they are off by */
    enum step_side *side;       /* which bounds d lies on: a guess; receives what was found */
    double *d;                  /* receives the step */
    double *multipliers;        /* receives those of the conditions */
    struct step_system *system; /* internal */
};

/* Room for the solution of problems of this size; the other arrays are the caller's. */
void solver_step_open(struct solver_step *step, size_t count, size_t exact, struct arena *arena);

/*
 * The d that makes g d + d H d/2 smallest with low <= d <= high and slopes d = -excess.
 *
 * Result    false: H is not positive definite
 * Formula   those on bounds are held, the others follow from [H A^T; A 0] [d; m] = [-g; -b]; who
 *           oversteps a bound is held at it, and whose bound holds against nothing is let go, all
 *           at once, and after some rounds only the last of them, which always ends
 * Source    [Judice94] (block principal pivoting); [Nocedal06] 16.2 (conditions)
 * Limits    conditions that contradict each other or the bounds are met as nearly as can be
 */
bool solver_step_find(struct solver_step *step);

/* -------- residuals that count on one side of 0 only, within a step -------- */

/*
 * Half the square of max(r, 0) has a kink in its slope: a model of it by what is off where the
 * step begins knows nothing of the residuals that the step runs into, and holds on to those that
 * it leaves behind. So the step is that of the sum of squares of what counts where it ends.
 */
struct solver_sided {
    const enum solver_side *sides;
    size_t count, columns;
    size_t *at;     /* which residuals */
    double *slopes; /* count x columns: of them, in the scales of the step; the caller sets them */
    bool *counts;   /* where the step ends */
    double *h, *g;  /* of the step, with what counts */
    double *from;   /* the step before */
    double *carried, *along; /* the residuals there, and their changes to the next */
};

void solver_sided_open(const struct solver_problem *problem, struct arena *arena,
                       struct solver_sided *sided);

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
