/* cli/answer/rows.c - the rows of a question: every combination of a sweep, every line of a batch. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/rows.h"

#include "cli/answer/complain.h"
#include "cli/interrupt.h"
#include "report/explain.h"

#include <math.h>
#include <string.h>
#include <unistd.h>

/* All rows have the columns of the first input. */
bool rows_check_sheet(const struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    return command->choose_sheet == NULL ||
           command->choose_sheet(driver->input, &driver->asking) == driver->echo.own ||
           fail(error, ERROR_USAGE,
                "these options give rows with different columns: use one at a time");
}

void rows_begin(struct driver *driver)
{
    driver->begun = true;
    driver->report.format->begin(&driver->report);
}

bool run_shows(const struct run *run, size_t offset)
{
    const struct report *report = run->report;
    bool shows = report == NULL;
    for (size_t i = 0; !shows && i < report->shown_count; i++) {
        shows = report->shown[i].column->offset == offset;
    }
    for (size_t i = 0; !shows && i < report->assumed_count; i++) {
        shows = report->assumed[i].column->offset == offset;
    }
    return shows;
}

static bool is_going(const struct driver *driver)
{
    return driver->output.failure == 0 && !atomic_load(&driver->progress.watch.is_ended);
}

/* The first row, and every one that is kept or looked at for something else too. */
static void emit_first(struct driver *driver, const void *row)
{
    struct report *report = &driver->report;
    if (driver->collects) {
        collection_keep(&driver->collection, driver->index, row);
    }
    if (driver->common.explain && driver->explained == NULL) {
        void *copy = arena_array(&driver->arena, 1, report->sheet->row_size);
        driver->explained = memcpy(copy, row, report->sheet->row_size);
        const char *text = explain_row(report, driver->command->explanations, row);
        report->explain = text != NULL ? text : "nothing to explain: plain facts";
    }
    if (driver->common.table == NULL && !driver->begun) {
        rows_begin(driver);
    }
    const bool has_all =
        !report->are_named || report->format->is_for_people || report_note_values(report, row);
    driver->only_prints = driver->begun && !driver->collects && has_all;
    /* those that nobody reads among the rows: people do, below them */
    driver->hidden_count = 0;
    for (size_t i = 0; i < report->sheet->column_count && !report->format->is_for_people; i++) {
        const struct column *column = &report->sheet->columns[i];
        /* no answer is silent about what is doubtful, and what was taken for what was named */
        if (driver->begun && (column->flags & COLUMN_NOTE) != 0 &&
            (text_equal(text_of(column->name), "warning") ||
             text_equal(text_of(column->name), "taken_as")) &&
            !report_shows(report, column)) {
            driver->hidden_notes[driver->hidden_count++] = column;
        }
    }
}

bool rows_emit(struct run *run, const void *row)
{
    struct driver *driver = run->driver;
    struct report *report = &driver->report;
    if (driver->echo.count > 0) {
        row = echo_row(&driver->echo, row, driver->answered, driver->run.arena);
    }
    if (!driver->only_prints) {
        emit_first(driver, row);
    }
    /* columns were chosen, and these notes were not: they are told beside the answer */
    for (size_t i = 0; i < driver->hidden_count; i++) {
        const struct column *column = driver->hidden_notes[i];
        const char *note = row_text(row, column);
        if (note != NULL) {
            const bool is_warning = text_equal(text_of(column->name), "warning");
            warnings_add(&driver->doubts, "%s%s", is_warning ? "" : "taken as ", note);
        }
    }
    if (driver->begun) {
        report->format->row(report, row, driver->passed, NULL);
        report->rows++;
    }
    progress_row(&driver->progress);
    return is_going(driver);
}

/* A command's row, amid its work. */
bool rows_emit_amid(struct run *run, const void *row)
{
    interrupt_hold();
    const bool is_going_on = rows_emit(run, row);
    interrupt_release();
    return is_going_on;
}

/* A failure names its quantities by what gave them in its row. */
static void failure_name(const struct driver *driver, struct error *failure)
{
    complain_name(failure, &driver->arguments, &driver->batch,
                  driver->is_batch ? driver->answered : NULL);
}

/*
 * Of failures in a row that are alike, as in a sweep, the first, and of rows of a batch that lack
 * the same; all rows have their own.
 */
