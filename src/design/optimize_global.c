/* design/optimize_global.c - the best lenses that are found from starts between bounds. */
/* SPDX-License-Identifier: MIT */
#include "design/optimize_global.h"

#include "base/parallel.h"
#include "design/degenerate.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    STARTS_A_THREAD = 4, /* from one pause to the next */
    STARTS_LOOKED_AT = 4 /* for variables that nothing depends on */
};

/* -------- where starts lie -------- */

struct global_range optimize_global_range(const struct variables *variables, double spread,
                                          struct arena *arena)
{
    double *low = ARENA_ARRAY(arena, variables->count + 1, double);
    double *high = ARENA_ARRAY(arena, variables->count + 1, double);
    bool *is_spread = ARENA_ARRAY(arena, variables->count + 1, bool);
    for (size_t j = 0; j < variables->count; j++) {
        const double at = variables->start[j], reach = spread * variables->scale[j];
        low[j] = variables->low[j];
        high[j] = variables->high[j];
        is_spread[j] = isinf(low[j]) || isinf(high[j]);
        if (is_spread[j]) {
            low[j] = fmax(low[j], at - reach);
            high[j] = fmin(high[j], at + reach);
        }
    }
    return (struct global_range){low, high, is_spread};
}

/* -------- one lens -------- */

bool optimize_global_fresh(const struct merit *like, struct arena *arena,
                           struct global_fresh *fresh, struct error *error)
{
    struct merit_question question = like->question;
    const struct variables *variables = question.variables;
    question.variables = &fresh->variables;
    return variables_open(variables->lens, variables->list, variables->count, arena,
                          &fresh->variables, error) &&
           merit_open(&question, arena, &fresh->merit, error);
}

/* -------- the search -------- */

struct global_run {
    struct optimize_global *global;
    struct global_range *ranges; /* of each layout */
    size_t first;                /* of the starts of this round */
};

static struct global_run global_run_of(struct optimize_global *global, struct arena *arena)
{
    struct global_run searching = {.global = global, .first = global->begin};
    searching.ranges = ARENA_ARRAY(arena, global->layouts, struct global_range);
    for (size_t i = 0; i < global->layouts; i++) {
        const struct variables *variables = global->merits[i]->question.variables;
        searching.ranges[i] = optimize_global_range(variables, global->spread, arena);
    }
    return searching;
}

static struct global_search search_of(const struct global_run *searching, size_t start,
                                      const struct solver_problem *problem)
{
    const struct optimize_global *global = searching->global;
    const struct global_range *range = &searching->ranges[start % global->layouts];
    return (struct global_search){.problem = problem,
                                  .low = range->low,
                                  .high = range->high,
                                  .seed = global->seed,
                                  .escapes = global->escapes,
                                  .iterations = global->iterations,
                                  .goes_on = global->goes_on,
                                  .context = global->context};
}

/* A start that has a merit, as it is or made so. */
static bool begin_at(const struct global_run *searching, const struct global_search *search,
                     size_t start, struct merit *merit, double *numbers)
{
    const struct optimize_task task = {.merit = merit,
                                       .goes_on = searching->global->goes_on,
                                       .context = searching->global->context};
    const char *ignored;
    struct error why;
    const struct optimize_global *global = searching->global;
    if (global->place != NULL) {
        if (!global->place(global->context, start, merit->arena, numbers)) {
            return false;
        }
    } else if (start == 0) {
        variables_get(merit->question.variables, numbers);
    } else {
        global_start(search, (uint32_t)(start - 1), numbers);
    }
    return optimize_begin(&task, numbers, merit->arena, &ignored, &why);
}

