/* cli/driver.c - run a command: from its words to its printed rows. */
/* SPDX-License-Identifier: MIT */
#include "cli/driver.h"

#include "cli/batch.h"
#include "cli/collect.h"
#include "cli/columns.h"
#include "cli/complain.h"
#include "cli/help.h"
#include "cli/idle.h"
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
    struct artifacts artifacts;
    struct asking asking; /* the columns of a batch count as given */
    struct arena kept;    /* of the command, until the end */
    struct doubts doubts;
    struct queue queue;        /* rows of the batch that wait to be computed together */
    const struct text *passed; /* columns handed through, of the row being printed */
    void *input;
    const char *database;
    bool is_batch, is_open, begun, collects;
    size_t index; /* of the present combination of the sweep */
    size_t good, failed;
    bool answered;         /* at least one input, if only in part */
    const void *explained; /* the row whose numbers --explain puts in */
    double started;
};

static bool asked_given(const void *asked, const char *option)
{
    const struct driver *driver = asked;
    return arguments_given(&driver->arguments, option) ||
           (driver->is_batch && batch_has(&driver->batch, option));
}

static bool asked_brings(const void *asked, const char *option)
{
    const struct driver *driver = asked;
    return asked_given(asked, option) ||
           (driver->command->brings != NULL && driver->command->brings(driver->input, option));
}

static bool asked_varied(const void *asked, const char *option)
{
    const struct driver *driver = asked;
    return sweep_axis(&driver->sweep, option) != NULL ||
           (driver->command->varies != NULL && driver->command->varies(driver->input, option)) ||
           (driver->is_batch && batch_has(&driver->batch, option));
}

/* All rows have the columns of the first input. */
static bool check_sheet(const struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    return command->choose_sheet == NULL ||
           command->choose_sheet(driver->input, &driver->asking) == driver->report.sheet ||
           fail(error, ERROR_USAGE,
                "these options ask for rows with other columns than the first: ask one at a time");
}

/* Before a row is printed: a batch finds out row by row. */
static bool check_sheets(struct driver *driver, struct error *error)
{
    size_t count = driver->command->choose_sheet != NULL ? driver->sweep.total : 0;
    for (size_t i = 0; i < count; i++) {
        sweep_set(&driver->sweep, i, driver->input);
        if (!check_sheet(driver, error)) {
            return false;
        }
    }
    return true;
}

static bool set_up_report(struct driver *driver, struct error *error)
{
    struct report *report = &driver->report;
    report->arena = &driver->arena;
    report->output = &driver->output;
    report->command = driver->command->name;
    report->digits = (int)driver->common.digits;
    report->nominal = driver->common.nominal ? "--nominal" : NULL;
    report->units = (enum unit_system)driver->common.units;
    report->many = report->many || driver->is_batch || driver->sweep.total > 1;
    report->has_error_column = (driver->is_batch || driver->sweep.total > 1) &&
                               driver->common.columns == NULL && report->format->separator != '\0';
    report->passed_names = driver->batch.passed_names;
    report->passed_count = driver->batch.passed_count;
    report->passed_bare = driver->batch.passed_bare;
    driver->selection = (struct selection){.columns = driver->common.columns,
                                           .many = driver->is_batch || driver->sweep.total > 1,
                                           .layout = !report->format->is_for_people ? SELECT_ALL
                                                     : report->many                 ? SELECT_TABLE
                                                                                    : SELECT_LIST,
                                           .given = asked_brings,
                                           .varied = asked_varied,
                                           .asked = driver};
    return report_select(report, &driver->selection, error);
}

static const char *plot_columns(const struct driver *driver)
{
    return driver->common.columns != NULL ? driver->common.columns : driver->command->plot;
}

/* Do --table and --plot suit the question? They show one row of each value of a sweep. */
static bool check_collects(const struct driver *driver, const char *option, struct error *error)
{
    if (driver->is_batch) {
        return fail(error, ERROR_USAGE, "--%s goes with swept options, not with --batch", option);
    }
    if (driver->command->makes_many != NULL && driver->command->makes_many(driver->input)) {
        return fail(error, ERROR_USAGE,
                    "--%s takes one row of each combination, this question has several", option);
    }
    return true;
}