static void rows_say(struct driver *driver, struct error *failure)
{
    if (driver->is_inside ||
        (failure->line == driver->said.line && failure->column == driver->said.column &&
         strcmp(failure->source, driver->said.source) == 0 &&
         strcmp(failure->message, driver->said.message) == 0 &&
         strcmp(failure->hint, driver->said.hint) == 0)) {
        return;
    }
    driver->said = *failure;
    if (driver->is_batch && gaps_has(failure)) {
        if (!gaps_add(&driver->gaps, failure)) {
            return;
        }
        gaps_explain(failure, &driver->batch, driver->answered);
    }
    progress_erase(&driver->progress);
    failure_name(driver, failure);
    error_print(failure, driver->command->name, driver->arguments.color);
}

/* A row names its quantities as what is said of it does, be it said or not. */
static void write_failure(struct driver *driver, const struct passed_cell *passed,
                          struct error *failure)
{
    failure_name(driver, failure);
    driver->report.format->row(&driver->report, NULL, passed, failure);
    driver->report.rows++;
}

/* Can the format say in a row why there is none? */
static bool rows_has_place(const struct report *report)
{
    return report->format->separator == '\0' || report->has_error_column;
}

void rows_break_off(struct driver *driver, struct error *failure)
{
    struct report *report = &driver->report;
    if (!driver->begun || driver->has_ended) {
        output_flush(&driver->output);
        return;
    }
    if (!driver->is_broken_off && rows_has_place(report)) {
        struct passed_cell *none =
            ARENA_ARRAY(report->arena, report->passed_count + 1, struct passed_cell);
        for (size_t i = 0; i < report->passed_count; i++) {
            none[i] = (struct passed_cell){.text = text_of(""), .is_bare = true};
        }
        write_failure(driver, none, failure);
    }
    report->format->end(report);
    output_flush(&driver->output);
}

void rows_interrupted(void *context)
{
    struct driver *driver = context;
    struct arena arena = {0};
    struct error error, ignored;
    if (driver->begun) {
        interrupt_fail(&error);
    } else {
        fail(&error, ERROR_DOMAIN, "interrupted before anything was complete");
    }
    progress_erase(&driver->progress);
    if (driver->is_open) {
        driver->report.arena = &arena;
        rows_break_off(driver, &error);
        output_close(&driver->output, false, &ignored);
    }
    artifacts_abandon(&driver->artifacts);
    complain(&error, &driver->arguments, &driver->batch);
    _exit(ERROR_DOMAIN);
}

struct progress_state rows_state(const void *context)
{
    const struct driver *driver = context;
    size_t answered = driver->good + driver->failed, rows = driver->report.rows;
    double share = NAN;
    if (driver->is_batch) {
        share = batch_share(&driver->batch);
    } else if (driver->sweep.total > 1) {
        share = (double)driver->index / (double)driver->sweep.total;
    }
    return (struct progress_state){.rows = rows > answered ? rows : answered, .share = share};
}

static void count_answer(struct driver *driver, bool done, struct error *shortfall)
{
    bool is_short = done && shortfall->code != ERROR_NONE;
    if (is_short) {
        rows_say(driver, shortfall);
    }
    driver->failed += is_short;
    driver->good += done && !is_short;
    driver->has_answer = driver->has_answer || done;
}

/* Work that can be broken off: all but that for another command, whose answer is held by that. */
static void compute_begin(const struct driver *driver)
{
    if (!driver->is_inside) {
        interrupt_release();
    }
}

static void compute_end(const struct driver *driver)
{
    if (!driver->is_inside) {
        interrupt_hold();
    }
}

static bool run_one(struct driver *driver, struct error *error)
{
    driver->answered = driver->input;
    /* most have one sheet: their rows need no call */
    if (driver->command->choose_sheet != NULL && !rows_check_sheet(driver, error)) {
        return false;
    }
    driver->run.shortfall.code = ERROR_NONE;
    compute_begin(driver);
    bool done = driver->command->run(driver->input, &driver->run, error);
    compute_end(driver);
    count_answer(driver, done, &driver->run.shortfall);
    return done;
}

/* The first row of an input that is none of the question's. */
struct aside {
    struct driver *driver;
    void *input;
    const void *row;
};

static bool aside_keep(struct run *run, const void *row)
{
    struct aside *aside = run->driver;
    struct driver *driver = aside->driver;
    void *copy = arena_array(run->arena, 1, driver->report.sheet->row_size);
    if (driver->echo.count > 0) {
        row = echo_row(&driver->echo, row, aside->input, run->arena);
    }
    aside->row = memcpy(copy, row, driver->report.sheet->row_size);
    return false;
}

