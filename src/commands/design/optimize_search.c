/* commands/design/optimize_search.c - optimize --global: the best of many starts. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/optimize_job.h"

#include "base/parallel.h"
#include "cli/progress.h"
#include "commands/analysis/analysis_cursor.h"
#include "design/relocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Of the few lenses that are kept; where there is no time left, fewer. */
enum { LAST_ITERATIONS = 1000, CUT_ITERATIONS = 50, SAVED_EVERY = 30 /* s */ };

/* Once an iteration, from any thread. */
static bool optimize_search_goes_on(void *context)
{
    const struct optimize_job *job = context;
    return watch_ask(job->run->watch) && progress_clock() < job->until;
}

/* No surfaces that lie behind each other. */
static bool optimize_search_accepts(void *context, const struct lens *lens)
{
    const struct optimize_job *job = context;
    struct lens_warnings warnings;
    struct error ignored;
    return lens_check(lens, job->run->arena, &warnings, &ignored);
}

/* A reason why starts are lost, and how many. */
struct search_loss {
    const char *words;
    size_t count;
};

static int search_loss_compare(const void *one, const void *other)
{
    const struct search_loss *a = one, *b = other;
    return a->count != b->count ? (a->count < b->count) - (a->count > b->count)
                                : strcmp(a->words, b->words);
}

/* "8 as a ray misses surface 3, 4 as ...": the commonest first; null: none is lost. */
static const char *search_losses_words(const struct optimize_job *job, size_t *lost)
{
    enum { MOST = 4 };
    const struct optimize_global *global = job->global;
    struct arena *arena = job->run->arena;
    struct search_loss *losses = ARENA_ARRAY(arena, global->start_count, struct search_loss);
    size_t kinds = 0, told = 0;
    const char *words = NULL;
    *lost = 0;
    for (size_t k = 0; k < global->start_count; k++) {
        const struct global_result *result = &global->results[k];
        size_t i = 0;
        if (!result->is_done || result->count > 0) {
            continue;
        }
        while (i < kinds && strcmp(losses[i].words, result->lost) != 0) {
            i++;
        }
        losses[i] = (struct search_loss){result->lost, i < kinds ? losses[i].count + 1 : 1};
        kinds += i == kinds;
        *lost += 1;
    }
    qsort(losses, kinds, sizeof *losses, search_loss_compare);
    for (size_t i = 0; i < kinds && i < MOST; i++) {
        words = arena_printf(arena, "%s%s%zu as %s", words != NULL ? words : "",
                             words != NULL ? ", " : "", losses[i].count, losses[i].words);
        told += losses[i].count;
    }
    return told < *lost ? arena_printf(arena, "%s, %zu otherwise", words, *lost - told) : words;
}

/* Now and then, whenever half a minute has passed. */
static void keep_state(void *context)
{
    struct optimize_job *job = context;
    if (time(NULL) >= job->saved + SAVED_EVERY) {
        optimize_part_save(job);
    }
}

/* Variables that nothing depends on would only make lenses different that are not: the search goes
   on without them. */
static bool drop_idle(struct optimize_job *job, struct merit_question question, struct error *error)
{
    struct arena *arena = job->run->arena;
    const struct variables all = job->variables;
    struct variable *list = ARENA_ARRAY(arena, all.count + 1, struct variable);
    bool *is_idle = ARENA_ARRAY(arena, all.count + 1, bool);
    size_t count = 0;
    if (!optimize_global_idle(job->global, arena, is_idle)) {
        return true;
    }
    for (size_t i = 0; i < all.count; i++) {
        if (is_idle[i]) {
            optimize_warn(job, "no goal depends on %s: it stays as it is", all.list[i].name);
        } else {
            list[count++] = all.list[i];
        }
    }
    if (count == all.count || count == 0) {
        return true;
    }
    question.variable_count = count;
    question.operands = job->merit.question.operands;
    question.operand_count = job->merit.question.operand_count;
    return variables_open(job->lens, list, count, arena, &job->variables, error) &&
           merit_open(&question, arena, &job->merit, error);
}

/* What was searched. */
static const char *range_in_words(const struct optimize_job *job)
{
    struct arena *arena = job->run->arena;
    if (job->start != NULL) {
        return arena_printf(arena, "of %zu layout%s by third-order theory", job->layout_count,
                            job->layout_count == 1 ? "" : "s");
    }
    const double spread = job->input->spread;
    const struct global_range range = optimize_global_range(&job->variables, spread, arena);
    const char *names = "";
    size_t count = 0;
    for (size_t i = 0; i < job->variables.count; i++) {
        if (range.is_spread[i]) {
            names = arena_printf(arena, "%s%s ", names, job->variables.list[i].name);
            count++;
        }
    }
    if (count == 0) {
        return "between their bounds";
    }
    const bool is_part = count < job->variables.count;
    return arena_printf(arena, "%s%swithin %.4g natural scale%s of the lens",
                        is_part ? "between their bounds, of " : "", is_part ? names : "", spread,
                        spread == 1 ? "" : "s");
}

