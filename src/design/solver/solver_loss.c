/* design/solver/solver_loss.c - the cost of residuals, and how much each of them counts. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_loss.h"

#include <math.h>

/* rho and its slope */
static double loss_value(const struct solver_block *block, double s, double *slope)
{
    double a2 = block->scale * block->scale;
    switch (block->loss) {
    case LOSS_HUBER:
        *slope = s <= a2 ? 1 : block->scale / sqrt(s);
        return s <= a2 ? s : 2 * block->scale * sqrt(s) - a2;
    case LOSS_SOFT_L1:
        *slope = 1 / sqrt(1 + s / a2);
        return 2 * s / (1 + sqrt(1 + s / a2));
    case LOSS_CAUCHY:
        *slope = 1 / (1 + s / a2);
        return a2 * log1p(s / a2);
    case LOSS_NONE:
        break;
    }
    *slope = 1;
    return s;
}

double solver_cost(const struct solver_problem *problem, const double *residuals, double *weights)
{
    const struct solver_block whole = {solver_squares(problem), LOSS_NONE, 0};
    const struct solver_block *blocks = problem->blocks != NULL ? problem->blocks : &whole;
    size_t count = problem->blocks != NULL ? problem->block_count : 1, at = 0;
    double cost = 0;
    for (size_t i = 0; i < count; i++) {
        double s = 0, slope;
        for (size_t j = 0; j < blocks[i].residuals; j++) {
            const double r = solver_counted(problem->sides, at + j, residuals[at + j]);
            s += r * r;
        }
        cost += loss_value(&blocks[i], s, &slope) / 2;
        for (size_t j = 0; j < blocks[i].residuals && weights != NULL; j++) {
            const double r = residuals[at + j];
            weights[at + j] = solver_counted(problem->sides, at + j, r) == r ? slope : 0;
        }
        at += blocks[i].residuals;
    }
    return cost;
}
