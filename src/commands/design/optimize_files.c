/* commands/design/optimize_files.c - the lens that was found, and how the merit fell. */
/* SPDX-License-Identifier: MIT */
#include "commands/design/fit.h"
#include "commands/design/optimize_part.h"
#include "commands/design/optimize_search.h"
#include "draw/plot.h"
#include "file/lens_file.h"
#include "trace/aim/sample.h"

#include <math.h>

/* Goals of --goals take the place of the lens's own. */
static void put_goals(const struct optimize_job *job, struct lens *lens)
{
    struct arena *arena = job->run->arena;
    struct lens_goal *goal = ARENA_NEW(arena, struct lens_goal);
    if (job->input->goals == NULL || lens->goal_count == 0) {
        return;
    }
    char *words = arena_printf(arena, "%s", job->input->goals);
    for (char *at = words; *at != '\0'; at++) {
        *at = (char)(*at < ' ' ? ' ' : *at); /* it is one line */
    }
    goal->text = text_of(words);
    lens->goals = goal;
    lens->goal_count = 1;
    fit_note(lens, "its goals are those that it was optimized for, no longer its own", arena);
}

static void optimize_files_save(const struct optimize_job *done, struct output *sink)
{
    struct arena *arena = done->run->arena;
    struct lens lens = *done->found;
    /* what a source says is of the lens that it was */
    for (int i = 0; i < STATED_COUNT; i++) {
        lens.stated[i] = NULL;
        lens.stated_count[i] = 0;
    }
    if (lens.source != NULL) {
        fit_note(&lens, arena_printf(arena, "optimized from: %s", lens.source), arena);
        lens.source = NULL;
    }
    put_goals(done, &lens);
    fit_note(&lens, done->incomplete, arena);
    struct text text = lens_write(&lens, arena);
    output_text(sink, text.start, text.length);
}

bool optimize_save(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct optimize_job *done = job->run->state;
    (void)error;
    if (done->search == NULL) {
        optimize_files_save(done, sink);
        return true;
    }
    if (job->type == division_types(0)) {
        optimize_part_write(done->part, sink);
        return true;
    }
    for (size_t i = 0; i < job->files; i++) {
        if (i < done->kept_count) {
            optimize_files_save(&done->kept[i], &sink[i]);
        } else {
            sink[i].is_unused = true;
        }
    }
    return true;
}

bool optimize_check_saved(const struct artifact_job *job, struct error *error)
{
    const struct optimize_input *input = job->inputs[0];
    return input->part.count == 0 || file_type_ends(text_of(job->path), ".part") ||
           fail(error, ERROR_USAGE, "{--part} needs {--output} with a name that ends in .part");
}

bool optimize_save_state(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct optimize_job *done = job->run->state;
    (void)error;
    optimize_state_write(done->part, sink);
    return true;
}

/* "f/2.8", "seed 3"; null: there is only one. */
static const char *optimize_files_label_of(const struct optimize_job *job, bool several)
{
    const struct optimize_input *input = job->input;
    struct arena *arena = job->run->arena;
    const char *aperture = isnan(input->question.fnumber)
                               ? ""
                               : arena_printf(arena, "f/%.4g ", input->question.fnumber);
    if (!several) {
        return NULL;
    }
    if (input->pattern == PATTERN_SOBOL || optimize_is_global(input)) {
        return arena_printf(arena, "%sseed %ld", aperture, input->seed);
    }
    return aperture;
}

/* What is drawn of a job: its merit after each iteration, or where its starts ended. */
struct optimize_files_curve {
    const double *y;
    size_t count;
};

static struct optimize_files_curve optimize_files_curve_of(const struct optimize_job *job)
{
    return job->kept_count > 0
               ? (struct optimize_files_curve){job->ends, job->end_count}
               : (struct optimize_files_curve){job->answer.history, job->answer.history_count};
}

/* As long as the longest. */
static const double *optimize_files_stretch(struct optimize_files_curve curve, size_t length,
                                            struct arena *arena)
{
    double *y = ARENA_ARRAY(arena, length, double);
    for (size_t i = 0; i < length; i++) {
        y[i] = i < curve.count ? curve.y[i] : NAN;
    }
    return y;
}

static bool optimize_files_is_positive(struct optimize_files_curve curve)
{
    bool positive = true;
    for (size_t i = 0; i < curve.count; i++) {
        positive = positive && curve.y[i] > 0;
    }
    return positive;
}

bool optimize_plot(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct optimize_job *last = job->run->state;
    struct arena *arena = job->run->arena;
    struct svg svg = {.arena = arena};
    struct plot_series *series = ARENA_ARRAY(arena, job->count, struct plot_series);
    size_t length = 0, at = job->count;
    bool log_y = true;
    for (const struct optimize_job *one = last; one != NULL; one = one->earlier) {
        const struct optimize_files_curve curve = optimize_files_curve_of(one);
        length = curve.count > length ? curve.count : length;
        log_y = log_y && optimize_files_is_positive(curve);
    }
    for (const struct optimize_job *one = last; one != NULL && at > 0; one = one->earlier) {
        at--;
        series[at] = (struct plot_series){
            .label = optimize_files_label_of(one, job->count > 1),
            .y = optimize_files_stretch(optimize_files_curve_of(one), length, arena),
            .style = at};
    }
    const bool is_search = last->kept_count > 0;
    double *x = ARENA_ARRAY(arena, length, double);
    for (size_t i = 0; i < length; i++) {
        x[i] = (double)i + is_search;
    }
    const struct plot plot = {.title = last->lens->title,
                              .subtitle = last->goals,
                              .x_label = is_search ? "starts, the best first" : "iteration",
                              .y_label = "merit",
                              .x = x,
                              .count = length,
                              .series = series + at,
                              .series_count = job->count - at,
                              .log_y = log_y};
    return plot_draw(&plot, &svg, error) && drawing_write(job, &svg, sink, error);
}
