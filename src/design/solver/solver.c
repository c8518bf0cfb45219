/* design/solver/solver.c - rounds of the minimiser, with bounds held and let go. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver.h"

#include "base/linear.h"
#include "design/solver/solver_engine.h"
#include "design/solver/solver_loss.h"
#include "design/solver/solver_normal.h"

#include <math.h>
#include <string.h>

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

bool solver_has(enum solver_engine engine)
{
    return solver_engines[engine].minimize != NULL;
}

static bool check_blocks(const struct solver_problem *problem, struct error *error)
{
    size_t sum = 0;
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

/* Errors    as solver_run, but for the start without finite residuals */
static bool solver_check(const struct solver_problem *problem, const struct solver_options *options,
                         const double *parameters, struct error *error)
{
    const size_t n = problem->parameter_count, m = problem->residual_count;
    /* What only damped least squares can. */
    if (!solver_has(options->engine)) {
        return fail(error, ERROR_DOMAIN, "this program is without the solver Ceres");
    }
    if (!(problem->exact_count == 0 || solver_engines[options->engine].keeps_bounds)) {
        return fail(error, ERROR_DOMAIN,
                    "Ceres meets no condition exactly: damped least squares do");
    }
    if ((n == 0 && !options->lean) || m == 0) {
        return fail(error, ERROR_DOMAIN, "there is nothing to fit: %zu parameters, %zu residuals",
                    n, m);
    }
    if (m < n && !options->lean) {
        return fail(error, ERROR_DOMAIN, "%zu residuals do not fix %zu parameters", m, n);
    }
    if (n > SOLVER_COLUMNS || n * m > 100000000) {
        return fail(error, ERROR_DOMAIN, "%zu residuals of %zu parameters are too many", m, n);
    }
    for (size_t i = 0; i < n; i++) {
        const double low = solver_low(problem, i), high = solver_high(problem, i);
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
    return problem->blocks == NULL || check_blocks(problem, error);
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

static bool all_are_finite(const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            return false;
        }
    }
    return true;
}

/* Residuals, derivatives, weights and the gradient at these parameters; false: not all finite. */
static bool solving_look(struct solver_state *solving, const double *parameters, double *cost)
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
        !all_are_finite(solving->residuals, m) || !all_are_finite(solving->jacobian, m * n)) {
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
    if (!isfinite(*cost) || !all_are_finite(solving->gradient, n)) {
        return false;
    }
    solving->seen_cost = *cost;
    return true;
}

/*
 * Derivatives by the parameters that are free, weighted: what the errors follow from.
 *
 * Given     free_of  receives which these are; count: how many
 */
static struct linear_factors factor_free(struct solver_state *solving, size_t *free_of,
                                         size_t *count)
{
    const size_t n = solving->problem->parameter_count, m = solving->problem->residual_count;
    size_t k = 0;
    for (size_t i = 0; i < n; i++) {
        if (!solving->held[i]) {
            free_of[k++] = i;
        }
    }
    double *a = ARENA_ARRAY(solving->arena, m * k + 1, double);
    for (size_t i = 0; i < m; i++) {
        double root = sqrt(solving->weights[i]);
        for (size_t j = 0; j < k; j++) {
            a[i * k + j] = root * solving->jacobian[i * n + free_of[j]];
        }
    }
    *count = k;
    return linear_factor(a, m, k, solving->options.dependent, solving->arena);
}

/*
 * The undamped step from where the solver looked last, inside the bounds.
 *
 * Result    what it promises to take off the sum of squares; NaN where there is no such step
 */
static double newton_step(struct solver_state *solving, double *parameters)
{
    const struct solver_problem *problem = solving->problem;
    size_t n = problem->parameter_count, m = problem->residual_count;
    size_t *free_of = ARENA_ARRAY(solving->arena, n, size_t), count;
    const struct linear_factors factors = factor_free(solving, free_of, &count);
    double *b = ARENA_ARRAY(solving->arena, m, double);
    double *step = ARENA_ARRAY(solving->arena, count + 1, double), promise = 0;
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
        parameters[at] =
            fmin(fmax(parameters[at] + step[i], solver_low(problem, at)), solver_high(problem, at));
    }
    return factors.rank == count ? promise : NAN;
}

/* By how much rounding moves a cost whose residuals are small differences, as of image points. */
static const double blurred = 1e-8;

/*
 * Near the end the cost no longer tells better from worse, but the gradient does: a few undamped
 * steps, for as long as what the next one promises gets smaller.
 */
