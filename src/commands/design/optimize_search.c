/* commands/design/optimize_search.c - optimize --global: the best of many starts. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include "base/parallel.h"
#include "cli/interrupt.h"
#include "cli/progress.h"

#include <math.h>
#include <stdlib.h>

/* Of the few lenses that are kept; where there is no time left, fewer. */
enum { LAST_ITERATIONS = 1000, CUT_ITERATIONS = 50 };

size_t optimize_keep_count(const void *data)
{
    const struct optimize_input *input = data;
    return optimize_is_global(input) ? (size_t)input->keep : 1;
}

/* Now and then. */
static void keep_state(void *context)
{
    const struct optimize_job *job = context;
    optimize_part_pause(job->part);
}

/* Once an iteration, from any thread: the watch itself looks no sooner than a start is done. */
static bool optimize_search_goes_on(void *context)
{
    const struct optimize_job *job = context;
    if (job->run->watch != NULL && interrupt_came()) {
        atomic_store(&job->run->watch->is_ended, true);
    }
    return !watch_is_ended(job->run->watch) && progress_clock() < job->until;
}

/* -------- variables that nothing depends on -------- */

/* They would only make lenses different that are not: the search goes on without them. */
static bool drop_idle(struct optimize_job *job, struct optimize_global *global,
                      const struct merit_question *asked, struct error *error)
{
    struct arena *arena = job->run->arena;
    struct variables all = job->variables;
    struct variable *list = ARENA_ARRAY(arena, all.count + 1, struct variable);
    const char **names = ARENA_ARRAY(arena, all.count + 1, const char *);
    bool *is_idle = ARENA_ARRAY(arena, all.count + 1, bool);
    size_t count = 0;
    if (!optimize_global_idle(global, arena, is_idle)) {
        return true;
    }
    for (size_t i = 0; i < all.count; i++) {
        if (is_idle[i]) {
            optimize_warn(job, "no goal depends on %s: it stays as it is", job->names[i]);
        } else {
            names[count] = job->names[i];
            list[count++] = all.list[i];
        }
    }
    if (count == all.count || count == 0) {
        return true;
    }
    struct merit_question question = *asked;
    job->names = names;
    question.variable_count = count;
    question.operands = job->merit.question.operands;
    question.operand_count = job->merit.question.operand_count;
    return variables_open(job->lens, list, count, arena, &job->variables, error) &&
           merit_open(&question, arena, &job->merit, error);
}

/* -------- what was searched, in words -------- */

static const char *range_in_words(const struct optimize_job *job)
{
    const struct optimize_input *input = job->input;
    struct arena *arena = job->run->arena;
    const struct global_range range = optimize_global_range(&job->variables, input->spread, arena);
    const char *names = NULL, *plural = input->spread == 1 ? "" : "s";
    size_t count = 0;
    for (size_t i = 0; i < job->variables.count; i++) {
        const char *name = job->variables.list[i].name;
        if (range.is_spread[i]) {
            names = names == NULL ? name : arena_printf(arena, "%s %s", names, name);
            count++;
        }
    }
    if (count == 0) {
        return "between their bounds";
    }
    if (count == job->variables.count) {
        return arena_printf(arena, "within %.4g natural scale%s of the lens", input->spread,
                            plural);
    }
    return arena_printf(arena,
                        "between their bounds, of %s within %.4g natural scale%s of the lens",
                        names, input->spread, plural);
}

/* -------- the search -------- */

static int optimize_search_compare(const void *one, const void *other)
{
    const double a = *(const double *)one, b = *(const double *)other;
    return (a > b) - (a < b);
}

/* How many starts are to be done: all, or those of the part. */
static size_t wanted_of(const struct optimize_job *job, const struct optimize_global *global)
{
    return job->run->parts != NULL ? global->start_count : global->end - global->begin;
}

