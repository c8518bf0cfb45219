/* commands/design/optimize_best.c - the best lens of a search, in its file while the search goes on. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/arguments.h"
#include "commands/design/optimize_job.h"
#include "file/lens_file.h"
#include "report/place.h"

#include <stdatomic.h>

struct optimize_best {
    const char *path;
    atomic_flag is_busy; /* a thread compares, and writes */
    struct global_minimum best;
    bool is_there; /* `best` is one */
};

/* The lens of a minimum into its file, which appears whole, unless its surfaces overlap. */
static void optimize_best_write(const struct optimize_job *job, size_t start,
                                const struct global_minimum *minimum)
{
    struct arena own = {0};
    struct run run = *job->run; /* of this thread: its memory is its own */
    struct optimize_job one = *job;
    struct lens_warnings warnings;
    struct output sink;
    struct error ignored;
    run.arena = &own;
    optimize_start_layout(&one, start);
    one.run = &run;
    one.incomplete = "the best while the search went on, which did not come to its end: incomplete";
    one.found = variables_lens(&one.variables, minimum->parameters, &own);
    if (lens_check(one.found, &own, &warnings, &ignored) &&
        output_open(&sink, job->best->path, &own, &ignored)) {
        const struct lens lens = optimize_lens_written(&one);
        const struct text text = lens_write(&lens, &own);
        output_text(&sink, text.start, text.length);
        output_close(&sink, true, &ignored); /* what cannot be written is said at the end */
    }
    arena_free(&own);
}

static void optimize_best_found(void *context, size_t start)
{
    const struct optimize_job *job = context;
    struct optimize_best *best = job->best;
    const struct global_result *result = &job->global->results[start];
    const struct global_minimum *here = &result->minima[0];
    for (size_t i = 1; i < result->count; i++) {
        here = global_is_better(&result->minima[i], here) ? &result->minima[i] : here;
    }
    while (atomic_flag_test_and_set(&best->is_busy)) {
        /* another thread writes: a matter of a millisecond */
    }
    if (!best->is_there || global_is_better(here, &best->best)) {
        best->best = *here;
        best->is_there = true;
        optimize_best_write(job, start, here);
    }
    atomic_flag_clear(&best->is_busy);
}

void optimize_best_open(struct optimize_job *job)
{
    struct arena *arena = job->run->arena;
    const struct argument *output = arguments_find(job->run->arguments, text_of("output"));
    if (!output->is_given || job->input->part.count > 0 || job->run->parts != NULL) {
        return;
    }
    const char *path = arena_string(arena, output->text.start, output->text.length);
    if (place_is_standard(path, arena)) {
        return;
    }
    job->best = ARENA_NEW(arena, struct optimize_best);
    job->best->path = artifact_path(path, optimize_keep_count(job->input), 0, arena);
    atomic_flag_clear(&job->best->is_busy);
    job->global->found = optimize_best_found;
}
