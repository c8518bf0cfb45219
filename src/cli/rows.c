/* cli/rows.c - the rows of a question: every combination of a sweep, every line of a batch. */
/* SPDX-License-Identifier: MIT */
#include "cli/rows.h"

#include "cli/complain.h"
#include "report/explain.h"

#include <string.h>

enum { PROGRESS_ROWS = 65536 };

/* All rows have the columns of the first input. */
bool rows_check_sheet(const struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    return command->choose_sheet == NULL ||
           command->choose_sheet(driver->input, &driver->asking) == driver->report.sheet ||
           fail(error, ERROR_USAGE,
                "these options ask for rows with other columns than the first: ask one at a time");
}

void rows_begin(struct driver *driver)
{
    driver->begun = true;
    driver->report.format->begin(&driver->report);
}

bool rows_emit(struct run *run, const void *row)
{
    struct driver *driver = run->driver;
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
    if (driver->common.table == NULL) {
        if (!driver->begun) {
            rows_begin(driver);
        }
        report->format->row(report, row, driver->passed, NULL);
        report->rows++;
    }
    return driver->output.failure == 0;
}

/* A row that failed keeps its place. */
static void emit_failure(struct driver *driver, struct error *failure)
{
    driver->failed++;
    complain(failure, &driver->arguments, &driver->batch);
    if (driver->common.table == NULL) {
        if (!driver->begun) {
            rows_begin(driver);
        }
        driver->report.format->row(&driver->report, NULL, driver->passed, failure);
        driver->report.rows++;
    }
}

static bool run_one(struct driver *driver, struct error *error)
{
    if (!rows_check_sheet(driver, error)) {
        return false;
    }
    struct error *shortfall = &driver->run.shortfall;
    shortfall->code = ERROR_NONE;
    bool done = driver->command->run(driver->input, &driver->run, error);
    bool is_short = done && shortfall->code != ERROR_NONE;
    if (is_short) {
        complain(shortfall, &driver->arguments, &driver->batch);
    }
    driver->failed += is_short;
    driver->good += done && !is_short;
    driver->answered = driver->answered || done;
    return done;
}

/* --fail-fast: the status is that of the rows so far. Returns false. */
static bool stop_early(const struct driver *driver, struct error *error)
{
    error->code = driver->good > 0 ? ERROR_ROWS : ERROR_DOMAIN;
    return false;
}

/* Every combination of a sweep; one combination is an ordinary answer. */
bool rows_of_sweep(struct driver *driver, struct error *error)
{
    for (size_t i = 0; i < driver->sweep.total && driver->output.failure == 0; i++) {
        struct arena_mark mark = arena_mark(&driver->row_arena);
        driver->index = i;
        sweep_set(&driver->sweep, i, driver->input);
        if (!run_one(driver, error)) {
            if (driver->sweep.total == 1 || error->code == ERROR_USAGE) {
                return false;
            }
            if (driver->common.fail_fast) {
                return stop_early(driver, error);
            }
            emit_failure(driver, error);
        }
        if (!driver->collects && driver->artifacts.count == 0) {
            arena_reset(&driver->row_arena, mark);
        }
        progress_show(driver->started, i, false);
    }
    if (driver->sweep.total > PROGRESS_ROWS) {
        progress_show(driver->started, driver->sweep.total, true);
    }
    return true;
}

/* A row that cannot be answered. False if that ends the batch. */
static bool take_failure(struct driver *driver, struct error *error)
{
    if (driver->common.fail_fast) {
        return stop_early(driver, error);
    }
    emit_failure(driver, error);
    return true;
}

/* Compute the rows that wait, and print them in their order. */
static bool flush_queue(struct driver *driver, struct error *error)
{
    struct queue *queue = &driver->queue;
    bool going = true;
    queue_run(queue, driver->command, &driver->run);
    for (size_t i = 0; i < queue->count && going && driver->output.failure == 0; i++) {
        driver->passed = queue_passed(queue, i);
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

/* A row of the batch: into the queue, or answered at once. False if that ends the batch. */
static bool take_row(struct driver *driver, enum batch_result result, struct error *error)
{
    struct queue *queue = &driver->queue;
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
    return take_failure(driver, error);
}

bool rows_of_batch(struct driver *driver, struct error *error)
{
    size_t rows = 0;
    const struct arena_mark mark = arena_mark(&driver->row_arena);
    driver->batch.before_read = flush_before_read;
    driver->batch.waiting = driver;
    for (;; rows++) {
        enum batch_result result = batch_next(&driver->batch, driver->input, error);
        if (result == BATCH_END) {
            break;
        }
        if (result == BATCH_FAILED || !take_row(driver, result, error)) {
            return false;
        }
        if (driver->queue.count == 0) {
            arena_reset(&driver->row_arena, mark);
        }
        if (driver->output.failure != 0) {
            break;
        }
        progress_show(driver->started, rows, false);
    }
    progress_show(driver->started, rows, true);
    return flush_queue(driver, error);
}
