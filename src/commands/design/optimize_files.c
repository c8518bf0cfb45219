/* commands/design/optimize_files.c - the lens that was found, and how the merit fell. */
/* SPDX-License-Identifier: MIT */
#include "base/image/bytes.h"
#include "cli/question/arguments.h"
#include "commands/design/fit.h"
#include "commands/design/optimize_job.h"
#include "draw/plot.h"
#include "file/lens_file.h"
#include "optics/growing.h"
#include "trace/aim/sample.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

/*
 * The body of a file: a byte for each start of its range that says whether it is done; then of each
 * that is, four bytes for the number of minima, eight for that of evaluations, and for each minimum
 * eight for its cost, its excess, and each variable.
 */
enum { COUNT_BYTES = 4, LONG_BYTES = 8, SAVED_EVERY = 30 /* s */ };

static uint64_t optimize_part_bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* -------- writing -------- */

static void put_result(struct bytes *body, const struct global_result *result, size_t numbers)
{
    bytes_put_little(body, result->count, COUNT_BYTES);
    bytes_put_little(body, (uint64_t)result->evaluations, LONG_BYTES);
    for (size_t i = 0; i < result->count; i++) {
        const struct global_minimum *minimum = &result->minima[i];
        bytes_put_little(body, optimize_part_bits_of(minimum->cost), LONG_BYTES);
        bytes_put_little(body, optimize_part_bits_of(minimum->excess), LONG_BYTES);
        for (size_t j = 0; j < numbers; j++) {
            bytes_put_little(body, optimize_part_bits_of(minimum->parameters[j]), LONG_BYTES);
        }
    }
}

static void optimize_part_write_file(struct optimize_part *part, struct part_head *head,
                                     struct output *sink)
{
    const struct optimize_global *global = part->global;
    const struct part_range range = part_range(head->part, head->total);
    struct arena arena = {0};
    struct bytes body = {.arena = &arena};
    head->done = 0;
    for (uint64_t k = range.begin; k < range.end; k++) {
        head->done += global->results[k].is_done;
        bytes_put_little(&body, global->results[k].is_done, 1);
    }
    for (uint64_t k = range.begin; k < range.end; k++) {
        if (global->results[k].is_done) {
            put_result(&body, &global->results[k], global->merit->variable_count);
        }
    }
    division_write(head, bytes_text(&body), &arena, sink);
    arena_free(&arena);
}

static void optimize_part_write(struct optimize_part *part, struct output *sink)
{
    const struct part_head *head = &part->part;
    const struct part_range own = part_range(head->part, head->total);
    struct arena *arena = part->run->arena;
    optimize_part_write_file(part, &part->part, sink);
    sink->remarks = text_of(
        own.begin == own.end
            ? arena_printf(arena, "part %ld/%ld: none of %" PRIu64 " starts\n", head->part.number,
                           head->part.count, head->total)
            : arena_printf(
                  arena, "part %ld/%ld: starts %" PRIu64 " to %" PRIu64 " of %" PRIu64 "\n",
                  head->part.number, head->part.count, own.begin + 1, own.end, head->total));
}

static void optimize_state_write(struct optimize_part *part, struct output *sink)
{
    optimize_part_write_file(part, &part->state, sink);
}

void optimize_part_save(struct optimize_part *part)
{
    struct arena arena = {0};
    struct output sink;
    struct error ignored;
    if (part->state_path != NULL && output_open(&sink, part->state_path, &arena, &ignored)) {
        optimize_state_write(part, &sink);
        output_close(&sink, true, &ignored);
    }
    part->saved = time(NULL);
    arena_free(&arena);
}

void optimize_part_pause(struct optimize_part *part)
{
    if (time(NULL) >= part->saved + SAVED_EVERY) {
        optimize_part_save(part);
    }
}

/* -------- reading -------- */

/* A body as it is taken apart. */
struct rest {
    const unsigned char *at;
    size_t length;
};

static uint64_t optimize_part_take(struct rest *rest, int bytes)
{
    const uint64_t value = bytes_little(rest->at, bytes);
    rest->at += bytes;
    rest->length -= (size_t)bytes;
    return value;
}

/* Result: false: there is not so much in it. */
static bool take_result(const struct optimize_global *global, struct arena *arena,
                        struct rest *rest, struct global_result *result)
{
    const size_t numbers = global->merit->variable_count;
    if (rest->length < COUNT_BYTES + LONG_BYTES) {
        return false;
    }
    const uint64_t count = optimize_part_take(rest, COUNT_BYTES);
    result->evaluations = (long)optimize_part_take(rest, LONG_BYTES);
    if (count > (uint64_t)global->escapes + 1 ||
        rest->length < count * (numbers + 2) * LONG_BYTES) {
        return false;
    }
    result->is_done = true;
    result->count = (size_t)count;
    result->minima = ARENA_ARRAY(arena, result->count + 1, struct global_minimum);
    for (size_t i = 0; i < result->count; i++) {
        struct global_minimum *minimum = &result->minima[i];
        minimum->cost = double_of(optimize_part_take(rest, LONG_BYTES));
        minimum->excess = double_of(optimize_part_take(rest, LONG_BYTES));
        minimum->parameters = ARENA_ARRAY(arena, numbers + 1, double);
        for (size_t j = 0; j < numbers; j++) {
            minimum->parameters[j] = double_of(optimize_part_take(rest, LONG_BYTES));
        }
    }
    return true;
}

