/* cli/driver.c - run a command: from its words to its printed rows. */
/* SPDX-License-Identifier: MIT */
#include "cli/driver.h"

#include "cli/batch.h"
#include "cli/collect.h"
#include "cli/complain.h"
#include "cli/drawings.h"
#include "cli/help.h"
#include "commands/photo/photo_lens.h"
#include "cli/queue.h"
#include "cli/relay.h"
#include "report/explain.h"

#include <stdio.h>
#include <string.h>

enum { MOST_CELLS = 100000, MOST_POINTS = 1000000, PROGRESS_ROWS = 65536 };

/* One command at work. */
struct driver {
    const struct command *command;
    struct arena arena;     /* until the end */
    struct arena row_arena; /* until the next input */
    struct lensdb db;
    struct reader reader;
    struct lens_cache lenses;
    struct arguments arguments;
    struct common common;
    struct sweep sweep;
    struct batch batch;
    struct run run;
    struct report report;
    struct selection selection;
    struct output output;
    struct collection collection;
    struct arena kept;         /* of the command, until the end */
    struct queue queue;        /* rows of the batch that wait to be computed together */
    const struct text *passed; /* columns handed through, of the row being printed */
    void *input;
    const char *database;
    bool is_batch, is_open, begun, collects;
    size_t index; /* of the present combination of the sweep */
    size_t good, failed;
    const void *explained; /* the row whose numbers --explain puts in */
    double started;
};

/* Common options into their struct. */
static bool read_common(struct driver *driver, struct error *error)
{
    for (size_t i = 0; i < driver->arguments.count; i++) {
        const struct argument *argument = &driver->arguments.all[i];
        const struct option *option = argument->option;
        void *member = (char *)&driver->common + option->offset;
        if (!argument->is_common) {
            continue;
        }
        if (argument->is_given && option->kind == &kind_flag) {
            *(bool *)member = true;
        } else if (argument->is_given || option->fallback != NULL) {
            struct text text = argument->is_given ? argument->text : text_of(option->fallback);
            if (!option_read(&driver->reader, option, text, member, error)) {
                return false;
            }
        }
    }
    return true;
}

static bool choose_format(struct driver *driver, struct error *error)
{
    const struct common *common = &driver->common;
    int shorts = common->csv + common->tsv + common->json + common->jsonl;
    if (shorts + arguments_given(&driver->arguments, "format") > 1) {
        return fail(error, ERROR_USAGE, "more than one output format is given");
    }
    driver->report.format = common->csv     ? &format_csv
                            : common->tsv   ? &format_tsv
                            : common->json  ? &format_json
                            : common->jsonl ? &format_jsonl
                                            : formats[common->format];
    return true;
}

static bool is_for_people(const struct report *report)
{
    return report->format == &format_text || report->format == &format_markdown ||
           report->format == &format_html;
}

static bool asked_given(const void *asked, const char *option)
{
    const struct driver *driver = asked;
    return arguments_given(&driver->arguments, option) ||
           (driver->is_batch && batch_has(&driver->batch, option));
}

/* Does a photographic question go through several positions of a lens? */
static bool has_positions(const struct driver *driver)
{
    const void *question = (const char *)driver->input + driver->command->lens;
    return driver->command->lens != 0 && photo_lens_makes_many(question);
}

static bool asked_varied(const void *asked, const char *option)
{
    const struct driver *driver = asked;
    return sweep_axis(&driver->sweep, option) != NULL ||
           (driver->command->varies != NULL && driver->command->varies(driver->input, option)) ||
           (strcmp(option, "position") == 0 && has_positions(driver)) ||
           (driver->is_batch && batch_has(&driver->batch, option));
}

static bool set_up_report(struct driver *driver, struct error *error)
{
    struct report *report = &driver->report;
    report->arena = &driver->arena;
    report->output = &driver->output;
    report->command = driver->command->name;
    report->digits = (int)driver->common.digits;
    report->nominal = driver->common.nominal;
    report->units = (enum unit_system)driver->common.units;
    report->many = report->many || driver->is_batch || driver->sweep.total > 1;
    report->has_error_column = (driver->is_batch || driver->sweep.total > 1) &&
                               driver->common.columns == NULL &&
                               (report->format == &format_csv || report->format == &format_tsv);
    report->passed_names = driver->batch.passed_names;
    report->passed_count = driver->batch.passed_count;
    report->passed_bare = driver->batch.passed_bare;
    driver->selection = (struct selection){.columns = driver->common.columns,
                                           .many = driver->is_batch || driver->sweep.total > 1,
                                           .layout = !is_for_people(report) ? SELECT_ALL
                                                     : report->many         ? SELECT_TABLE
                                                                            : SELECT_LIST,
                                           .given = asked_given,
                                           .varied = asked_varied,
                                           .asked = driver};
    return report_select(report, &driver->selection, error);
}

static const char *plot_columns(const struct driver *driver)
{
    return driver->common.columns != NULL ? driver->common.columns : driver->command->plot;
}

