/* commands/design/optimize_files.c - the lens that was found, and how the merit fell. */
/* SPDX-License-Identifier: MIT */
#include "base/image/bytes.h"
#include "cli/question/arguments.h"
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
 * eight for its cost, its excess, and each variable; of a start without minima four for the length
 * of why it is lost, and these words.
 */
enum { COUNT_BYTES = 4, LONG_BYTES = 8 };

static void body_put_double(struct bytes *body, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    bytes_put_little(body, bits, LONG_BYTES);
}

/* Of the starts of a part, or of all for a state. */
static void write_starts(const struct optimize_job *job, struct part_head *head,
                         struct output *sink)
{
    const struct optimize_global *global = job->global;
    const struct part_range range = part_range(head->part, head->total);
    struct arena arena = {0};
    struct bytes body = {.arena = &arena};
    head->done = 0;
    for (uint64_t k = range.begin; k < range.end; k++) {
        head->done += global->results[k].is_done;
        bytes_put_little(&body, global->results[k].is_done, 1);
    }
    for (uint64_t k = range.begin; k < range.end; k++) {
        const struct global_result *result = &global->results[k];
        if (!result->is_done) {
            continue;
        }
        bytes_put_little(&body, result->count, COUNT_BYTES);
        bytes_put_little(&body, (uint64_t)result->evaluations, LONG_BYTES);
        for (size_t i = 0; i < result->count; i++) {
            body_put_double(&body, result->minima[i].cost);
            body_put_double(&body, result->minima[i].excess);
            for (size_t j = 0; j < global->merits[0]->variable_count; j++) {
                body_put_double(&body, result->minima[i].parameters[j]);
            }
        }
        if (result->count == 0) {
            bytes_put_little(&body, strlen(result->lost), COUNT_BYTES);
            bytes_put(&body, result->lost, strlen(result->lost));
        }
    }
    division_write(head, bytes_text(&body), &arena, sink);
    arena_free(&arena);
}

void optimize_part_save(struct optimize_job *job)
{
    struct arena arena = {0};
    struct output sink;
    struct error ignored;
    if (job->state_path != NULL && output_open(&sink, job->state_path, &arena, &ignored)) {
        write_starts(job, &job->state, &sink);
        output_close(&sink, true, &ignored);
    }
    job->saved = time(NULL);
    arena_free(&arena);
}

static uint64_t take_bytes(struct text *rest, int count)
{
    const uint64_t value = bytes_little((const unsigned char *)rest->start, count);
    rest->start += count;
    rest->length -= (size_t)count;
    return value;
}

