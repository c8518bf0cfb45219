/* design/solver/solver_check.c - problems that can be solved, and by what. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_loss.h"
#include "design/solver/solver_normal.h"
#include "design/solver/solver_solving.h"

#include <string.h>

bool solver_has(enum solver_engine engine)
{
    return solver_engines[engine].minimize != NULL;
}

static bool check_blocks(const struct solver_problem *problem, struct error *error)
{
    size_t sum = 0;
    if (problem->blocks == NULL) {
        return true;
    }
    if (problem->sides != NULL) {
        return fail(error, ERROR_DOMAIN, "residuals of one side have no loss");
    }
    for (size_t i = 0; i < problem->block_count; i++) {
        const struct solver_block *block = &problem->blocks[i];
        if (block->loss != LOSS_NONE && !(block->scale > 0 && isfinite(block->scale))) {
            return fail(error, ERROR_DOMAIN, "the scale %.6g of a loss is not above 0",
                        block->scale);
        }
        sum += block->residuals;
    }
    return sum == solver_squares(problem) ||
           fail(error, ERROR_DOMAIN, "the blocks have %zu residuals, the problem has %zu", sum,
                solver_squares(problem));
}

static bool solver_check_bounds(const struct solver_problem *problem, const double *parameters,
                                struct error *error)
{
    for (size_t i = 0; i < problem->parameter_count; i++) {
        double low = solving_low(problem, i), high = solving_high(problem, i);
        if (!isfinite(parameters[i])) {
            return fail(error, ERROR_DOMAIN, "parameter %zu begins at %.6g", i + 1, parameters[i]);
        }
        if (!(low < high)) {
            return fail(error, ERROR_DOMAIN,
                        "the bounds %.10g to %.10g of parameter %zu leave "
                        "nothing between them",
                        low, high, i + 1);
        }
        if (!(low <= parameters[i] && parameters[i] <= high)) {
            return fail(error, ERROR_DOMAIN,
                        "parameter %zu begins at %.10g, outside its bounds %.10g to %.10g", i + 1,
                        parameters[i], low, high);
        }
    }
    return true;
}

/* What only damped least squares can. */
static bool check_engine(const struct solver_problem *problem, enum solver_engine engine,
                         struct error *error)
{
    if (!solver_has(engine)) {
        return fail(error, ERROR_DOMAIN, "this program is without the solver Ceres");
    }
    return problem->exact_count == 0 || solver_engines[engine].keeps_bounds ||
           fail(error, ERROR_DOMAIN, "Ceres meets no condition exactly: damped least squares do");
}

bool solver_check(const struct solver_problem *problem, const struct solver_options *options,
                  const double *parameters, struct error *error)
{
    size_t n = problem->parameter_count, m = problem->residual_count;
    if (!check_engine(problem, options->engine, error)) {
        return false;
    }
    if (n == 0 || m == 0) {
        return fail(error, ERROR_DOMAIN, "there is nothing to fit: %zu parameters, %zu residuals",
                    n, m);
    }
    if (m < n && !options->lean) {
        return fail(error, ERROR_DOMAIN, "%zu residuals do not fix %zu parameters", m, n);
    }
    if (n > SOLVER_COLUMNS || m > 100000000 / n) {
        return fail(error, ERROR_DOMAIN, "%zu residuals of %zu parameters are too many", m, n);
    }
    return solver_check_bounds(problem, parameters, error) && check_blocks(problem, error);
}

/* Residuals that count on one side only, for an engine that knows nothing of sides. */
static bool evaluate_counted(void *context, const double *parameters, double *residuals,
                             double *jacobian)
{
    const struct solver_problem *problem = context;
    const size_t n = problem->parameter_count;
    if (!problem->evaluate(problem->context, parameters, residuals, jacobian)) {
        return false;
    }
    for (size_t i = 0; i < problem->residual_count; i++) {
        residuals[i] = solver_counted(problem->sides, i, residuals[i]);
        if (residuals[i] == 0 && problem->sides[i] != SIDE_BOTH && jacobian != NULL) {
            memset(jacobian + i * n, 0, n * sizeof *jacobian);
        }
    }
    return true;
}

struct solver_problem solver_without_sides(struct solver_problem *problem)
{
    struct solver_problem plain = *problem;
    plain.evaluate = evaluate_counted;
    plain.context = problem;
    plain.sides = NULL;
    return plain;
}