/* Rows of a sweep are kept for --table and --plot. */
static bool set_up_collection(struct driver *driver, struct error *error)
{
    const struct common *common = &driver->common;
    if (driver->command->picture != NULL && common->table == NULL && !driver->is_batch) {
        return true;
    }
    if (common->plot != NULL && driver->sweep.total == 1 && !driver->is_batch) {
        return fail(error, ERROR_USAGE,
                    "--plot wants an option with several values, such as a "
                    "range");
    }
    driver->collects = common->table != NULL || common->plot != NULL;
    if (!driver->collects) {
        return true;
    }
    const char *option = common->table != NULL ? "table" : "plot";
    if (driver->is_batch) {
        return fail(error, ERROR_USAGE, "--%s goes with swept options, not with --batch", option);
    }
    driver->collection = (struct collection){.sweep = &driver->sweep,
                                             .command = driver->command,
                                             .sheet = driver->report.sheet,
                                             .arena = &driver->arena,
                                             .units = driver->report.units};
    if (!collection_open(&driver->collection, common->table != NULL ? MOST_CELLS : MOST_POINTS,
                         option, error)) {
        return false;
    }
    const struct format *format = driver->report.format;
    if (common->table != NULL && (format == &format_json || format == &format_jsonl)) {
        return fail(error, ERROR_USAGE, "--table is for text, csv, tsv, markdown and html");
    }
    return (common->table == NULL ||
            cross_table_check(&driver->collection, common->table, &driver->report, error)) &&
           (common->plot == NULL || collection_plot_check(&driver->collection, plot_columns(driver),
                                                          common->columns != NULL, error));
}

static void begin(struct driver *driver)
{
    driver->begun = true;
    driver->report.format->begin(&driver->report);
}

static bool prints_rows(const struct driver *driver)
{
    return driver->common.table == NULL;
}

static bool emit(struct run *run, const void *row)
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
    if (prints_rows(driver)) {
        if (!driver->begun) {
            begin(driver);
        }
        report->format->row(report, row, driver->passed, NULL);
        report->rows++;
    }
    return driver->output.failure == 0;
}

/* A row that failed keeps its place. */
static void emit_failure(struct driver *driver, const struct error *failure)
{
    driver->failed++;
    error_print(failure, driver->command->name);
    if (prints_rows(driver)) {
        if (!driver->begun) {
            begin(driver);
        }
        driver->report.format->row(&driver->report, NULL, driver->passed, failure);
        driver->report.rows++;
    }
}

static bool run_one(struct driver *driver, struct error *error)
{
    bool done = driver->command->run(driver->input, &driver->run, error);
    driver->good += done;
    return done;
}

/* --fail-fast: the status is that of the rows so far. Returns false. */
static bool stop_early(const struct driver *driver, struct error *error)
{
    error->code = driver->good > 0 ? ERROR_ROWS : ERROR_DOMAIN;
    return false;
}