static double body_take_double(struct text *rest)
{
    const uint64_t bits = take_bytes(rest, LONG_BYTES);
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* Result: false: there is not so much in it. */
static bool take_result(const struct optimize_global *global, struct arena *arena,
                        struct text *rest, struct global_result *result)
{
    const size_t numbers = global->merits[0]->variable_count;
    if (rest->length < COUNT_BYTES + LONG_BYTES) {
        return false;
    }
    const uint64_t count = take_bytes(rest, COUNT_BYTES);
    result->evaluations = (long)take_bytes(rest, LONG_BYTES);
    if (count > (uint64_t)global->escapes + 1 ||
        rest->length < count * (numbers + 2) * LONG_BYTES) {
        return false;
    }
    result->is_done = true;
    result->count = (size_t)count;
    result->minima = ARENA_ARRAY(arena, result->count + 1, struct global_minimum);
    for (size_t i = 0; i < result->count; i++) {
        struct global_minimum *minimum = &result->minima[i];
        minimum->cost = body_take_double(rest);
        minimum->excess = body_take_double(rest);
        minimum->parameters = ARENA_ARRAY(arena, numbers + 1, double);
        for (size_t j = 0; j < numbers; j++) {
            minimum->parameters[j] = body_take_double(rest);
        }
    }
    if (count == 0) {
        const uint64_t length =
            rest->length < COUNT_BYTES ? UINT64_MAX : take_bytes(rest, COUNT_BYTES);
        if (rest->length < length) {
            return false;
        }
        result->lost = arena_string(arena, rest->start, (size_t)length);
        rest->start += length;
        rest->length -= (size_t)length;
    }
    return true;
}

static bool take_starts(const struct optimize_global *global, struct arena *arena,
                        const struct part_file *file)
{
    const struct part_range range = part_range(file->head.part, file->head.total);
    const uint64_t starts = range.end - range.begin;
    const char *flags = file->body.start;
    bool good = file->body.length >= starts;
    struct text rest = {flags + starts, good ? file->body.length - starts : 0};
    uint64_t done = 0;
    for (uint64_t k = 0; k < starts && good; k++) {
        done += flags[k] != 0;
        good =
            flags[k] == 0 || take_result(global, arena, &rest, &global->results[range.begin + k]);
    }
    return good && rest.length == 0 && done == file->head.done;
}

/* What a result depends on besides words and files: glasses, what the lens is and has. */
static struct text facts_of_search(const struct optimize_job *job)
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

bool optimize_part_begin(struct optimize_job *job, struct error *error)
{
    static const char *const aside[] = {"keep",        "show",     "seconds", "glasses",
                                        "test_plates", "relocate", NULL};
    const struct run *run = job->run;
    const struct part asked = job->input->part;
    const struct argument *path = arguments_find(run->arguments, text_of("state"));
    struct optimize_global *global = job->global;
    const struct part_file *files;
    size_t count;
    job->saved = time(NULL);
    if (path->is_given) {
        job->state_path = arena_string(run->arena, path->text.start, path->text.length);
    }
    if (asked.count > 0 && !arguments_given(run->arguments, "output")) {
        return fail(error, ERROR_USAGE, "{--part} needs {--output} FILE.part");
    }
    if (run->parts == NULL && job->state_path == NULL && asked.count == 0) {
        return true;
    }
    struct division division = {.part =
                                    design_part(run, asked.count > 0 ? asked : (struct part){1, 1}),
                                .seed = global->seed,
                                .total = global->start_count,
                                .facts = facts_of_search(job)};
    if (!division_head(run, &division, &job->part, error)) {
        return false;
    }
    division.aside = aside;
    if (!division_head(run, &division, &job->state, error) ||
        !division_found(run, run->parts != NULL ? &job->part : &job->state, job->state_path, &files,
                        &count, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        if (!take_starts(global, run->arena, &files[i])) {
            return fail(error, ERROR_DATA, "%s: its starts are not those that its head says",
                        files[i].path);
        }
    }
    const struct part_range own = part_range(division.part, global->start_count);
    global->begin = own.begin;
    global->end = run->parts != NULL ? own.begin : own.end;
    return true;
}

struct lens optimize_lens_written(const struct optimize_job *done)
{
    struct arena *arena = done->run->arena;
    const char *goals = done->input->goals;
    struct lens lens = *done->found;
    design_note_source(&lens, "optimized from", arena);
    if (goals != NULL && lens.goal_count > 0 && done->start == NULL) {
        /* they take the place of the lens's own */
        char *words = arena_printf(arena, "%s", goals);
        for (char *at = words; *at != '\0'; at++) {
            *at = (char)(*at < ' ' ? ' ' : *at); /* it is one line */
        }
        lens.goals = ARENA_NEW(arena, struct lens_goal);
        *lens.goals = (struct lens_goal){.text = text_of(words)};
        lens.goal_count = 1;
        design_note(&lens, "its goals are those that it was optimized for, no longer its own",
                    arena);
    }
    design_note(&lens, done->incomplete, arena);
    return lens;
}

static void save_lens(const struct optimize_job *done, struct output *sink)
{
    const struct lens lens = optimize_lens_written(done);
    const struct text text = lens_write(&lens, done->run->arena);
    output_text(sink, text.start, text.length);
}

bool optimize_save(const struct artifact_job *job, struct output *sink, struct error *error)
{
    struct optimize_job *done = job->run->state;
    (void)error;
    if (done->search == NULL) {
        save_lens(done, sink);
    } else if (job->type == division_types(0)) {
        struct part_head *head = &done->part;
        const struct part_range own = part_range(head->part, head->total);
        struct arena *arena = job->run->arena;
        write_starts(done, head, sink);
        sink->remarks = text_of(
            own.begin == own.end
                ? arena_printf(arena, "part %ld/%ld: none of %" PRIu64 " starts\n",
                               head->part.number, head->part.count, head->total)
                : arena_printf(
                      arena, "part %ld/%ld: starts %" PRIu64 " to %" PRIu64 " of %" PRIu64 "\n",
                      head->part.number, head->part.count, own.begin + 1, own.end, head->total));
    } else {
        for (size_t i = 0; i < job->files; i++) {
            if (i < done->kept_count) {
                save_lens(&done->kept[i], &sink[i]);
            } else {
                sink[i].is_unused = true;
            }
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
    struct optimize_job *done = job->run->state;
    (void)error;
    write_starts(done, &done->state, sink);
    return true;
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
        const size_t count = one->kept_count > 0 ? one->end_count : one->answer.history_count;
        length = count > length ? count : length;
    }
    for (const struct optimize_job *one = last; one != NULL; one = one->earlier) {
        /* its merit after each iteration, or where its starts ended */
        const double *merits = one->kept_count > 0 ? one->ends : one->answer.history;
        const size_t count = one->kept_count > 0 ? one->end_count : one->answer.history_count;
        const struct optimize_input *input = one->input;
        double *y = ARENA_ARRAY(arena, length, double);
        for (size_t i = 0; i < length; i++) {
            y[i] = i < count ? merits[i] : NAN;
            log_y = log_y && (i >= count || y[i] > 0);
        }
        if (at == 0) {
            continue;
        }
        at--;
        series[at] = (struct plot_series){.y = y, .style = at};
        if (job->count > 1) { /* "f/2.8", "seed 3" */
            const char *aperture = isnan(input->question.fnumber)
                                       ? ""
                                       : arena_printf(arena, "f/%.4g ", input->question.fnumber);
            series[at].label = input->pattern == PATTERN_SOBOL || input->global > 0
                                   ? arena_printf(arena, "%sseed %ld", aperture, input->seed)
                                   : aperture;
        }
    }
    const bool is_search = last->kept_count > 0;
    double *x = ARENA_ARRAY(arena, length, double);
    for (size_t i = 0; i < length; i++) {
        x[i] = (double)i + is_search;
    }
    const struct plot plot = {.title = arena_printf(arena, "Merit of %s", last->lens->title),
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
