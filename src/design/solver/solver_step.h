/* design/solver/solver_step.h - a step that stays inside bounds and keeps conditions. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_STEP_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_STEP_H

#include "base/arena.h"

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

#endif