static void solving_polish(struct solver_state *solving, double *parameters, double cost)
{
    size_t n = solving->problem->parameter_count;
    double *next = ARENA_ARRAY(solving->arena, n, double), promised = INFINITY, there = cost;
    for (int i = 0; i < 20; i++) {
        memcpy(next, parameters, n * sizeof(double));
        double promise = newton_step(solving, next);
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

/* And of the errors of the parameters. */
static void solving_errors(struct solver_state *solving, struct solver_summary *summary)
{
    size_t n = solving->problem->parameter_count, m = solving->problem->residual_count;
    struct arena *arena = solving->arena;
    size_t *free_of = ARENA_ARRAY(arena, n, size_t), count;
    const struct linear_factors factors = factor_free(solving, free_of, &count);
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

static const struct solver_options usual = {
    .iterations = 200,
    .function = 1e-15,
    .gradient = 1e-30,
    .parameter = 1e-13,
    .initial_trust = 1e4,
    .dependent = 1e-11,
};

static bool is_on_bound(const struct solver_problem *problem, const double *parameters, size_t i)
{
    return parameters[i] <= solver_low(problem, i) || parameters[i] >= solver_high(problem, i);
}

/* Would the cost fall beyond the bound? */
static bool falls_outwards(const struct solver_state *solving, const double *parameters, size_t i)
{
    const struct solver_problem *problem = solving->problem;
    return (parameters[i] <= solver_low(problem, i) && solving->gradient[i] > 0) ||
           (parameters[i] >= solver_high(problem, i) && solving->gradient[i] < 0);
}

/* Ends a round when the caller wants it, or when a parameter arrives at a bound. */
static bool watch(void *context, int iteration, double cost, const double *parameters)
{
    struct solver_state *solving = context;
    const struct solver_problem *problem = solving->problem;
    const struct solver_progress progress = {solving->done + iteration, cost, parameters};
    if (solving->options.progress != NULL &&
        !solving->options.progress(solving->options.progress_context, &progress)) {
        solving->stopped = true;
        return false;
    }
    for (size_t i = 0; i < problem->parameter_count && !solving->engine->keeps_bounds; i++) {
        if (!solving->on[i] && is_on_bound(problem, parameters, i)) {
            return false;
        }
    }
    return true;
}

/* Hold what lies on a bound and is pushed against it. Result: how many are held newly. */
static size_t hold(struct solver_state *solving, const double *parameters)
{
    size_t count = 0;
    for (size_t i = 0; i < solving->problem->parameter_count; i++) {
        bool on = is_on_bound(solving->problem, parameters, i);
        bool held = on && (solving->held[i] || falls_outwards(solving, parameters, i));
        count += held && !solving->held[i];
        solving->held[i] = held;
        solving->on[i] = on;
    }
    return count;
}

/* One round over the parameters that are not held. */
static void run_round(struct solver_state *solving, double *parameters,
                      struct solver_summary *summary, struct engine_run *run)
{
    const size_t n = solving->problem->parameter_count;
    bool *is_free = ARENA_ARRAY(solving->arena, n, bool), is_any = false;
    for (size_t i = 0; i < n; i++) {
        is_free[i] = !solving->held[i];
        is_any = is_any || is_free[i];
    }
    if (!is_any) {
        *run = (struct engine_run){.end = ENGINE_CONVERGED, .message = "all is at its bounds"};
        return;
    }
    *run = (struct engine_run){.problem = solving->problem,
                               .options = solving->options,
                               .is_free = is_free,
                               .parameters = parameters,
                               .watch = watch,
                               .watch_context = solving,
                               .arena = solving->arena,
                               .at_bound = solving->at_bound,
                               .multipliers = solving->multipliers};
    run->options.iterations = solving->options.iterations - (int)summary->iterations;
    solving->engine->minimize(run);
    if (run->end == ENGINE_NO_MEMORY) {
        arena_end();
    }
    summary->iterations += run->iterations;
    summary->evaluations += run->evaluations;
    summary->derivatives += run->derivatives;
    solving->done = (int)summary->iterations;
}

/* Rounds until no parameter is newly held and none wants to be let go; of an engine that keeps
   bounds by itself one. */
static void run_rounds(struct solver_state *solving, double *parameters,
                       struct solver_summary *summary)
{
    const size_t n = solving->problem->parameter_count;
    struct engine_run run = {.end = ENGINE_CONVERGED};
    double best = summary->initial_cost, cost = best;
    size_t releases = 0;
    if (solving->engine->keeps_bounds) {
        run_round(solving, parameters, summary, &run);
        memcpy(solving->held, solving->at_bound, n * sizeof(bool));
    } else {
        hold(solving, parameters);
    }
    while (!solving->engine->keeps_bounds && summary->iterations < solving->options.iterations) {
        run_round(solving, parameters, summary, &run);
        if (solving->stopped || run.end == ENGINE_FAILED ||
            !solving_look(solving, parameters, &cost)) {
            break;
        }
        if (hold(solving, parameters) > 0 || run.end == ENGINE_WATCHED) {
            continue;
        }
        if (run.end == ENGINE_LIMIT || releases++ > 4 * n) {
            break;
        }
        /* let go what is held although the cost falls inwards */
        size_t count = 0;
        for (size_t i = 0; i < n; i++) {
            if (solving->held[i] && !falls_outwards(solving, parameters, i) &&
                fabs(solving->gradient[i]) > 0) {
                solving->held[i] = false;
                count++;
            }
        }
        if (count == 0 || (releases > 1 && !(cost < best))) {
            break; /* what was let go brought nothing */
        }
        best = cost;
    }
    static const enum solver_status statuses[] = {[ENGINE_CONVERGED] = SOLVER_CONVERGED,
                                                  [ENGINE_LIMIT] = SOLVER_LIMIT,
                                                  [ENGINE_WATCHED] = SOLVER_LIMIT,
                                                  [ENGINE_FAILED] = SOLVER_STUCK};
    summary->status = solving->stopped ? SOLVER_STOPPED : statuses[run.end];
    summary->message = arena_printf(solving->arena, "%s", run.message);
}

static double or_usual(double value, double otherwise)
{
    return value > 0 ? value : otherwise;
}

static struct solver_options complete_options(const struct solver_options *options)
{
    struct solver_options all = options != NULL ? *options : usual;
    all.iterations = all.iterations > 0 ? all.iterations : usual.iterations;
    all.function = or_usual(all.function, usual.function);
    all.gradient = or_usual(all.gradient, usual.gradient);
    all.parameter = or_usual(all.parameter, usual.parameter);
    all.initial_trust = or_usual(all.initial_trust, usual.initial_trust);
    all.dependent = or_usual(all.dependent, usual.dependent);
    return all;
}

bool solver_run(const struct solver_problem *problem, const struct solver_options *options,
                double *parameters, struct arena *arena, struct solver_summary *summary,
                struct error *error)
{
    size_t n = problem->parameter_count, m = problem->residual_count;
    const struct solver_options all = complete_options(options);
    if (!solver_check(problem, &all, parameters, error)) {
        return false;
    }
    struct solver_problem sided = *problem, plain = *problem;
    if (problem->sides != NULL && !solver_engines[all.engine].keeps_bounds) {
        plain.evaluate = evaluate_counted;
        plain.context = &sided;
        plain.sides = NULL;
        problem = &plain;
    }
    struct solver_state solving = {.problem = problem,
                                   .engine = &solver_engines[all.engine],
                                   .options = all,
                                   .arena = arena,
                                   .residuals = ARENA_ARRAY(arena, m, double),
                                   .jacobian = ARENA_ARRAY(arena, m * n, double),
                                   .seen = ARENA_ARRAY(arena, n, double),
                                   .seen_cost = NAN,
                                   .gradient = ARENA_ARRAY(arena, n, double),
                                   .weights = ARENA_ARRAY(arena, m, double),
                                   .at_bound = ARENA_ARRAY(arena, n, bool),
                                   .multipliers =
                                       ARENA_ARRAY(arena, problem->exact_count + 1, double),
                                   .held = ARENA_ARRAY(arena, n, bool),
                                   .on = ARENA_ARRAY(arena, n, bool)};
    *summary = (struct solver_summary){.at_bound = ARENA_ARRAY(arena, n, bool),
                                       .undetermined = ARENA_ARRAY(arena, n, bool),
                                       .covariance = ARENA_ARRAY(arena, n * n, double),
                                       .inverse = ARENA_ARRAY(arena, n * n, double),
                                       .standard_error = ARENA_ARRAY(arena, n, double)};
    for (size_t i = 0; i < n * n; i++) {
        summary->covariance[i] = summary->inverse[i] = NAN;
    }
    for (size_t i = 0; i < n; i++) {
        summary->standard_error[i] = NAN;
    }
    if (!solving_look(&solving, parameters, &summary->initial_cost)) {
        return fail(error, ERROR_DOMAIN,
                    "the fit cannot begin: not all residuals and derivatives are numbers there");
    }
    if (n > 0) {
        run_rounds(&solving, parameters, summary);
    } else {
        summary->status = SOLVER_CONVERGED;
        summary->evaluations = 1;
    }
    if (!all.lean && summary->status == SOLVER_CONVERGED &&
        solving_look(&solving, parameters, &summary->final_cost)) {
        solving_polish(&solving, parameters, summary->final_cost);
    }
    if (!solving_look(&solving, parameters, &summary->final_cost)) {
        return fail(error, ERROR_DOMAIN, "the fit ended where it has no value");
    }
    summary->residuals = solving.residuals;
    summary->jacobian = solving.jacobian;
    memcpy(summary->at_bound, solving.held, n * sizeof(bool));
    /* What a summary says of the residuals where the solver looked last. */
    const size_t squares = solver_squares(solving.problem);
    double sum = 0;
    for (size_t i = 0; i < squares; i++) {
        const double r = solver_counted(solving.problem->sides, i, solving.residuals[i]);
        sum += r * r;
    }
    summary->rms = sqrt(sum / (double)squares);
    summary->excess = 0;
    for (size_t i = squares; i < solving.problem->residual_count; i++) {
        summary->excess = fmax(summary->excess, fabs(solving.residuals[i]));
    }
    if (!all.lean) {
        solving_errors(&solving, summary);
    }
    return true;
}