/* How many starts are done; what they cost, and their ends. */
static size_t count_done(struct optimize_job *job, const struct optimize_global *global)
{
    size_t done = 0;
    job->ends = ARENA_ARRAY(job->run->arena, global->start_count, double);
    for (size_t k = 0; k < global->start_count; k++) {
        const struct global_result *result = &global->results[k];
        double best = INFINITY;
        done += result->is_done;
        job->evaluations += result->evaluations;
        for (size_t i = 0; i < result->count; i++) {
            best = fmin(best, 2 * result->minima[i].cost);
        }
        if (result->count > 0) {
            job->ends[job->end_count++] = best;
        }
    }
    qsort(job->ends, job->end_count, sizeof(double), optimize_search_compare);
    return done;
}

/* One of the lenses that are kept, as a job of its own. */
static bool take_one(const struct optimize_job *job, const struct global_kept *kept, size_t rank,
                     struct optimize_job *one, struct error *error)
{
    struct error *shortfall = &job->run->shortfall;
    const struct error before = *shortfall;
    *one = *job;
    one->warning = NULL;
    one->answer = kept->answer;
    one->found = variables_lens(&job->variables, kept->answer.after.numbers, job->run->arena);
    one->rank = (long)rank;
    one->hits = (long)kept->hits;
    if (!optimize_judge(one, error)) {
        *shortfall = before;
        return false;
    }
    if (rank > 1) {
        *shortfall = before; /* what the best lacks counts */
    }
    if (one->warning != NULL && optimize_keep_count(job->input) > 1) {
        one->warning = arena_printf(job->run->arena, "lens %zu: %s", rank, one->warning);
    }
    one->warning = lens_warnings_join(job->warning, one->warning, job->run->arena);
    if (job->is_late) {
        one->status = "the time is up";
    }
    if (job->incomplete != NULL) {
        one->status = job->run->parts != NULL ? "incomplete" : "interrupted";
        one->incomplete = job->incomplete;
        fail(shortfall, ERROR_DOMAIN, "%s", job->incomplete);
    }
    return true;
}

/*
 * The last descents. Where the search ended early they are short, so that what it found is brought
 * near its minima, however many seconds are over; else they end with the time.
 */
static size_t descend_last(struct optimize_job *job, const struct optimize_global *global,
                           size_t most, struct global_kept *kept)
{
    struct watch *watch = job->run->watch;
    const bool is_cut = job->is_late || job->incomplete != NULL;
    const int longest = is_cut ? CUT_ITERATIONS : LAST_ITERATIONS;
    const struct optimize_task task = {
        .merit = &job->merit,
        .iterations = global->iterations > 0 ? global->iterations : longest,
        .goes_on = watch_is_ended(watch) ? NULL : optimize_search_goes_on,
        .context = job};
    bool is_stopped = false;
    job->until = is_cut ? INFINITY : job->until;
    const size_t count = optimize_global_keep(global, &task, most, job->run->arena, kept);
    for (size_t i = 0; i < count; i++) {
        job->evaluations += kept[i].answer.summary.evaluations;
        is_stopped = is_stopped || kept[i].answer.summary.status == SOLVER_STOPPED;
    }
    if (watch_is_ended(watch) && job->incomplete == NULL) {
        job->incomplete = "interrupted before all that was found came to its minimum: the best so "
                          "far, incomplete";
    }
    job->is_late = job->is_late || (is_stopped && !watch_is_ended(watch));
    return count;
}

/*
 * The lenses that are kept; what is no lens, as its surfaces lie behind each other, is left out.
 *
 * Result    false: there were some, and all of them are none
 */
static bool take_kept(struct optimize_job *job, const struct optimize_global *global,
                      struct error *error)
{
    const size_t most = optimize_keep_count(job->input);
    struct arena *arena = job->run->arena;
    struct global_kept *kept = ARENA_ARRAY(arena, most, struct global_kept);
    const size_t count = descend_last(job, global, most, kept);
    job->kept = ARENA_ARRAY(arena, count + 1, struct optimize_job);
    for (size_t i = 0; i < count; i++) {
        struct optimize_job *one = &job->kept[job->kept_count];
        job->kept_count += take_one(job, &kept[i], job->kept_count + 1, one, error);
    }
    return count == 0 || job->kept_count > 0;
}