bool optimize_global_idle(struct optimize_global *global, struct arena *arena, bool *is_idle)
{
    const struct global_run searching = global_run_of(global, arena);
    const struct merit *merit = global->merits[0];
    const size_t n = merit->variable_count, m = merit->residual_count;
    double *numbers = ARENA_ARRAY(arena, n + 1, double);
    double *residuals = ARENA_ARRAY(arena, m + 1, double);
    double *jacobian = ARENA_ARRAY(arena, m * n + 1, double);
    bool found = false;
    for (size_t j = 0; j < n; j++) {
        is_idle[j] = true;
    }
    for (size_t start = 0; start < STARTS_LOOKED_AT && start < global->start_count; start++) {
        struct global_fresh fresh;
        struct error ignored;
        if (!optimize_global_fresh(merit, arena, &fresh, &ignored)) {
            continue;
        }
        const struct solver_problem problem = optimize_problem(&fresh.merit);
        const struct global_search search = search_of(&searching, start, &problem);
        if (begin_at(&searching, &search, start, &fresh.merit, numbers) &&
            merit_measure(&fresh.merit, numbers, residuals, jacobian)) {
            merit_drop_met(&fresh.merit, residuals, NULL);
            optimize_find_effects(&fresh.merit, residuals, jacobian, is_idle);
            found = true;
        }
    }
    return found;
}

static bool global_run_goes_on(const struct optimize_global *global)
{
    return !watch_is_ended(global->watch) &&
           (global->goes_on == NULL || global->goes_on(global->context));
}

/* "a ray is lost at surface 3 (miss)" as people say it; others as they are. */
static const char *global_ray_words(const char *words, struct arena *arena)
{
    static const char lost[] = "a ray is lost at surface ";
    static const char *const says[][2] = {{" (miss)", "misses"},
                                          {" (total_reflection)", "is totally reflected at"},
                                          {" (clipped)", "is clipped at"},
                                          {" (not_converged)", "is not found at"}};
    if (strncmp(words, lost, strlen(lost)) == 0) {
        const char *number = words + strlen(lost), *end = number + strspn(number, "0123456789");
        for (size_t i = 0; i < sizeof says / sizeof says[0]; i++) {
            if (strcmp(end, says[i][0]) == 0) {
                return arena_printf(arena, "a ray %s surface %.*s", says[i][1], (int)(end - number),
                                    number);
            }
        }
    }
    return words;
}

/* Why a start is lost, without what differs from start to start: numbers of rays and fields. */
static const char *global_lost_words(const char *message, struct arena *arena)
{
    static const char digits[] = "0123456789.", of[] = " of ", of_field[] = " of field ";
    char *words = ARENA_ARRAY(arena, strlen(message) + 1, char);
    const char *from = message + strspn(message, digits);
    size_t used = 0;
    if (from > message && strncmp(from, of, strlen(of)) == 0) { /* "2 of 36 rays" */
        from += strlen(of);
        from += strspn(from, digits);
        from += *from == ' ';
    } else {
        from = message;
    }
    while (*from != '\0') {
        if (strncmp(from, of_field, strlen(of_field)) == 0) {
            from += strlen(of_field);
            from += strspn(from, digits);
        } else {
            words[used++] = *from++;
        }
    }
    words[used] = '\0';
    return used > 0 ? global_ray_words(words, arena) : "its goals have no value";
}

/* Of the minima those that are lenses. */
static void global_drop_degenerate(const struct merit *merit, struct arena *arena,
                                   struct global_result *result)
{
    size_t count = 0;
    for (size_t i = 0; i < result->count; i++) {
        const struct lens *lens =
            variables_lens(merit->question.variables, result->minima[i].parameters, arena);
        const char *wrong = degenerate_words(merit, lens, arena);
        result->lost = wrong != NULL ? wrong : result->lost;
        if (wrong == NULL) {
            result->minima[count++] = result->minima[i];
        }
    }
    result->count = count;
}

/*
 * What a start leads to.
 *
 * Given     own  for merits, which keep what they have found in theirs
 * Result    false: it was stopped before
 */