/*
 * The last descents. Where the search ended early they are short, so that what it found is brought
 * near its minima, however many seconds are over; else they end with the time.
 */
static size_t descend_last(struct optimize_job *job, size_t most, struct global_kept *kept)
{
    struct optimize_global *global = job->global;
    struct watch *watch = job->run->watch;
    const bool is_cut = job->is_late || job->incomplete != NULL;
    const int longest = is_cut ? CUT_ITERATIONS : LAST_ITERATIONS;
    const struct optimize_task task = {
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

/* There was no lens before. */
static void search_drop_before(struct optimize_job *one)
{
    struct optimize_state *before = &one->answer.before;
    before->merit = NAN;
    for (size_t i = 0; i < one->merit.residual_count; i++) {
        before->residuals[i] = before->values[i] = NAN;
    }
    for (size_t j = 0; j < one->variables.count; j++) {
        before->numbers[j] = NAN;
    }
}

/* The merit of a field, of which some lenses were judged by more. */
static double merit_of_field(const struct optimize_job *job)
{
    const struct setup *setup = &job->merit.places[0].setup;
    double weights = setup->field_count > 0 ? 0 : 1;
    for (size_t i = 0; i < setup->field_count; i++) {
        weights += setup->fields[i].weight;
    }
    return job->answer.after.merit / weights;
}

static bool is_better_job(const struct optimize_job *a, const struct optimize_job *b)
{
    const double missed = a->answer.summary.excess - b->answer.summary.excess;
    return missed < 0 || (missed == 0 && merit_of_field(a) < merit_of_field(b));
}

/* By more rays and fields, where they see another lens; late a little, however late it is. */
static bool refine_kept(const struct optimize_job *job, struct optimize_job *one, double end)
{
    one->task =
        (struct optimize_task){.merit = &one->merit,
                               .iterations = job->is_late ? CUT_ITERATIONS : LAST_ITERATIONS,
                               .goes_on = optimize_search_goes_on,
                               .context = one};
    one->until = job->is_late ? INFINITY : end;
    const bool is_refined = job->incomplete == NULL && optimize_refine(one);
    if (job->start != NULL) {
        search_drop_before(one);
    }
    return is_refined;
}

/*
 * The lenses of the last descents, each a job of its own, the best first. With --glasses each ends
 * with real ones, which may be another order; of what is left of the time each has its share.
 *
 * Result    how many there are; 0 with `error` set: none has a merit with the glasses
 */
static size_t list_kept(struct optimize_job *job, const struct global_kept *kept, size_t count,
                        double until, struct optimize_job *all, struct error *error)
{
    struct watch *watch = job->run->watch;
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        struct optimize_job *one = &all[found];
        *one = *job;
        one->warning = NULL;
        one->answer = kept[i].answer;
        optimize_start_layout(one, kept[i].start);
        one->found = variables_lens(&one->variables, one->answer.after.numbers, job->run->arena);
        one->hits = (long)kept[i].hits;
        const bool is_made = job->input->glasses != NULL || job->input->plates != NULL;
        const double now = progress_clock();
        const double end = isinf(until) ? until : now + fmax(until - now, 0) / (double)(count - i);
        const bool is_refined = refine_kept(job, one, end);
        one->until = end;
        one->task.iterations = job->global->iterations;
        if (!optimize_glasses_choose(one, error) || !optimize_plates_fit(one, error)) {
            continue;
        }
        if (!is_made && !is_refined) {
            found++;
            continue;
        }
        if (is_made) {
            one->is_late =
                job->is_late || (!watch_is_ended(watch) && progress_clock() >= one->until);
            job->evaluations += one->choice != NULL ? one->choice->evaluations : 0;
            job->evaluations += one->fitted != NULL ? one->fitted->evaluations : 0;
        }
        const struct optimize_job done = *one;
        size_t at = found++;
        for (; at > 0 && is_better_job(&done, &all[at - 1]); at--) {
            all[at] = all[at - 1];
        }
        all[at] = done;
    }
    for (size_t i = 0; i < found; i++) {
        all[i].evaluations = job->evaluations;
    }
    return found;
}

/*
 * The lenses that are kept; what is no lens, as its surfaces lie behind each other, is left out.
 *
 * Given     until  of what is done after the search, of progress_clock
 * Result    false: there were some, and all of them are none
 */
static bool keep_lenses(struct optimize_job *job, double until, struct error *error)
{
    const size_t most = optimize_keep_count(job->input);
    struct arena *arena = job->run->arena;
    struct global_kept *kept = ARENA_ARRAY(arena, most, struct global_kept);
    struct error *shortfall = &job->run->shortfall;
    const size_t ended = descend_last(job, most, kept);
    job->kept = ARENA_ARRAY(arena, ended + 1, struct optimize_job);
    const size_t count = list_kept(job, kept, ended, until, job->kept, error);
    for (size_t i = 0; i < count; i++) {
        const struct error before = *shortfall;
        struct optimize_job *one = &job->kept[job->kept_count];
        *one = job->kept[i];
        one->rank = (long)job->kept_count + 1;
        optimize_warn_of_look(one);
        const bool is_lens = optimize_judge(one, error);
        if (!is_lens || one->rank > 1) {
            *shortfall = before; /* what the best lacks counts */
        }
        if (!is_lens) {
            continue;
        }
        job->kept_count++;
        if (one->warning != NULL && most > 1) {
            one->warning = arena_printf(arena, "lens %ld: %s", one->rank, one->warning);
        }
        one->warning = lens_warnings_join(job->warning, one->warning, arena);
        if (one->is_late) {
            one->status = "the time is up";
        }
        if (job->incomplete != NULL) {
            one->status = job->run->parts != NULL ? "incomplete" : "interrupted";
            one->incomplete = job->incomplete;
            fail(shortfall, ERROR_DOMAIN, "%s", job->incomplete);
        }
    }
    return ended == 0 || job->kept_count > 0;
}

/* All starts that are to be searched; how many of `all` are done, which is said. */
static size_t run_starts(struct optimize_job *job, size_t all, double until)
{
    struct optimize_global *global = job->global;
    const struct optimize_input *input = job->input;
    const bool is_merged = job->run->parts != NULL;
    struct watch *watch = job->run->watch;
    struct arena *arena = job->run->arena;
    size_t left = global->end - global->begin;
    for (size_t k = global->begin; k < global->end; k++) {
        left -= global->results[k].is_done;
    }
    /* nobody knows how many there will be where time or a signal ends it */
    watch_begin(watch, "starts", global->start_count < OPTIMIZE_MOST_STARTS ? left : 0);
    watch_tell(watch, optimize_global_tell, global);
    optimize_global_search(global, arena);
    if (input->relocate > 0 && input->part.count == 0) {
        job->until = until;
        watch_begin(watch, "lenses", (size_t)input->relocate);
        watch_tell(watch, optimize_global_tell, global);
        optimize_relocate(global, (size_t)input->relocate, arena);
    }
    if (job->state_path != NULL && watch_is_ended(watch)) {
        optimize_part_save(job);
    }
    /* how many starts are done; what they cost, and their ends */
    size_t done = 0;
    job->ends = ARENA_ARRAY(arena, global->start_count, double);
    for (size_t k = 0; k < global->start_count; k++) {
        const struct global_result *result = &global->results[k];
        double best = INFINITY;
        done += result->is_done;
        job->evaluations += result->evaluations;
        for (size_t i = 0; i < result->count + result->moved_count; i++) {
            best = fmin(best, 2 * global_result_minimum(result, i)->cost);
        }
        if (result->count > 0) {
            job->ends[job->end_count++] = best;
        }
    }
    qsort(job->ends, job->end_count, sizeof(double), analysis_ascending);
    job->search = arena_printf(arena, "%zu start%s %s, with %ld escape%s each, by seed %ld", done,
                               done == 1 ? "" : "s", range_in_words(job), input->escapes,
                               input->escapes == 1 ? "" : "s", input->seed);
    if (input->relocate > 0) {
        const char *best = input->relocate == 1
                               ? "best lens"
                               : arena_printf(arena, "%ld best lenses", input->relocate);
        job->search =
            arena_printf(arena, "%s, elements of the %s put in elsewhere", job->search, best);
        job->evaluations += global->moved_evaluations;
    }
    job->is_late = done < all && !watch_is_ended(watch) && !is_merged;
    if (done < all && !job->is_late) {
        job->incomplete = arena_printf(arena, "%s%zu of %zu starts: the best so far, incomplete",
                                       is_merged ? "only " : "interrupted after ", done, all);
    }
    return done;
}

/* What is to be said of the whole search, with the best lens. */
static void search_warn(struct optimize_job *job, size_t done)
{
    const size_t refused = job->global->refused, most = optimize_keep_count(job->input);
    size_t lost;
    const char *losses = search_losses_words(job, &lost);
    if (job->kept_count == 0) {
        return;
    }
    if (lost > 0) {
        optimize_warn(job->kept, "%zu of %zu starts %s lost: %s", lost, done,
                      lost == 1 ? "was" : "were", losses);
    }
    if (refused > 0) {
        optimize_warn(job->kept, "%zu of the best that were found %s no lens and %s left out",
                      refused, refused == 1 ? "is" : "are", refused == 1 ? "is" : "are");
    }
    if (job->kept_count < most) {
        optimize_warn(job->kept, "only %zu different lens%s found, of %zu to keep", job->kept_count,
                      job->kept_count == 1 ? " was" : "es were", most);
    }
}

/* Why nothing is kept: nothing came to its end, or what is wrong with the lens itself. */
static bool search_fail(struct optimize_job *job, size_t done, struct error *error)
{
    if (done == 0) {
        return fail(error, ERROR_DOMAIN, "%s before any start came to its end",
                    watch_is_ended(job->run->watch) ? "interrupted" : "the time was up");
    }
    const struct optimize_task task = {
        .merit = &job->merit, .goes_on = optimize_search_goes_on, .context = job};
    size_t lost;
    const char *losses = search_losses_words(job, &lost);
    losses = losses != NULL ? losses : "as what was found is no lens";
    if (optimize_run(&task, job->run->arena, &job->answer, error)) {
        return fail(error, ERROR_DOMAIN, "none of %zu starts leads to a lens: %s", done, losses);
    }
    return error_prefix(error, "none of %zu starts can be judged: %s; the lens itself: ", done,
                        losses);
}

/* The search, of which nothing is done. */
static struct optimize_global *search_open(struct optimize_job *job)
{
    const struct optimize_input *input = job->input;
    struct arena *arena = job->run->arena;
    struct optimize_global *global = ARENA_NEW(arena, struct optimize_global);
    const size_t starts = optimize_start_count(input);
    const size_t layouts = job->start != NULL ? job->layout_count : 1;
    const struct merit **merits = ARENA_ARRAY(arena, layouts, const struct merit *);
    merits[0] = &job->merit;
    for (size_t i = 0; i < job->layout_count; i++) {
        merits[i] = &job->layouts[i].merit;
    }
    *global = (struct optimize_global){.merits = merits,
                                       .layouts = layouts,
                                       .place = job->start != NULL ? optimize_start_place : NULL,
                                       .iterations = (int)input->iterations,
                                       .escapes = (int)input->escapes,
                                       .seed = (uint64_t)input->seed,
                                       .spread = input->spread,
                                       .threads = parallel_threads(input->threads),
                                       .watch = job->run->watch,
                                       .goes_on = optimize_search_goes_on,
                                       .accepts = optimize_search_accepts,
                                       .context = job,
                                       .start_count = starts,
                                       .end = starts};
    global->results = ARENA_ARRAY(arena, global->start_count, struct global_result);
    return global;
}

bool optimize_search(struct optimize_job *job, const struct merit_question *question,
                     struct error *error)
{
    const struct optimize_input *input = job->input;
    struct optimize_global *global = search_open(job);
    const size_t starts = global->start_count;
    job->global = global;
    const double begun = progress_clock();
    const double seconds = isnan(input->seconds) ? INFINITY : input->seconds;
    job->until = INFINITY; /* what is searched is the same, however little time there is */
    if (input->keep > (long)starts) {
        return fail(error, ERROR_USAGE, "{--keep} %ld of {--global} %zu: at most one a start",
                    input->keep, starts);
    }
    if (input->solver != SOLVER_DLS) {
        return fail(error, ERROR_USAGE, "{--global} searches with {--solver} dls only");
    }
    if ((job->start == NULL && !drop_idle(job, *question, error)) ||
        !optimize_part_begin(job, error)) {
        return false;
    }
    /* half of the time is for glasses and plates */
    const bool is_shared = input->glasses != NULL || input->plates != NULL;
    const double searched = begun + (is_shared ? seconds / 2 : seconds);
    /* and a third of the rest for what is made of the best */
    job->until = input->relocate > 0 ? begun + (searched - begun) * 2 / 3 : searched;
    optimize_best_open(job);
    global->pause = job->state_path != NULL ? keep_state : NULL;
    const size_t all = job->run->parts != NULL ? global->start_count : global->end - global->begin;
    const size_t done = run_starts(job, all, searched);
    if (!keep_lenses(job, begun + seconds, error)) {
        return false;
    }
    if (job->kept_count == 0 && all > 0) {
        return search_fail(job, done, error);
    }
    search_warn(job, done);
    return true;
}