const void *rows_answer(void *context, void *input)
{
    struct driver *driver = context;
    const struct command *command = driver->command;
    struct aside aside = {driver, input, NULL};
    struct error ignored = {0};
    struct run run = driver->run;
    run.emit = aside_keep;
    run.driver = &aside;
    run.doubts = NULL;
    run.report = NULL;
    run.leads = NULL;
    if (command->choose_sheet != NULL &&
        command->choose_sheet(input, &driver->asking) != driver->echo.own) {
        return NULL;
    }
    const bool done = focal_settle(&driver->sweep.focal, input, NULL, &ignored) &&
                      command->run(input, &run, &ignored);
    return done ? aside.row : NULL;
}

/* One combination of several failed. False if that ends the sweep. */
static bool take_failure(struct driver *driver, struct error *error)
{
    const bool is_first = driver->good == 0 && driver->failed == 0;
    if (driver->is_batch && is_first && gaps_has(error) && !batch_knows_any(&driver->batch)) {
        gaps_refuse(error, &driver->batch);
        return false;
    }
    if (driver->common.fail_fast) {
        /* the status is that of the rows so far */
        if (driver->is_batch && gaps_has(error)) {
            gaps_explain(error, &driver->batch, driver->answered);
        }
        failure_name(driver, error);
        if (driver->begun && rows_has_place(&driver->report)) {
            write_failure(driver, driver->passed, error);
            driver->is_broken_off = true;
        }
        error->code = driver->good > 0 ? ERROR_ROWS : ERROR_DOMAIN;
        return false;
    }
    /* a row that failed keeps its place */
    driver->failed++;
    rows_say(driver, error);
    if (driver->common.table == NULL) {
        if (!driver->begun) {
            rows_begin(driver);
        }
        write_failure(driver, driver->passed, error);
    }
    progress_row(&driver->progress);
    return true;
}

/* Every combination of a sweep, by a team. */
static bool rows_by_team(struct driver *driver, struct error *error)
{
    const size_t size = driver->command->input_size, total = driver->sweep.total;
    const bool keeps = driver->collects || driver->artifacts.count > 0;
    driver->team = team_open(driver->command, &driver->run, driver->echo.own->row_size, total,
                             keeps, &driver->arena);
    const size_t most = team_size(driver->team);
    option_lens_at_once(&driver->lenses, most);
    struct team_answer *answers = ARENA_ARRAY(&driver->arena, most, struct team_answer);
    for (size_t k = 0; k < most; k++) {
        answers[k].input = arena_array(&driver->arena, 1, size);
    }
    for (size_t done = 0; done < total && is_going(driver); done += most) {
        const size_t here = total - done < most ? total - done : most;
        for (size_t k = 0; k < here; k++) {
            answers[k].is_missing =
                !sweep_recall(&driver->sweep, done + k, driver->input, &answers[k].error);
            memcpy(answers[k].input, driver->input, size);
        }
        compute_begin(driver);
        team_answer(driver->team, answers, here);
        compute_end(driver);
        for (size_t k = 0; k < here && is_going(driver); k++) {
            driver->index = done + k;
            struct team_answer *answer = &answers[k];
            driver->answered = answer->input;
            for (size_t i = 0; i < answer->count && is_going(driver); i++) {
                rows_emit(&driver->run, answer->rows + i * driver->echo.own->row_size);
            }
            count_answer(driver, answer->done, &answer->shortfall);
            if (!answer->done) {
                *error = answer->error;
                if (error->code == ERROR_USAGE || !take_failure(driver, error)) {
                    return false;
                }
            }
        }
    }
    return !interrupt_came() || interrupt_fail(error);
}

/* Every combination of a sweep; one combination is an ordinary answer. */
bool rows_of_sweep(struct driver *driver, struct error *error)
{
    if (driver->run.threads > 1 && driver->sweep.total > 1) {
        return rows_by_team(driver, error);
    }
    for (size_t i = 0; i < driver->sweep.total && is_going(driver); i++) {
        struct arena_mark mark = arena_mark(&driver->row_arena);
        driver->index = i;
        if (!sweep_recall(&driver->sweep, i, driver->input, error) || !run_one(driver, error)) {
            if (driver->sweep.total == 1 || error->code == ERROR_USAGE ||
                !take_failure(driver, error)) {
                return false;
            }
        }
        if (!driver->collects && driver->artifacts.count == 0) {
            arena_reset(&driver->row_arena, mark);
        }
    }
    const bool is_answered = driver->command->keeps_best && driver->sweep.total == 1;
    return is_answered || !interrupt_came() || interrupt_fail(error);
}