static bool global_search_start(struct global_run *searching, size_t start, struct arena *own,
                                struct arena *arena, struct global_result *result)
{
    const struct optimize_global *global = searching->global;
    struct global_chain chain = {0};
    struct global_fresh fresh;
    struct error why;
    *result = (struct global_result){.is_done = true};
    if (!optimize_global_fresh(optimize_global_merit(global, start), own, &fresh, &why)) {
        result->lost = global_lost_words(why.message, arena);
        return true;
    }
    const struct solver_problem problem = optimize_problem(&fresh.merit);
    const struct global_search search = search_of(searching, start, &problem);
    double *numbers = ARENA_ARRAY(own, fresh.variables.count + 1, double);
    /* where rays are just lost, some are found only from a lens that still has them */
    for (int attempt = 0; attempt < 2 && chain.count == 0 && !chain.is_stopped; attempt++) {
        fresh.merit.forgets = attempt > 0;
        if (!begin_at(searching, &search, start, &fresh.merit, numbers)) {
            result->lost = global_lost_words(fresh.merit.why.message, arena);
            return global->goes_on == NULL || global->goes_on(global->context);
        }
        global_descend(&search, (uint32_t)start, numbers, arena, &chain);
        result->evaluations += chain.evaluations;
    }
    result->count = chain.count;
    result->minima = chain.minima;
    result->lost = global_lost_words(fresh.merit.why.message, arena);
    global_drop_degenerate(&fresh.merit, arena, result);
    return !chain.is_stopped;
}

/* The best so far, and what is lost. */
static void global_count(struct optimize_global *global, const struct global_result *result)
{
    double best = atomic_load(&global->best);
    for (size_t i = 0; i < result->count; i++) {
        const double here = 2 * result->minima[i].cost;
        while (here < best && !atomic_compare_exchange_weak(&global->best, &best, here)) {
            /* another thread was quicker: `best` is its own */
        }
    }
    atomic_fetch_add(&global->losses, result->count == 0);
}

void optimize_global_tell(const void *context, char *words, size_t room)
{
    const struct optimize_global *global = context;
    const double best = atomic_load(&global->best);
    const size_t losses = atomic_load(&global->losses);
    size_t used = 0;
    if (isfinite(best)) {
        used = (size_t)snprintf(words, room, "best merit %.4g", best);
    }
    if (losses > 0 && used < room) {
        snprintf(words + used, room - used, "%s%zu lost", used > 0 ? "  " : "", losses);
    }
}

static void optimize_global_work(void *context, const struct parallel_piece *piece)
{
    struct global_run *searching = context;
    struct optimize_global *global = searching->global;
    for (size_t k = searching->first + piece->begin; k < searching->first + piece->end; k++) {
        struct arena own = {0};
        struct global_result result;
        if (global->results[k].is_done || !global_run_goes_on(global)) {
            continue;
        }
        if (global_search_start(searching, k, &own, piece->arena, &result)) {
            global->results[k] = result;
            global_count(global, &result);
            if (global->found != NULL && result.count > 0) {
                global->found(global->context, k);
            }
            watch_add(global->watch, 1);
        }
        arena_free(&own);
    }
}

void optimize_global_search(struct optimize_global *global, struct arena *arena)
{
    const size_t all = global->end - global->begin;
    const size_t round = global->pause == NULL ? all : (size_t)global->threads * STARTS_A_THREAD;
    struct global_run searching = global_run_of(global, arena);
    struct parallel *team = ARENA_NEW(arena, struct parallel);
    atomic_store(&global->best, INFINITY);
    atomic_store(&global->losses, 0);
    for (size_t k = 0; k < global->start_count; k++) { /* those of files */
        if (global->results[k].is_done) {
            global_count(global, &global->results[k]);
        }
    }
    team->threads = global->threads;
    for (; searching.first < global->end; searching.first += round) {
        const size_t left = global->end - searching.first;
        parallel_pieces(team, left < round ? left : round, 1, optimize_global_work, &searching);
        if (!global_run_goes_on(global)) {
            break;
        }
        if (global->pause != NULL) {
            global->pause(global->context);
        }
    }
    for (int i = 0; i < global->threads; i++) {
        arena_adopt(arena, &team->arenas[i]);
    }
    parallel_free(team);
}

/* -------- the best -------- */

/* A minimum, and which start it is of. */
struct candidate {
    const struct global_minimum *minimum;
    size_t start;
};

/* The best first; of two alike that of the earlier start. */
static int optimize_global_order(const struct candidate *a, const struct candidate *b)
{
    if (global_is_better(a->minimum, b->minimum)) {
        return -1;
    }
    if (global_is_better(b->minimum, a->minimum)) {
        return 1;
    }
    return a->start < b->start ? -1 : a->start > b->start;
}

static int optimize_global_compare(const void *one, const void *other)
{
    return optimize_global_order(one, other);
}

