/* design/solver/solver.c - rounds of the minimiser, with bounds held and let go. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver.h"

#include "design/solver/solver_loss.h"
#include "design/solver/solver_solving.h"

#include <math.h>
#include <string.h>

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
    return parameters[i] <= solving_low(problem, i) || parameters[i] >= solving_high(problem, i);
}

/* Would the cost fall beyond the bound? */
static bool falls_outwards(const struct solver_state *solving, const double *parameters, size_t i)
{
    const struct solver_problem *problem = solving->problem;
    return (parameters[i] <= solving_low(problem, i) && solving->gradient[i] > 0) ||
           (parameters[i] >= solving_high(problem, i) && solving->gradient[i] < 0);
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

/* Let go what is held although the cost falls inwards. Result: how many. */
static size_t release(struct solver_state *solving, const double *parameters)
{
    size_t count = 0;
    for (size_t i = 0; i < solving->problem->parameter_count; i++) {
        if (solving->held[i] && !falls_outwards(solving, parameters, i) &&
            fabs(solving->gradient[i]) > 0) {
            solving->held[i] = false;
            count++;
        }
    }
    return count;
}

static size_t count_free(const struct solver_state *solving)
{
    size_t count = 0;
    for (size_t i = 0; i < solving->problem->parameter_count; i++) {
        count += !solving->held[i];
    }
    return count;
}

/* One round over the parameters that are not held. */
static void run_round(struct solver_state *solving, double *parameters,
                      struct solver_summary *summary, struct engine_run *run)
{
    size_t n = solving->problem->parameter_count;
    bool *is_free = ARENA_ARRAY(solving->arena, n, bool);
    for (size_t i = 0; i < n; i++) {
        is_free[i] = !solving->held[i];
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

static enum solver_status solver_status_of(const struct solver_state *solving,
                                           const struct engine_run *run)
{
    if (solving->stopped) {
        return SOLVER_STOPPED;
    }
    if (run->end == ENGINE_FAILED) {
        return SOLVER_STUCK;
    }
    if (run->end == ENGINE_LIMIT) {
        return SOLVER_LIMIT;
    }
    return SOLVER_CONVERGED;
}

static void tell_end(const struct solver_state *solving, const struct engine_run *run,
                     struct solver_summary *summary)
{
    summary->status = solver_status_of(solving, run);
    summary->message = arena_printf(solving->arena, "%s", run->message);
}

/* One round of an engine that keeps bounds by itself. */
static void solver_run_once(struct solver_state *solving, double *parameters,
                            struct solver_summary *summary)
{
    struct engine_run run;
    run_round(solving, parameters, summary, &run);
    tell_end(solving, &run, summary);
    memcpy(solving->held, solving->at_bound, solving->problem->parameter_count * sizeof(bool));
}

/* Rounds until no parameter is newly held and none wants to be let go. */
static void run_rounds(struct solver_state *solving, double *parameters,
                       struct solver_summary *summary)
{
    struct engine_run run = {.end = ENGINE_CONVERGED};
    double best = summary->initial_cost, cost = best;
    size_t releases = 0, n = solving->problem->parameter_count;
    hold(solving, parameters);
    while (summary->iterations < solving->options.iterations) {
        if (count_free(solving) > 0) {
            run_round(solving, parameters, summary, &run);
        } else {
            run = (struct engine_run){.end = ENGINE_CONVERGED, .message = "all is at its bounds"};
        }
        if (solving->stopped || run.end == ENGINE_FAILED ||
            !solving_look(solving, parameters, &cost)) {
            break;
        }
        if (hold(solving, parameters) > 0 || run.end == ENGINE_WATCHED) {
            continue;
        }
        if (run.end == ENGINE_LIMIT || releases++ > 4 * n || release(solving, parameters) == 0) {
            break;
        }
        if (releases > 1 && !(cost < best)) {
            break; /* what was let go brought nothing */
        }
        best = cost;
    }
    run.end = run.end == ENGINE_WATCHED && !solving->stopped ? ENGINE_LIMIT : run.end;
    tell_end(solving, &run, summary);
}

static void open_summary(struct solver_summary *summary, size_t n, struct arena *arena)
{
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
}

static double or_usual(double value, double otherwise)
{
    return value > 0 ? value : otherwise;
}

static struct solver_options solver_complete(const struct solver_options *options)
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
    const struct solver_options all = solver_complete(options);
    if (!solver_check(problem, &all, parameters, error)) {
        return false;
    }
    struct solver_problem sided = *problem, plain = solver_without_sides(&sided);
    if (problem->sides != NULL && !solver_engines[all.engine].keeps_bounds) {
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
    open_summary(summary, n, arena);
    if (!solving_look(&solving, parameters, &summary->initial_cost)) {
        return fail(error, ERROR_DOMAIN,
                    "the fit cannot begin: not all residuals and derivatives are numbers there");
    }
    (solving.engine->keeps_bounds ? solver_run_once : run_rounds)(&solving, parameters, summary);
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
    solving_tell(&solving, summary);
    if (!all.lean) {
        solving_errors(&solving, summary);
    }
    return true;
}
