/* design/relocate.c - out of minima of a search by elements that are put in elsewhere. */
/* SPDX-License-Identifier: MIT */
#include "design/relocate.h"

#include "base/parallel.h"
#include "design/degenerate.h"
#include "design/null_element.h"

#include <math.h>
#include <string.h>

/* How far a meniscus is bent, and how little of its natural scale a number that is held may move:
   the solver wants room. */
static const double bend = 0.05, held = 1e-6;

/* Lenses whose merits differ by a smaller share lie in one valley. */
static const double valley = 1e-3;

/* Steps with the meniscus held, and that gain a smaller share are the last. */
enum { HELD_ITERATIONS = 50 };
static const double held_gain = 1e-3, least_gain = 1e-5;

/* What the two sides of one move led to. */
struct relocation {
    struct global_minimum minima[2];
    size_t count;
    long evaluations;
    bool is_stopped;
};

/* One lens, and its moves. */
struct relocation_run {
    struct optimize_global *global;
    size_t start;
    const double *from;
    struct relocation *done; /* of each move */
};

static bool relocation_goes_on(void *context, const struct solver_progress *progress)
{
    const struct optimize_global *global = context;
    (void)progress;
    return global->goes_on == NULL || global->goes_on(global->context);
}

/* Down from there. Result: false: it has no value there, or is to stop */
static bool relocation_descend(const struct relocation_run *running,
                               const struct solver_problem *problem, int iterations, double gain,
                               double *numbers, struct relocation *done,
                               struct global_minimum *minimum)
{
    struct arena own = {0};
    struct solver_summary summary;
    struct error ignored;
    const struct solver_options options = {.iterations = iterations,
                                           .function = gain,
                                           .lean = true,
                                           .progress = relocation_goes_on,
                                           .progress_context = running->global};
    const bool found = solver_run(problem, &options, numbers, &own, &summary, &ignored);
    done->evaluations += found ? summary.evaluations : 1;
    if (found) {
        *minimum = (struct global_minimum){numbers, summary.final_cost, summary.excess};
        done->is_stopped = done->is_stopped || summary.status == SOLVER_STOPPED;
    }
    arena_free(&own);
    return found && !done->is_stopped;
}

/* One move, with merits and numbers of its own. */
static void relocation_try(const struct relocation_run *running, size_t number, struct arena *own,
                           struct arena *kept)
{
    struct relocation *done = &running->done[number];
    struct global_fresh fresh;
    struct null_elements elements;
    struct global_minimum minimum;
    struct error ignored;
    if (!optimize_global_fresh(optimize_global_merit(running->global, running->start), own, &fresh,
                               &ignored)) {
        return;
    }
    struct variables *variables = &fresh.variables;
    const size_t n = variables->count;
    const struct solver_problem problem = optimize_problem(&fresh.merit);
    const struct optimize_task task = {.merit = &fresh.merit,
                                       .goes_on = running->global->goes_on,
                                       .context = running->global->context};
    double *low = ARENA_ARRAY(own, n, double), *high = ARENA_ARRAY(own, n, double);
    double *numbers = ARENA_ARRAY(own, n, double);
    bool *is_null = ARENA_ARRAY(own, n, bool);
    const char *words;
    null_elements_open(variables, own, &elements);
    const struct null_move *move = &elements.moves[number];
    null_elements_move(&elements, move, running->from, numbers, is_null);
    memcpy(low, variables->low, n * sizeof *low);
    memcpy(high, variables->high, n * sizeof *high);
    for (size_t j = 0; j < n; j++) {
        const double room = held * variables->scale[j];
        variables->low[j] = is_null[j] ? fmax(low[j], numbers[j] - room) : low[j];
        variables->high[j] = is_null[j] ? fmin(high[j], numbers[j] + room) : high[j];
    }
    if (!optimize_begin(&task, numbers, own, &words, &ignored) ||
        !relocation_descend(running, &problem, HELD_ITERATIONS, held_gain, numbers, done,
                            &minimum)) {
        return;
    }
    memcpy(variables->low, low, n * sizeof *low);
    memcpy(variables->high, high, n * sizeof *high);
    for (int side = -1; side <= 1; side += 2) {
        double *found = ARENA_ARRAY(kept, n, double);
        memcpy(found, numbers, n * sizeof *found);
        null_elements_bend(&elements, move, side * bend, found);
        if (relocation_descend(running, &problem, running->global->iterations, least_gain, found,
                               done, &minimum) &&
            degenerate_words(&fresh.merit, variables_lens(&fresh.variables, found, own), own) ==
                NULL) {
            done->minima[done->count++] = minimum;
        }
    }
}