/* Compute the rows that wait, and print them in their order. */
static bool flush_queue(struct driver *driver, struct error *error)
{
    struct queue *queue = &driver->queue;
    bool going = true;
    compute_begin(driver);
    queue_run(queue, driver->command, &driver->run);
    compute_end(driver);
    for (size_t i = 0; i < queue->count && going && driver->output.failure == 0; i++) {
        driver->passed = queue_passed(queue, i);
        driver->answered = queue_input(queue, i);
        if (queue->errors[i].code == ERROR_NONE) {
            driver->good++;
            rows_emit(&driver->run, queue_row(queue, i));
        } else {
            *error = queue->errors[i];
            error_locate(error, driver->batch.source, queue->lines[i], 0);
            going = take_failure(driver, error);
        }
    }
    driver->passed = driver->batch.passed;
    queue->count = 0;
    return going;
}

/* Who feeds the pipe sees all answers before being waited for. */
static bool flush_before_read(void *data, struct error *error)
{
    struct driver *driver = data;
    bool going = flush_queue(driver, error);
    output_flush(&driver->output);
    return going;
}

/* The real focal length of a row; most rows have one, and no sensor of a wide lens. */
static bool rows_settle_focal(struct driver *driver, struct error *error)
{
    const struct focal_options *options = &driver->sweep.focal;
    const char *input = driver->input;
    const struct sensor_value *sensor =
        options->sensor != NULL ? (const void *)(input + options->sensor->offset) : NULL;
    bool is_plain = sensor == NULL || (!sensor->is_wide && sensor->with_lens == NULL);
    for (size_t i = 0; i < options->count; i++) {
        const struct option *option = options->focal[i];
        is_plain = is_plain && !focal_is_equivalent(option, input) &&
                   !((const struct focal_value *)(const void *)(input + option->offset))->of_camera;
    }
    return is_plain || focal_settle(options, driver->input, &driver->doubts, error);
}

/* A row of the batch: into the queue, or answered at once. False if that ends the batch. */
static bool rows_take_row(struct driver *driver, enum batch_result result, struct error *error)
{
    struct queue *queue = &driver->queue;
    if (result == BATCH_ROW && !rows_settle_focal(driver, error)) {
        error_locate(error, driver->batch.source, driver->batch.line, 0);
        result = BATCH_BAD_ROW;
    }
    if (result == BATCH_ROW && queue->capacity > 0) {
        queue_add(queue, driver->input, &driver->batch);
        return queue->count < queue->capacity || flush_queue(driver, error);
    }
    if (result == BATCH_ROW && run_one(driver, error)) {
        return true;
    }
    if (result == BATCH_ROW) {
        error_locate(error, driver->batch.source, driver->batch.line, 0);
    }
    struct error earlier;
    if (queue->count > 0 && !flush_queue(driver, &earlier)) {
        *error = earlier;
        return false;
    }
    driver->answered = driver->input; /* this one, not those that waited before it */
    return take_failure(driver, error);
}

bool rows_of_batch(struct driver *driver, struct error *error)
{
    const struct arena_mark mark = arena_mark(&driver->row_arena);
    const struct batch *batch = &driver->batch;
    driver->batch.before_read = flush_before_read;
    driver->batch.waiting = driver;
    for (;;) {
        enum batch_result result = batch_next(&driver->batch, driver->input, error);
        if (result == BATCH_END) {
            break;
        }
        if (result == BATCH_FAILED) {
            return false;
        }
        if (batch->column_count != driver->known_columns) {
            /* an object has keys that were not there before: what waits is printed without them */
            struct error earlier;
            driver->known_columns = batch->column_count;
            if (!flush_queue(driver, &earlier)) {
                *error = earlier;
                return false;
            }
            driver->queue.capacity = 0; /* it has no place for them */
            driver->passed = batch->passed;
            driver->report.passed_names = batch->passed_names;
            driver->report.passed_count = batch->passed_count;
        }
        if (!rows_take_row(driver, result, error)) {
            return false;
        }
        if (driver->queue.count == 0) {
            arena_reset(&driver->row_arena, mark);
        }
        if (!is_going(driver)) {
            break;
        }
    }
    const bool done = flush_queue(driver, error);
    /* how many rows lack what was said of the first of them */
    struct error rest;
    for (size_t i = 0; i < driver->gaps.count; i++) {
        if (gaps_rest(&driver->gaps, i, driver->batch.source, &rest)) {
            progress_erase(&driver->progress);
            error_print(&rest, driver->command->name, driver->arguments.color);
        }
    }
    return done && (!interrupt_came() || interrupt_fail(error));
}
