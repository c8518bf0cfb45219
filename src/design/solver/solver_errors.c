/* design/solver/solver_errors.c - what the residuals tell of the parameters at the end. */
/* SPDX-License-Identifier: MIT */
#include "base/linear.h"
#include "design/solver/solver_loss.h"
#include "design/solver/solver_solving.h"

#include <string.h>

/* Derivatives by the parameters that are free, weighted: what the errors follow from. */
static struct linear_factors solver_errors_factor_free(struct solver_state *solving,
                                                       const size_t *free_of, size_t count)
{
    size_t n = solving->problem->parameter_count, m = solving->problem->residual_count;
    double *a = ARENA_ARRAY(solving->arena, m * count + 1, double);
    for (size_t i = 0; i < m; i++) {
        double root = sqrt(solving->weights[i]);
        for (size_t j = 0; j < count; j++) {
            a[i * count + j] = root * solving->jacobian[i * n + free_of[j]];
        }
    }
    return linear_factor(a, m, count, solving->options.dependent, solving->arena);
}

static size_t solver_errors_list_free(const struct solver_state *solving, size_t *free_of)
{
    size_t count = 0;
    for (size_t i = 0; i < solving->problem->parameter_count; i++) {
        if (!solving->held[i]) {
            free_of[count++] = i;
        }
    }
    return count;
}

/*
 * The undamped step from where the solver looked last, inside the bounds.
 *
 * Result    what it promises to take off the sum of squares; NaN where there is no such step
 */
static double solver_errors_newton_step(struct solver_state *solving, double *parameters)
{
    const struct solver_problem *problem = solving->problem;
    size_t n = problem->parameter_count, m = problem->residual_count;
    size_t *free_of = ARENA_ARRAY(solving->arena, n, size_t);
    size_t count = solver_errors_list_free(solving, free_of);
    double *b = ARENA_ARRAY(solving->arena, m, double);
    double *step = ARENA_ARRAY(solving->arena, count + 1, double), promise = 0;
    const struct linear_factors factors = solver_errors_factor_free(solving, free_of, count);
    for (size_t i = 0; i < m; i++) {
        b[i] = -sqrt(solving->weights[i]) * solving->residuals[i];
    }
    linear_reflect(&factors, b);
    for (size_t k = 0; k < factors.rank; k++) {
        promise += b[k] * b[k];
    }
    linear_substitute(&factors, b, step);
    for (size_t i = 0; i < count; i++) {
        size_t at = free_of[i];
        parameters[at] = fmin(fmax(parameters[at] + step[i], solving_low(problem, at)),
                              solving_high(problem, at));
    }
    return factors.rank == count ? promise : NAN;
}

/* By how much rounding moves a cost whose residuals are small differences, as of image points. */
static const double blurred = 1e-8;

void solving_polish(struct solver_state *solving, double *parameters, double cost)
{
    size_t n = solving->problem->parameter_count;
    double *next = ARENA_ARRAY(solving->arena, n, double), promised = INFINITY, there = cost;
    for (int i = 0; i < 20; i++) {
        memcpy(next, parameters, n * sizeof(double));
        double promise = solver_errors_newton_step(solving, next);
        if (!(promise < 0.5 * promised) || !solving_look(solving, next, &there) ||
            !(there <= cost * (1 + blurred))) {
            break;
        }
        promised = promise;
        memcpy(parameters, next, n * sizeof(double));
        if (promise <= 1e-24 * cost) {
            break; /* far below the errors */
        }
    }
}

void solving_tell(const struct solver_state *solving, struct solver_summary *summary)
{
    const size_t squares = solver_squares(solving->problem);
    double sum = 0;
    for (size_t i = 0; i < squares; i++) {
        const double r = solver_counted(solving->problem->sides, i, solving->residuals[i]);
        sum += r * r;
    }
    summary->rms = sqrt(sum / (double)squares);
    summary->excess = 0;
    for (size_t i = squares; i < solving->problem->residual_count; i++) {
        summary->excess = fmax(summary->excess, fabs(solving->residuals[i]));
    }
}

void solving_errors(struct solver_state *solving, struct solver_summary *summary)
{
    size_t n = solving->problem->parameter_count, m = solving->problem->residual_count;
    struct arena *arena = solving->arena;
    size_t *free_of = ARENA_ARRAY(arena, n, size_t),
           count = solver_errors_list_free(solving, free_of);
    const struct linear_factors factors = solver_errors_factor_free(solving, free_of, count);
    double *inverse = ARENA_ARRAY(arena, count * count + 1, double);
    linear_normal_inverse(&factors, inverse, arena);
    summary->rank = factors.rank;
    for (size_t k = factors.rank; k < count; k++) {
        summary->undetermined[free_of[factors.order[k]]] = true;
    }
    double squares = 0;
    for (size_t i = 0; i < m; i++) {
        double r = solving->residuals[i];
        squares += solving->weights[i] * r * r;
    }
    summary->degrees_of_freedom = m - factors.rank;
    double variance =
        summary->degrees_of_freedom > 0 ? squares / (double)summary->degrees_of_freedom : NAN;
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < count; j++) {
            double element = inverse[i * count + j];
            summary->inverse[free_of[i] * n + free_of[j]] = element;
            summary->covariance[free_of[i] * n + free_of[j]] = variance * element;
        }
        summary->standard_error[free_of[i]] = sqrt(variance * inverse[i * count + i]);
    }
}