static void relocation_work(void *context, const struct parallel_piece *piece)
{
    const struct relocation_run *running = context;
    for (size_t i = piece->begin; i < piece->end; i++) {
        struct arena own = {0};
        if (relocation_goes_on(running->global, NULL)) {
            relocation_try(running, i, &own, piece->arena);
        }
        arena_free(&own);
    }
}

/* The best that is none of those that it has been done with; null: there is no other. */
static const struct global_minimum *relocation_next(const struct optimize_global *global,
                                                    const struct global_minimum *const *done,
                                                    const size_t *starts, size_t count,
                                                    size_t *start)
{
    const struct global_minimum *best = NULL;
    for (size_t k = 0; k < global->start_count; k++) {
        const struct global_result *result = &global->results[k];
        for (size_t i = 0; i < result->count + result->moved_count; i++) {
            const struct global_minimum *one = global_result_minimum(result, i);
            bool is_new = best == NULL || global_is_better(one, best);
            for (size_t m = 0; m < count && is_new; m++) {
                is_new = fabs(one->cost / done[m]->cost - 1) > valley &&
                         !optimize_global_same(global, starts[m], done[m]->parameters, k,
                                               one->parameters);
            }
            if (is_new) {
                best = one;
                *start = k;
            }
        }
    }
    return best;
}

/* Keep what all moves of a lens led to. */
static void relocation_keep(const struct relocation_run *running, size_t moves, struct arena *arena)
{
    struct global_result *result = &running->global->results[running->start];
    const size_t most = result->moved_count + 2 * moves;
    struct global_minimum *moved = ARENA_ARRAY(arena, most + 1, struct global_minimum);
    size_t count = result->moved_count;
    if (count > 0) {
        memcpy(moved, result->moved, count * sizeof *moved);
    }
    for (size_t i = 0; i < moves; i++) {
        const struct relocation *done = &running->done[i];
        running->global->moved_evaluations += done->evaluations;
        memcpy(moved + count, done->minima, done->count * sizeof *moved);
        count += done->count;
    }
    result->moved = moved;
    result->moved_count = count;
}

void optimize_relocate(struct optimize_global *global, size_t most, struct arena *arena)
{
    struct parallel *team = ARENA_NEW(arena, struct parallel);
    const struct global_minimum **done =
        ARENA_ARRAY(arena, most + 1, const struct global_minimum *);
    size_t *starts = ARENA_ARRAY(arena, most + 1, size_t);
    team->threads = global->threads;
    for (size_t count = 0; count < most && relocation_goes_on(global, NULL); count++) {
        struct relocation_run running = {.global = global};
        struct null_elements elements;
        done[count] = relocation_next(global, done, starts, count, &running.start);
        if (done[count] == NULL) {
            break;
        }
        starts[count] = running.start;
        running.from = done[count]->parameters;
        null_elements_open(optimize_global_merit(global, running.start)->question.variables, arena,
                           &elements);
        running.done = ARENA_ARRAY(arena, elements.move_count + 1, struct relocation);
        parallel_pieces(team, elements.move_count, 1, relocation_work, &running);
        relocation_keep(&running, elements.move_count, arena);
    }
    for (int i = 0; i < global->threads; i++) {
        arena_adopt(arena, &team->arenas[i]);
    }
    parallel_free(team);
}