static int compare_kept(const void *one, const void *other)
{
    const struct global_kept *a = one, *b = other;
    const struct global_minimum first = {NULL, a->answer.after.merit, a->answer.summary.excess},
                                second = {NULL, b->answer.after.merit, b->answer.summary.excess};
    return optimize_global_order(&(struct candidate){&first, a->start},
                                 &(struct candidate){&second, b->start});
}

/* In natural scales of the layout of a start. */
static struct solver_problem problem_of_start(const struct optimize_global *global, size_t start)
{
    const struct merit *merit = optimize_global_merit(global, start);
    return (struct solver_problem){.parameter_count = merit->variable_count,
                                   .scale = merit->question.variables->scale};
}

bool optimize_global_same(const struct optimize_global *global, size_t start, const double *numbers,
                          size_t other, const double *others)
{
    const struct solver_problem problem = problem_of_start(global, start);
    return start % global->layouts == other % global->layouts &&
           global_is_same(&problem, numbers, others);
}

/* Does a lens that is there already lie there? */
static bool kept_is_known(const struct optimize_global *global, const struct global_kept *kept,
                          size_t count, size_t start, const double *numbers)
{
    bool found = false;
    for (size_t i = 0; i < count; i++) {
        found = found || optimize_global_same(global, kept[i].start, kept[i].answer.after.numbers,
                                              start, numbers);
    }
    return found;
}

size_t optimize_global_keep(struct optimize_global *global, const struct optimize_task *task,
                            size_t most, struct arena *arena, struct global_kept *kept)
{
    size_t candidates = 0, count = 0, tried = 0;
    for (size_t k = 0; k < global->start_count; k++) {
        candidates += global->results[k].count + global->results[k].moved_count;
    }
    struct candidate *list = ARENA_ARRAY(arena, candidates + 1, struct candidate), *at = list;
    for (size_t k = 0; k < global->start_count; k++) {
        const struct global_result *result = &global->results[k];
        for (size_t i = 0; i < result->count + result->moved_count; i++) {
            *at++ = (struct candidate){global_result_minimum(result, i), k};
        }
    }
    qsort(list, candidates, sizeof *list, optimize_global_compare);
    /* what ends in one minimum may have stopped here and there in its valley */
    const size_t most_tried = 8 * most + 16;
    for (size_t i = 0; i < candidates && count < most && tried < most_tried; i++) {
        struct global_kept *one = &kept[count];
        struct optimize_task fine = *task;
        struct error ignored;
        if (count > 0 && watch_is_ended(global->watch)) {
            break; /* who interrupts gets the best, and does not wait for others */
        }
        fine.start = list[i].minimum->parameters;
        if (kept_is_known(global, kept, count, list[i].start, fine.start)) {
            continue;
        }
        tried++;
        /* down to its minimum */
        struct global_fresh *fresh = ARENA_NEW(arena, struct global_fresh);
        fine.merit = &fresh->merit;
        one->begun = fine.start;
        one->start = list[i].start;
        if (!optimize_global_fresh(optimize_global_merit(global, one->start), arena, fresh,
                                   &ignored) ||
            !optimize_run(&fine, arena, &one->answer, &ignored) ||
            kept_is_known(global, kept, count, one->start, one->answer.after.numbers)) {
            continue;
        }
        const struct lens *lens =
            variables_lens(&fresh->variables, one->answer.after.numbers, arena);
        const bool is_lens = degenerate_words(&fresh->merit, lens, arena) == NULL &&
                             (global->accepts == NULL || global->accepts(global->context, lens));
        count += is_lens;
        global->refused += !is_lens;
    }
    /* starts with a minimum there, or where its last descent began */
    for (size_t i = 0; i < count; i++) {
        for (size_t k = 0; k < global->start_count; k++) {
            bool hit = false;
            const struct global_result *result = &global->results[k];
            for (size_t m = 0; m < result->count + result->moved_count; m++) {
                const double *found = global_result_minimum(result, m)->parameters;
                const struct global_kept *one = &kept[i];
                hit = hit || optimize_global_same(global, k, found, one->start, one->begun) ||
                      optimize_global_same(global, k, found, one->start, one->answer.after.numbers);
            }
            kept[i].hits += hit;
        }
    }
    qsort(kept, count, sizeof *kept, compare_kept);
    return count;
}