/* Every combination of a sweep; one combination is an ordinary answer. */
static bool run_sweep(struct driver *driver, struct error *error)
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
        if (!driver->collects) {
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
            emit(&driver->run, queue_row(queue, i));
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

static bool run_batch(struct driver *driver, struct error *error)
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

static bool write_plot(struct driver *driver, struct error *error)
{
    if (driver->command->picture != NULL) {
        return picture_write(driver->command, &driver->sweep, driver->input, driver->common.plot,
                             &driver->arena, error);
    }
    struct svg svg = {.arena = &driver->arena};
    const char *subtitle = report_subtitle(&driver->report, &driver->selection,
                                           collection_first_row(&driver->collection));
    return collection_plot(&driver->collection, plot_columns(driver),
                           driver->common.columns != NULL, subtitle, &svg, error) &&
           output_file(driver->common.plot, svg.data, svg.length, &driver->arena, error);
}

static bool finish(struct driver *driver, struct error *error)
{
    struct report *report = &driver->report;
    if (driver->common.table != NULL) {
        if (!cross_table_write(&driver->collection, driver->common.table, report, error)) {
            return false;
        }
    } else {
        if (!driver->begun && report->many) {
            begin(driver);
        }
        if (driver->begun) {
            report->format->end(report);
        }
    }
    if (driver->common.plot != NULL && driver->good > 0 && !write_plot(driver, error)) {
        return false;
    }
    return drawings_write(driver->command, driver->input, &driver->arena, error);
}

static bool prepare(struct driver *driver, int count, char **words, struct error *error)
{
    const struct command *command = driver->command;
    driver->db.arena = &driver->arena;
    driver->lenses.arena = &driver->arena;
    driver->reader =
        (struct reader){.db = &driver->db, .arena = &driver->arena, .lenses = &driver->lenses};
    if (!arguments_parse(&driver->arguments, command, count, words, &driver->arena, error) ||
        !read_common(driver, error)) {
        return false;
    }
    driver->db.directory = driver->common.lensdb != NULL ? driver->common.lensdb : driver->database;
    driver->db.agf = driver->common.agf;
    driver->db.lossy = driver->common.lossy;
    driver->run = (struct run){.arena = &driver->row_arena,
                               .kept = &driver->kept,
                               .db = &driver->db,
                               .emit = emit,
                               .driver = driver,
                               .force = driver->common.force};
    driver->reader.nominal = driver->common.nominal;
    driver->input = arena_array(&driver->arena, 1, command->input_size);
    return true;
}

/* The options as read so far are the constants of all rows. */
static bool open_batch(struct driver *driver, struct error *error)
{
    const struct common *common = &driver->common;
    if (driver->sweep.total > 1) {
        return fail(error, ERROR_USAGE,
                    "--batch and options with several values exclude each other");
    }
    void *constants = arena_array(&driver->arena, 1, driver->command->input_size);
    memcpy(constants, driver->input, driver->command->input_size);
    /* what the header needs lies below the first row's mark and stays */
    driver->reader.arena = &driver->row_arena;
    if (!batch_open(&driver->batch, common->batch, (enum batch_format)common->batch_format,
                    &driver->arguments, &driver->reader, constants, error)) {
        return false;
    }
    driver->passed = driver->batch.passed;
    return true;
}

/* Everything that can be wrong with the question is found before a byte is written. */
static bool ask(struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    const struct common *common = &driver->common;
    if (!choose_format(driver, error) ||
        !sweep_build(&driver->sweep, &driver->arguments, &driver->reader, common->force,
                     driver->input, error)) {
        return false;
    }
    driver->report.many = (command->makes_many != NULL && command->makes_many(driver->input)) ||
                          has_positions(driver);
    driver->is_batch = common->batch != NULL;
    if (driver->is_batch && !open_batch(driver, error)) {
        return false;
    }
    /* the columns of a batch count as given */
    const struct asking asking = {asked_given, driver};
    driver->report.sheet = command->choose_sheet != NULL
                               ? command->choose_sheet(driver->input, &asking)
                               : &command->sheet;
    if (driver->is_batch && command->takes_blocks != NULL &&
        command->takes_blocks(driver->input, &asking)) {
        queue_open(&driver->queue, command, driver->report.sheet, driver->batch.passed_count,
                   &driver->arena);
    }
    return set_up_report(driver, error) && set_up_collection(driver, error) &&
           drawings_check(command, driver->input, driver->report.many, error) &&
           output_open(&driver->output, common->output, &driver->arena, error) &&
           (driver->is_open = true);
}

static bool answer(struct driver *driver, struct error *error)
{
    driver->started = progress_now();
    bool done = (driver->is_batch ? run_batch(driver, error) : run_sweep(driver, error)) &&
                finish(driver, error);
    if (driver->begun && !done) {
        /* rows before the failure were promised to the pipe; a file would be half a file */
        output_flush(&driver->output);
    }
    return done;
}

/* What is said beside an answer: nothing has no address. */
static void remark(const char *start, size_t length)
{
    if (length > 0) {
        fwrite(start, 1, length, stderr);
    }
}

static int print_text(struct driver *driver, struct error *error)
{
    bool done = sweep_build(&driver->sweep, &driver->arguments, &driver->reader, false,
                            driver->input, error) &&
                sweep_check_single(&driver->sweep, driver->command->name, error) &&
                output_open(&driver->output, driver->common.output, &driver->arena, error);
    if (done) {
        done = driver->command->print(driver->input, &driver->output, error);
        struct error closing;
        if (!output_close(&driver->output, done, &closing) && done) {
            *error = closing;
            done = false;
        }
    }
    if (!done) {
        error_print(error, driver->command->name);
    } else {
        remark(driver->output.remarks.start, driver->output.remarks.length);
    }
    return done ? 0 : (int)error->code;
}

static int status_of(const struct driver *driver)
{
    if (driver->failed == 0) {
        return 0;
    }
    return driver->good > 0 ? ERROR_ROWS : ERROR_DOMAIN;
}

static int compute(struct driver *driver)
{
    struct error error = {0}, closing = {0};
    bool done = ask(driver, &error) && answer(driver, &error);
    bool closed = true;
    if (driver->is_open) {
        closed = output_close(&driver->output, done, &closing);
    }
    if (!closed) {
        error = closing;
    }
    if (!done || !closed) {
        error_print(&error, driver->command->name);
        return (int)error.code;
    }
    if (driver->report.explain != NULL && driver->report.format != &format_json &&
        !is_for_people(&driver->report)) {
        fprintf(stderr, "%s\n", driver->report.explain);
    }
    return status_of(driver);
}

int command_execute(const struct command *command, int argc, char **argv, const char *database)
{
    struct driver driver = {.command = command, .database = database};
    struct error error = {0};
    int status;
    if (!prepare(&driver, argc - 2, argv + 2, &error) ||
        (command->needs_ceres && !driver.common.help &&
         !relay_to_ceres(argv, &driver.arena, &error))) {
        error_print(&error, command->name);
        status = (int)error.code;
    } else if (driver.common.help) {
        status = help_command(command, &driver.arena);
    } else {
        status = command->print != NULL ? print_text(&driver, &error) : compute(&driver);
        remark(driver.db.losses.data, driver.db.losses.length); /* of --lossy */
    }
    if (driver.is_batch) {
        batch_close(&driver.batch);
    }
    arena_free(&driver.row_arena);
    arena_free(&driver.kept);
    arena_free(&driver.arena);
    return status;
}
