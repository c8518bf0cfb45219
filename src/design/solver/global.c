/* design/solver/global.c - the best of many minima: starts, and ways out of each. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/global.h"

#include "base/random.h"
#include "base/sobol.h"
#include "design/solver/escape.h"

#include <math.h>
#include <string.h>

/*
 * Hills: their height against the merit of the best minimum, their width in scales, how far from
 * the top a way out begins, in widths, and with how little gain it ends. Tried on a double Gauss
 * and a triplet from plates: lower hills come back, wider ones miss what is near, and who begins
 * farther off lands where no ray arrives.
 */
static const double height = 300, width = 2.5, aside = 0.2, way_gain = 1e-3;
enum { WAY_ITERATIONS = 50, NEARER = 4 };

/* Steps that gain a smaller share of the cost are the last ones of a descent. */
static const double least_gain = 1e-5;

/* Closer than this, in scales, they are one. */
static const double same = 0.1;

/* Exact residuals are met to this: later steps do better. */
static const double met = 1e-6;

void global_start(const struct global_search *search, uint32_t number, double *parameters)
{
    for (uint32_t j = 0; j < search->problem->parameter_count; j++) {
        double unit = random_unit(search->seed, number, j);
        if (j < SOBOL_DIMENSIONS) {
            struct sobol sobol;
            sobol_open(j, &sobol);
            unit = sobol_point(&sobol, sobol_scrambling(search->seed, 0, j), number);
        }
        parameters[j] = search->low[j] + unit * (search->high[j] - search->low[j]);
    }
}

bool global_is_same(const struct solver_problem *problem, const double *a, const double *b)
{
    return escape_distance(problem, a, b) < same;
}

bool global_is_better(const struct global_minimum *one, const struct global_minimum *other)
{
    const bool is_met = one->excess <= met, other_is_met = other->excess <= met;
    return is_met != other_is_met ? is_met : one->cost < other->cost;
}

/* A chain as it grows. */
struct chain_state {
    const struct global_search *search;
    struct global_chain *chain;
    struct arena *arena;
    uint32_t number;
    double *numbers; /* where it is */
    struct escape_hill *hills;
};

static bool global_goes_on(void *context, const struct solver_progress *progress)
{
    struct chain_state *chaining = context;
    const struct global_search *search = chaining->search;
    (void)progress;
    if (search->goes_on != NULL && !search->goes_on(search->context)) {
        chaining->chain->is_stopped = true;
    }
    return !chaining->chain->is_stopped;
}

/* Down from where it is. Result: false: there is no value, or it is to stop */
static bool global_chain_descend(struct chain_state *chaining, const struct solver_problem *problem,
                                 int iterations, double gain, struct global_minimum *minimum)
{
    const struct solver_options options = {.iterations = iterations,
                                           .function = gain,
                                           .lean = true,
                                           .progress = global_goes_on,
                                           .progress_context = chaining};
    const struct arena_mark mark = arena_mark(chaining->arena);
    struct solver_summary summary;
    struct error ignored;
    const bool done =
        solver_run(problem, &options, chaining->numbers, chaining->arena, &summary, &ignored);
    chaining->chain->evaluations += done ? summary.evaluations : 1;
    if (done) {
        *minimum = (struct global_minimum){chaining->numbers, summary.final_cost, summary.excess};
    }
    arena_reset(chaining->arena, mark);
    return done && !chaining->chain->is_stopped;
}

/* Down to a minimum, which is kept if it is a new one. */
static void find_minimum(struct chain_state *chaining)
{
    const struct global_search *search = chaining->search;
    const size_t n = search->problem->parameter_count;
    struct global_chain *chain = chaining->chain;
    struct global_minimum found;
    if (!global_chain_descend(chaining, search->problem, search->iterations, least_gain, &found)) {
        return;
    }
    for (size_t i = 0; i < chain->count; i++) {
        struct global_minimum *known = &chain->minima[i];
        if (global_is_same(search->problem, known->parameters, found.parameters)) {
            return;
        }
    }
    found.parameters = ARENA_ARRAY(chaining->arena, n, double);
    memcpy(found.parameters, chaining->numbers, n * sizeof(double));
    chain->minima[chain->count++] = found;
}

/* So far aside, in a direction by chance: on top of a hill nothing pulls. */
static void step_aside(struct chain_state *chaining, const double *from, uint32_t attempt,
                       double length)
{
    const struct solver_problem *problem = chaining->search->problem;
    const uint32_t n = (uint32_t)problem->parameter_count;
    double *to = chaining->numbers, sum = 0;
    for (uint32_t j = 0; j < n; j++) {
        const struct random_words words =
            random_words(RANDOM_ESCAPES, chaining->search->seed, chaining->number, attempt * n + j);
        to[j] = 2 * random_unit_of(words.w[0], words.w[1]) - 1;
        sum += to[j] * to[j];
    }
    for (uint32_t j = 0; j < n; j++) {
        to[j] = from[j] + to[j] / sqrt(sum) * length * problem->scale[j];
        to[j] = problem->low != NULL ? fmax(to[j], problem->low[j]) : to[j];
        to[j] = problem->high != NULL ? fmin(to[j], problem->high[j]) : to[j];
    }
}

/* One way out, from as far aside as there is a value. */
static void find_way(struct chain_state *chaining, uint32_t attempt)
{
    const struct global_search *search = chaining->search;
    struct global_chain *chain = chaining->chain;
    const struct global_minimum *from = &chain->minima[0];
    for (size_t i = 1; i < chain->count; i++) {
        from = global_is_better(&chain->minima[i], from) ? &chain->minima[i] : from;
    }
    struct escape escape = {search->problem, chaining->hills, chain->count};
    struct global_minimum ignored;
    double length = aside * width;
    for (size_t i = 0; i < chain->count; i++) {
        chaining->hills[i] =
            (struct escape_hill){chain->minima[i].parameters, height * 2 * from->cost, width};
    }
    const struct solver_problem problem = escape_problem(&escape);
    for (int i = 0; i < NEARER && !chain->is_stopped; i++, length /= 2) {
        step_aside(chaining, from->parameters, attempt, length);
        if (global_chain_descend(chaining, &problem, WAY_ITERATIONS, way_gain, &ignored)) {
            find_minimum(chaining);
            return;
        }
    }
}

void global_descend(const struct global_search *search, uint32_t number, const double *parameters,
                    struct arena *arena, struct global_chain *chain)
{
    const size_t n = search->problem->parameter_count, most = (size_t)search->escapes + 1;
    struct chain_state chaining = {.search = search,
                                   .chain = chain,
                                   .arena = arena,
                                   .number = number,
                                   .numbers = ARENA_ARRAY(arena, n, double),
                                   .hills = ARENA_ARRAY(arena, most, struct escape_hill)};
    *chain = (struct global_chain){.minima = ARENA_ARRAY(arena, most, struct global_minimum)};
    memcpy(chaining.numbers, parameters, n * sizeof(double));
    find_minimum(&chaining);
    for (int i = 0; i < search->escapes && chain->count > 0 && !chain->is_stopped; i++) {
        find_way(&chaining, (uint32_t)i);
    }
}