/* Nothing was found: why the lens itself is none. */
static bool fail_empty(struct optimize_job *job, size_t done, struct error *error)
{
    const struct optimize_task task = {
        .merit = &job->merit, .goes_on = optimize_search_goes_on, .context = job};
    if (done == 0) {
        return fail(error, ERROR_DOMAIN, "%s before any start came to its end",
                    watch_is_ended(job->run->watch) ? "interrupted" : "the time was up");
    }
    return optimize_run(&task, job->run->arena, &job->answer, error)
               ? fail(error, ERROR_DOMAIN, "none of %zu starts can be judged", done)
               : error_prefix(error, "none of %zu starts can be judged: ", done);
}

/* All starts that are to be searched; how far it came. */
static void run_search(struct optimize_job *job, struct optimize_global *global)
{
    struct watch *watch = job->run->watch;
    size_t there = 0;
    for (size_t k = global->begin; k < global->end; k++) {
        there += global->results[k].is_done;
    }
    watch_begin(watch, "starts", global->end - global->begin - there);
    optimize_global_search(global, job->run->arena);
    if (job->part->state_path != NULL && watch_is_ended(watch)) {
        optimize_part_save(job->part);
    }
    const size_t done = count_done(job, global), all = wanted_of(job, global);
    const struct optimize_input *input = job->input;
    job->search =
        arena_printf(job->run->arena, "%zu start%s %s, with %ld escape%s each, by seed %ld", done,
                     done == 1 ? "" : "s", range_in_words(job), input->escapes,
                     input->escapes == 1 ? "" : "s", input->seed);
    job->is_late = done < all && !watch_is_ended(watch) && job->run->parts == NULL;
    if (done < all && !job->is_late) {
        job->incomplete =
            arena_printf(job->run->arena, "%s%zu of %zu starts: the best so far, incomplete",
                         job->run->parts != NULL ? "only " : "interrupted after ", done, all);
    }
}

static bool optimize_search_search(struct optimize_job *job, const struct merit_question *question,
                                   struct error *error)
{
    const struct optimize_input *input = job->input;
    struct arena *arena = job->run->arena;
    struct optimize_global *global = ARENA_NEW(arena, struct optimize_global);
    *global = (struct optimize_global){.merit = &job->merit,
                                       .iterations = (int)input->iterations,
                                       .escapes = (int)input->escapes,
                                       .seed = (uint64_t)input->seed,
                                       .spread = input->spread,
                                       .threads = parallel_threads(input->threads),
                                       .watch = job->run->watch,
                                       .goes_on = optimize_search_goes_on,
                                       .context = job,
                                       .start_count = (size_t)input->global,
                                       .end = (size_t)input->global};
    global->results = ARENA_ARRAY(arena, global->start_count, struct global_result);
    job->part = ARENA_NEW(arena, struct optimize_part);
    const double until = isnan(input->seconds) ? INFINITY : progress_clock() + input->seconds;
    job->until = INFINITY; /* what is searched is the same, however little time there is */
    if (input->keep > input->global) {
        return fail(error, ERROR_USAGE, "{--keep} %ld of {--global} %ld: at most one a start",
                    input->keep, input->global);
    }
    if (input->solver != SOLVER_DLS) {
        return fail(error, ERROR_USAGE, "{--global} searches with {--solver} dls only");
    }
    if (!drop_idle(job, global, question, error) ||
        !optimize_part_begin(job, global, job->part, error)) {
        return false;
    }
    job->until = until;
    global->pause = job->part->state_path != NULL ? keep_state : NULL;
    run_search(job, global);
    if (!take_kept(job, global, error)) {
        return false;
    }
    if (job->kept_count == 0 && wanted_of(job, global) > 0) {
        return fail_empty(job, count_done(job, global), error);
    }
    if (job->kept_count > 0 && job->kept_count < optimize_keep_count(input)) {
        optimize_warn(job->kept, "only %zu different lens%s found, of %ld to keep", job->kept_count,
                      job->kept_count == 1 ? " was" : "es were", input->keep);
    }
    return true;
}

bool optimize_job_run(struct optimize_job *job, struct error *error)
{
    struct merit_question question;
    return optimize_open(job, &question, error) &&
           (optimize_is_global(job->input) ? optimize_search_search(job, &question, error)
                                           : optimize_near(job, error));
}
