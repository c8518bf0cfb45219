/* commands/design/optimize_files.c - the lens that was found, and how the merit fell. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit.h"
#include "commands/design/optimize_job.h"
#include "draw/plot.h"
#include "file/lens_file.h"

bool optimize_save(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct optimize_job *done = job->run->state;
    struct arena *arena = job->run->arena;
    struct lens lens = *done->found;
    (void)error;
    /* what a source says is of the lens that it was */
    for (int i = 0; i < STATED_COUNT; i++) {
        lens.stated[i] = NULL;
        lens.stated_count[i] = 0;
    }
    if (lens.source != NULL) {
        fit_note(&lens, arena_printf(arena, "optimized from: %s", lens.source), arena);
        lens.source = NULL;
    }
    fit_note(&lens, done->incomplete, arena);
    struct text text = lens_write(&lens, arena);
    output_text(sink, text.start, text.length);
    return true;
}

bool optimize_plot(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct optimize_job *done = job->run->state;
    const struct optimize_answer *answer = &done->answer;
    struct arena *arena = job->run->arena;
    struct svg svg = {.arena = arena};
    double *x = ARENA_ARRAY(arena, answer->history_count, double);
    for (size_t i = 0; i < answer->history_count; i++) {
        x[i] = (double)i;
    }
    const struct plot_series series = {.y = answer->history};
    const struct plot plot = {.title = done->lens->title,
                              .subtitle = arena_printf(arena, "%s, %s", done->goals, done->status),
                              .x_label = "iteration",
                              .y_label = "merit",
                              .x = x,
                              .count = answer->history_count,
                              .series = &series,
                              .series_count = 1,
                              .log_y = answer->after.merit > 0};
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}