static bool take_files(struct optimize_part *part, const struct part_head *head, const char *path,
                       struct error *error)
{
    const struct part_file *files;
    size_t count;
    if (!division_found(part->run, head, path, &files, &count, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        const struct part_file *file = &files[i];
        struct optimize_global *global = part->global;
        const struct part_range range = part_range(file->head.part, file->head.total);
        const unsigned char *flags = (const unsigned char *)file->body.start;
        const uint64_t starts = range.end - range.begin;
        bool good = file->body.length >= starts;
        struct rest rest = {flags + starts, good ? file->body.length - starts : 0};
        uint64_t done = 0;
        for (uint64_t k = 0; k < starts && good; k++) {
            done += flags[k] != 0;
            good = flags[k] == 0 ||
                   take_result(global, part->run->arena, &rest, &global->results[range.begin + k]);
        }
        if (!(good && rest.length == 0 && done == file->head.done)) {
            return fail(error, ERROR_DATA, "%s: its starts are not those that its head says",
                        file->path);
        }
    }
    return true;
}

/* -------- before a search -------- */

/* What a result depends on besides words and files: glasses, what the lens is and has. */
static struct text optimize_facts_of(const struct optimize_job *job)
{
    struct text_buffer facts = {.arena = job->run->arena};
    growing_string(&facts, job->goals);
    for (size_t i = 0; i < job->merit.place_count; i++) {
        const struct merit_place *place = &job->merit.places[i];
        growing_format(&facts, " %a %a", place->setup.first.power, place->aperture.value);
        for (size_t k = 0; k < place->light_count; k++) {
            growing_format(&facts, " %a", place->lights[k].wavelength);
        }
    }
    for (size_t j = 0; j < job->variables.count; j++) {
        growing_format(&facts, " %a %a %a", job->variables.start[j], job->variables.low[j],
                       job->variables.high[j]);
    }
    return growing_done(&facts);
}

static bool make_heads(const struct optimize_job *job, struct optimize_part *part,
                       struct error *error)
{
    static const char *const aside[] = {"keep", "show", "seconds", NULL};
    const struct run *run = job->run;
    struct division division = {.part = {1, 1},
                                .seed = part->global->seed,
                                .total = part->global->start_count,
                                .facts = optimize_facts_of(job)};
    if (run->parts != NULL) {
        division.part.count = run->parts[0].head.part.count;
    } else if (job->input->part.count > 0) {
        division.part = job->input->part;
    }
    if (!division_head(run, &division, &part->part, error)) {
        return false;
    }
    division.aside = aside;
    return division_head(run, &division, &part->state, error);
}

bool optimize_part_begin(const struct optimize_job *job, struct optimize_global *global,
                         struct optimize_part *part, struct error *error)
{
    const struct argument *state = arguments_find(job->run->arguments, text_of("state"));
    const bool is_merged = job->run->parts != NULL;
    *part = (struct optimize_part){.run = job->run, .global = global, .saved = time(NULL)};
    if (state->is_given) {
        part->state_path = arena_string(job->run->arena, state->text.start, state->text.length);
    }
    if (job->input->part.count > 0 && !arguments_given(job->run->arguments, "output")) {
        return fail(error, ERROR_USAGE, "{--part} needs {--output} FILE.part");
    }
    if (!is_merged && part->state_path == NULL && job->input->part.count == 0) {
        return true;
    }
    if (!make_heads(job, part, error) ||
        !take_files(part, is_merged ? &part->part : &part->state, part->state_path, error)) {
        return false;
    }
    const struct part_range own = part_range(part->part.part, global->start_count);
    global->begin = own.begin;
    global->end = is_merged ? own.begin : own.end;
    return true;
}

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

static void optimize_save_lens(const struct optimize_job *done, struct output *sink)
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
        optimize_save_lens(done, sink);
        return true;
    }
    if (job->type == division_types(0)) {
        optimize_part_write(done->part, sink);
        return true;
    }
    for (size_t i = 0; i < job->files; i++) {
        if (i < done->kept_count) {
            optimize_save_lens(&done->kept[i], &sink[i]);
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
static const char *optimize_curve_label(const struct optimize_job *job, bool several)
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
struct optimize_curve {
    const double *y;
    size_t count;
};

static struct optimize_curve optimize_curve_of(const struct optimize_job *job)
{
    return job->kept_count > 0
               ? (struct optimize_curve){job->ends, job->end_count}
               : (struct optimize_curve){job->answer.history, job->answer.history_count};
}

/* As long as the longest. */
static const double *optimize_curve_stretch(struct optimize_curve curve, size_t length,
                                            struct arena *arena)
{
    double *y = ARENA_ARRAY(arena, length, double);
    for (size_t i = 0; i < length; i++) {
        y[i] = i < curve.count ? curve.y[i] : NAN;
    }
    return y;
}

static bool optimize_curve_is_positive(struct optimize_curve curve)
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
        const struct optimize_curve curve = optimize_curve_of(one);
        length = curve.count > length ? curve.count : length;
        log_y = log_y && optimize_curve_is_positive(curve);
    }
    for (const struct optimize_job *one = last; one != NULL && at > 0; one = one->earlier) {
        at--;
        series[at] =
            (struct plot_series){.label = optimize_curve_label(one, job->count > 1),
                                 .y = optimize_curve_stretch(optimize_curve_of(one), length, arena),
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
