/* design/solver/escape.c - out of a minimum: a problem with hills where minima are known. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/escape.h"

#include "base/exponential.h"

#include <assert.h>
#include <math.h>
#include <string.h>

double escape_distance(const struct solver_problem *problem, const double *a, const double *b)
{
    double sum = 0;
    for (size_t j = 0; j < problem->parameter_count; j++) {
        const double d = (a[j] - b[j]) / problem->scale[j];
        sum += d * d;
    }
    return sqrt(sum);
}

/* Beyond this a hill is nothing, and its exponential out of range. */
static const double far_away = 30; /* widths */

/* The residuals of the problem, hills between them and the exact ones. */
static bool escape_evaluate(void *context, const double *parameters, double *residuals,
                            double *jacobian)
{
    const struct escape *escape = context;
    const struct solver_problem *problem = escape->problem;
    const size_t n = problem->parameter_count, exact = problem->exact_count;
    const size_t squares = problem->residual_count - exact;
    if (!problem->evaluate(problem->context, parameters, residuals, jacobian)) {
        return false;
    }
    memmove(residuals + squares + escape->count, residuals + squares, exact * sizeof *residuals);
    if (jacobian != NULL) {
        memmove(jacobian + (squares + escape->count) * n, jacobian + squares * n,
                exact * n * sizeof *jacobian);
    }
    for (size_t i = 0; i < escape->count; i++) {
        const struct escape_hill *hill = &escape->hills[i];
        const double d = escape_distance(problem, parameters, hill->at) / hill->width;
        double *residual = residuals + squares + i;
        *residual = d < far_away ? sqrt(hill->height) * exponential(-d * d / 2) : 0;
        for (size_t j = 0; j < n && jacobian != NULL; j++) {
            const double wide = problem->scale[j] * hill->width;
            jacobian[(squares + i) * n + j] =
                -*residual * (parameters[j] - hill->at[j]) / (wide * wide);
        }
    }
    return true;
}

struct solver_problem escape_problem(struct escape *escape)
{
    struct solver_problem problem = *escape->problem;
    assert(problem.blocks == NULL && problem.scale != NULL);
    problem.residual_count += escape->count;
    problem.evaluate = escape_evaluate;
    problem.context = escape;
    return problem;
}
