/* design/solver/solver_loss.h - the cost of residuals, and how much each of them counts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_LOSS_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_LOSS_H

#include "design/solver/solver.h"

#include <math.h>

/* Residuals whose squares are summed: those that are met exactly stand behind them. */
static inline size_t solver_squares(const struct solver_problem *problem)
{
    return problem->residual_count - problem->exact_count;
}

/* The bounds of a parameter; infinite where there is none. */
static inline double solver_low(const struct solver_problem *problem, size_t i)
{
    return problem->low != NULL ? problem->low[i] : -INFINITY;
}

static inline double solver_high(const struct solver_problem *problem, size_t i)
{
    return problem->high != NULL ? problem->high[i] : INFINITY;
}

/* What of a residual counts. */
static inline double solver_counted(const enum solver_side *sides, size_t i, double residual)
{
    const enum solver_side side = sides != NULL ? sides[i] : SIDE_BOTH;
    return (side == SIDE_ABOVE && residual <= 0) || (side == SIDE_BELOW && residual >= 0)
               ? 0
               : residual;
}

/*
 * Half the sum of rho.
 *
 * Given     weights  receives rho' of each residual, 0 of one on the side that does not count;
 *                    null: they are not wanted
 */
double solver_cost(const struct solver_problem *problem, const double *residuals, double *weights);

#endif
