/* design/solver/solver_look.c - a problem at some parameters. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_loss.h"
#include "design/solver/solver_solving.h"

#include <string.h>

static bool solver_look_all_finite(const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

bool solving_look(struct solver_state *solving, const double *parameters, double *cost)
{
    const struct solver_problem *problem = solving->problem;
    size_t n = problem->parameter_count, m = problem->residual_count;
    if (memcmp(parameters, solving->seen, n * sizeof(double)) == 0 &&
        isfinite(solving->seen_cost)) {
        *cost = solving->seen_cost;
        return true;
    }
    memcpy(solving->seen, parameters, n * sizeof(double));
    solving->seen_cost = NAN;
    if (!problem->evaluate(problem->context, parameters, solving->residuals, solving->jacobian) ||
        !solver_look_all_finite(solving->residuals, m) ||
        !solver_look_all_finite(solving->jacobian, m * n)) {
        return false;
    }
    *cost = solver_cost(problem, solving->residuals, solving->weights);
    memset(solving->gradient, 0, n * sizeof(double));
    double *gradient = solving->gradient;
    for (size_t i = 0; i < solver_squares(problem); i++) {
        double r = solving->weights[i] * solving->residuals[i];
        const double *row = solving->jacobian + i * n;
        for (size_t j = 0; j < n; j++) {
            gradient[j] += r * row[j];
        }
    }
    if (!isfinite(*cost) || !solver_look_all_finite(solving->gradient, n)) {
        return false;
    }
    solving->seen_cost = *cost;
    return true;
}