/* Rows of a sweep are kept for --table and --plot. */
static bool set_up_collection(struct driver *driver, struct error *error)
{
    const struct common *common = &driver->common;
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
    if (!check_collects(driver, option, error)) {
        return false;
    }
    driver->collection = (struct collection){.sweep = &driver->sweep,
                                             .command = driver->command,
                                             .sheet = driver->report.sheet,
                                             .arena = &driver->arena,
                                             .units = driver->report.units};
    return collection_open(&driver->collection, common->table != NULL ? MOST_CELLS : MOST_POINTS,
                           option, error) &&
           (common->table == NULL ||
            cross_table_check(&driver->collection, driver->common.table, &driver->report, error)) &&
           (common->plot == NULL || collection_plot_check(&driver->collection, plot_columns(driver),
                                                          common->columns != NULL, error));
}

static void begin(struct driver *driver)
{
    driver->begun = true;
    driver->report.format->begin(&driver->report);
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
    if (driver->common.table == NULL) {
        if (!driver->begun) {
            begin(driver);
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
            begin(driver);
        }
        driver->report.format->row(&driver->report, NULL, driver->passed, failure);
        driver->report.rows++;
    }
}

static bool run_one(struct driver *driver, struct error *error)
{
    if (!check_sheet(driver, error)) {
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

/* --plot of a command that has no picture of its own: its columns. */
static bool draw_columns(const struct artifact_job *job, struct output *sink, struct error *error)
{
    const struct driver *driver = job->context;
    struct svg svg = {.arena = job->run->arena};
    const char *subtitle = report_subtitle(&driver->report, &driver->selection,
                                           collection_first_row(&driver->collection));
    return collection_plot(&driver->collection, plot_columns(driver),
                           driver->common.columns != NULL, subtitle, &svg, error) &&
           drawing_write(job, &svg, sink, error);
}

static const struct artifact column_plot = {
    .option = {.name = "plot", .types = drawing_types},
    .scope = ARTIFACT_OF_ROWS,
    .make = draw_columns,
};

static bool order_artifacts(struct driver *driver, struct error *error)
{
    const struct artifact_setting setting = {.command = driver->command,
                                             .arguments = &driver->arguments,
                                             .common = &driver->common,
                                             .sweep = &driver->sweep,
                                             .input = driver->input,
                                             .is_batch = driver->is_batch,
                                             .many = driver->report.many,
                                             .asking = &driver->asking,
                                             .run = &driver->run,
                                             .arena = &driver->arena};
    return artifacts_order(&driver->artifacts, &setting,
                           driver->common.plot != NULL ? &column_plot : NULL, driver, error);
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
    return !driver->answered || artifacts_make(&driver->artifacts, error);
}

static bool prepare(struct driver *driver, int count, char **words, struct error *error)
{
    const struct command *command = driver->command;
    driver->db.arena = &driver->arena;
    driver->lenses.arena = &driver->arena;
    driver->reader =
        (struct reader){.db = &driver->db, .arena = &driver->arena, .lenses = &driver->lenses};
    if (!arguments_parse(&driver->arguments, command, count, words, &driver->arena, error) ||
        !arguments_common(&driver->arguments, &driver->reader, &driver->common, error)) {
        return false;
    }
    driver->db.directory = driver->common.lensdb != NULL ? driver->common.lensdb : driver->database;
    driver->db.agf = driver->common.agf;
    driver->db.lossy = driver->common.lossy;
    driver->reader.doubts = &driver->doubts;
    driver->report.doubts = &driver->doubts;
    driver->run = (struct run){.arena = &driver->row_arena,
                               .doubts = &driver->doubts,
                               .kept = &driver->kept,
                               .db = &driver->db,
                               .emit = emit,
                               .driver = driver};
    driver->reader.nominal = driver->common.nominal;
    driver->asking = (struct asking){asked_given, driver};
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
    const struct batch_source source = {.path = common->batch,
                                        .format = (enum batch_format)common->batch_format,
                                        .arguments = &driver->arguments,
                                        .reader = &driver->reader,
                                        .constants = constants};
    if (!batch_open(&driver->batch, &source, error)) {
        return false;
    }
    driver->passed = driver->batch.passed;
    return true;
}

/* The sheet of this question. Rows of a batch go to the command in blocks if it takes them. */
static void choose_sheet(struct driver *driver)
{
    const struct command *command = driver->command;
    driver->report.sheet = command->choose_sheet != NULL
                               ? command->choose_sheet(driver->input, &driver->asking)
                               : &command->sheet;
    if (driver->is_batch && command->takes_blocks != NULL &&
        command->takes_blocks(driver->input, &driver->asking)) {
        queue_open(&driver->queue, command, driver->report.sheet, driver->batch.passed_count,
                   &driver->arena);
    }
}

/* Everything that can be wrong with the question is found before a byte is written. */
static bool ask(struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    const struct common *common = &driver->common;
    if (!common_format(common, arguments_given(&driver->arguments, "format"),
                       &driver->report.format, error) ||
        !sweep_build(&driver->sweep, &driver->arguments, &driver->reader, common->force,
                     driver->input, error)) {
        return false;
    }
    driver->report.many = command->makes_many != NULL && command->makes_many(driver->input);
    driver->is_batch = common->batch != NULL;
    if (driver->is_batch && !open_batch(driver, error)) {
        return false;
    }
    if (!idle_check(&driver->sweep, &driver->arguments, &driver->asking, driver->input, error)) {
        return false;
    }
    choose_sheet(driver);
    driver->common.columns =
        columns_from_options(command, driver->report.sheet, common->columns, ",", &driver->arena);
    return check_sheets(driver, error) && set_up_report(driver, error) &&
           set_up_collection(driver, error) && order_artifacts(driver, error) &&
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

/* The files of the artifacts appear, or none. */
static bool close_artifacts(struct driver *driver, bool done, struct error *error)
{
    done = artifacts_close(&driver->artifacts, done && driver->answered, error) && done;
    struct text remarks = artifacts_remarks(&driver->artifacts);
    if (done) {
        print_remark(remarks.start, remarks.length);
    }
    return done;
}

/* A command without rows: its answer is an artifact. */
static int answer_without_rows(struct driver *driver)
{
    struct error error = {0};
    bool done =
        sweep_build(&driver->sweep, &driver->arguments, &driver->reader, false, driver->input,
                    &error) &&
        sweep_check_single(&driver->sweep, driver->command->name, &error) &&
        idle_check(&driver->sweep, &driver->arguments, &driver->asking, driver->input, &error) &&
        order_artifacts(driver, &error) && artifacts_make(&driver->artifacts, &error);
    driver->answered = done;
    if (!close_artifacts(driver, done, &error)) {
        complain(&error, &driver->arguments, &driver->batch);
        return (int)error.code;
    }
    return 0;
}

static int status_of(const struct driver *driver)
{
    if (driver->failed == 0) {
        return 0;
    }
    return driver->good > 0 ? ERROR_ROWS : ERROR_DOMAIN;
}

/* That the solver is missing is said only of a question that it could answer: what is wrong with
   the question is to mend first. `missing` is null where nothing is. */
static int compute(struct driver *driver, const struct error *missing)
{
    struct error error = {0}, closing = {0};
    bool done = ask(driver, &error);
    if (done && missing != NULL) {
        error = *missing;
        done = false;
    }
    done = done && answer(driver, &error);
    if (driver->is_open && !output_close(&driver->output, done, &closing)) {
        error = closing;
        done = false;
    }
    if (!close_artifacts(driver, done, &error)) {
        complain(&error, &driver->arguments, &driver->batch);
        return (int)error.code;
    }
    print_beside(&driver->report, driver->common.table != NULL);
    return status_of(driver);
}

int command_execute(const struct command *command, int argc, char **argv, const char *database)
{
    struct driver driver = {.command = command, .database = database};
    struct error error = {0}, missing;
    int status;
    if (!prepare(&driver, argc - 2, argv + 2, &error)) {
        complain(&error, &driver.arguments, &driver.batch);
        status = (int)error.code;
    } else if (driver.common.help) {
        status = help_command(command, &driver.arena);
    } else if (columns_are_asked(&driver.common)) {
        status = columns_print(command, &driver.common, &driver.arena);
    } else {
        bool lacks = command->needs_ceres && !relay_to_ceres(argv, &driver.arena, &missing);
        status = command->run == NULL ? answer_without_rows(&driver)
                                      : compute(&driver, lacks ? &missing : NULL);
        print_remark(driver.db.losses.data, driver.db.losses.length); /* of --lossy */
    }
    if (driver.is_batch) {
        batch_close(&driver.batch);
    }
    arena_free(&driver.row_arena);
    arena_free(&driver.kept);
    arena_free(&driver.doubts.arena);
    arena_free(&driver.arena);
    return status;
}
