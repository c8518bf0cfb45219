/* cli/answer/driver.c - run a command: from its words to its printed rows. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/driver.h"

#include "cli/answer/collect.h"
#include "cli/answer/columns.h"
#include "cli/answer/complain.h"
#include "cli/answer/help.h"
#include "cli/answer/question.h"
#include "cli/answer/relay.h"
#include "cli/answer/rows.h"
#include "cli/batch/batch.h"
#include "cli/interrupt.h"
#include "cli/question/distance_word.h"
#include "cli/question/idle.h"
#include "cli/question/inputs.h"
#include "cli/question/settle.h"
#include "report/terminal.h"

#include <string.h>

enum { MOST_CELLS = 100000, MOST_POINTS = 1000000 };

static bool asked_in_rows(const void *asked, const char *option)
{
    const struct driver *driver = asked;
    return driver->is_batch && batch_has(&driver->batch, option);
}

/* The option that a column repeats, called by the column's name; else the name itself. */
static const char *asked_option_of(const void *asked, const char *name)
{
    const struct driver *driver = asked;
    const struct command *command = driver->command;
    for (size_t i = 0; i < command->option_count; i++) {
        const char *column = command->options[i].column;
        if (strcmp(command->options[i].name, name) == 0) {
            return name;
        }
        if (column != NULL && strcmp(column, name) == 0) {
            return command->options[i].name;
        }
    }
    return name;
}

static bool asked_given(const void *asked, const char *option)
{
    const struct driver *driver = asked;
    return arguments_given(&driver->arguments, option) || asked_in_rows(asked, option);
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
           asked_in_rows(asked, option);
}

static bool set_up_report(struct driver *driver, struct error *error)
{
    struct report *report = &driver->report;
    report->arena = &driver->arena;
    report->output = &driver->output;
    report->digits = (int)driver->common.digits;
    report->is_headless = driver->common.no_header;
    report->nominal = driver->common.nominal ? "--nominal" : NULL;
    report->defaults = configuration_words(&driver->arguments, &driver->arena);
    report->units = (enum unit_system)driver->common.units;
    report->many = report->many || driver->is_batch || driver->sweep.total > 1;
    report->has_error_column = (driver->is_batch || driver->sweep.total > 1) &&
                               driver->common.columns == NULL && report->format->separator != '\0';
    driver->selection =
        (struct selection){.columns = driver->common.columns,
                           .naming = driver->common.value != NULL ? "value" : "columns",
                           .many = driver->is_batch || driver->sweep.total > 1,
                           .layout = report->many ? SELECT_TABLE : SELECT_LIST,
                           .given = asked_brings,
                           .varied = asked_varied,
                           .option_of = asked_option_of,
                           .asked = driver};
    if (!report->format->is_for_people) {
        driver->selection.layout = SELECT_ALL;
    }
    if (!report_select(report, &driver->selection, error)) {
        return false;
    }
    if (driver->common.value != NULL && report->shown_count != 1) {
        return fail(error, ERROR_USAGE, "--value takes the name of one column");
    }
    echo_settle(&driver->echo, report);
    batch_ignore(&driver->batch, report->shown, report->shown_count);
    report->passed_names = driver->batch.passed_names;
    report->passed_count = driver->batch.passed_count;
    return true;
}

static const char *plot_columns(const struct driver *driver)
{
    return driver->common.columns != NULL ? driver->common.columns : driver->command->plot;
}

/* What stands for --batch in messages. */
static const char *batch_name(const struct driver *driver)
{
    return driver->photographs.count > 0 ? "photographs" : "--batch";
}

/* Rows of a sweep are kept for --table and --plot. */
static bool set_up_collection(struct driver *driver, struct error *error)
{
    const struct common *common = &driver->common;
    if (common->plot != NULL && driver->sweep.total == 1 && !driver->is_batch) {
        return fail(error, ERROR_USAGE,
                    "--plot needs an option with several values, such as a range");
    }
    driver->collects = common->table != NULL || common->plot != NULL;
    if (!driver->collects) {
        return true;
    }
    const char *option = common->table != NULL ? "table" : "plot";
    /* --table and --plot show one row of each value of a sweep */
    if (driver->is_batch) {
        return fail(error, ERROR_USAGE, "--%s works with swept options, not with %s", option,
                    batch_name(driver));
    }
    if (driver->command->makes_many != NULL && driver->command->makes_many(driver->input)) {
        return fail(error, ERROR_USAGE,
                    "--%s needs one row per combination, but this question has several", option);
    }
    driver->collection =
        (struct collection){.sweep = &driver->sweep,
                            .command = driver->command,
                            .sheet = driver->report.sheet,
                            .arena = &driver->arena,
                            .units = driver->report.units,
                            .answer = rows_answer,
                            .asked = driver,
                            .input = arena_array(&driver->arena, 1, driver->command->input_size)};
    memcpy(driver->collection.input, driver->input, driver->command->input_size);
    return collection_open(&driver->collection, common->table != NULL ? MOST_CELLS : MOST_POINTS,
                           option, error) &&
           (common->table == NULL ||
            cross_table_check(&driver->collection, common->table,
                              common->plot == NULL ? common->columns : NULL, &driver->report,
                              error)) &&
           (common->plot == NULL || collection_plot_check(&driver->collection, plot_columns(driver),
                                                          common->columns != NULL, error));
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
                                             .is_inside = driver->is_inside,
                                             .is_text = driver->report.format == &format_text,
                                             .asking = &driver->asking,
                                             .report = &driver->report,
                                             .run = &driver->run,
                                             .arena = &driver->arena};
    return artifacts_order(&driver->artifacts, &setting,
                           driver->common.plot != NULL ? &column_plot : NULL, driver, error);
}

/* Files beside the answer may take long. */
static bool make_artifacts(struct driver *driver, struct error *error)
{
    if (driver->is_inside) {
        return artifacts_make(&driver->artifacts, error);
    }
    interrupt_release();
    const bool done = artifacts_make(&driver->artifacts, error);
    interrupt_hold();
    return done;
}

static bool driver_finish(struct driver *driver, struct error *error)
{
    struct report *report = &driver->report;
    if (driver->common.table != NULL) {
        if (!cross_table_write(&driver->collection, driver->common.table, report, error)) {
            return false;
        }
    } else {
        if (!driver->begun && report->many) {
            rows_begin(driver);
        }
        if (driver->begun) {
            report->format->end(report);
            driver->has_ended = true;
        }
    }
    return !driver->has_answer || make_artifacts(driver, error);
}

static bool driver_prepare(struct driver *driver, int count, char **words, struct error *error)
{
    const struct command *command = driver->command;
    driver->db.arena = &driver->arena;
    driver->lenses.arena = &driver->arena;
    driver->reader =
        (struct reader){.db = &driver->db, .arena = &driver->arena, .lenses = &driver->lenses};
    driver->asking = (struct option_query){asked_given, asked_in_rows, driver};
    if (!arguments_parse(&driver->arguments, command, count, words, &driver->arena, error) ||
        !question_configure(driver, error) ||
        !arguments_settle(&driver->arguments, &driver->arena, error) ||
        !distance_word_settle(&driver->arguments, error)) {
        return false;
    }
    if (driver->defaults.is_there) {
        idle_yield(&driver->arguments, &driver->asking);
    }
    if (!arguments_common(&driver->arguments, &driver->reader, &driver->common, error)) {
        return false;
    }
    driver->arguments.color = (enum color_when)driver->common.color;
    driver->db.directory = driver->common.lensdb != NULL ? driver->common.lensdb : driver->database;
    driver->db.agf = driver->common.agf;
    driver->db.lossy = driver->common.lossy;
    driver->db.glass_numbers = (enum glass_numbers)driver->common.glass_numbers;
    driver->db.stop_size = (enum stop_size)driver->common.stop_size;
    if (!inputs_spare(&driver->arguments, &driver->db, driver->common.force, driver->common.output,
                      &driver->arena, error)) {
        return false;
    }
    driver->reader.doubts = &driver->doubts;
    for (size_t i = 0; i < driver->arguments.count; i++) {
        const struct argument *argument = &driver->arguments.all[i];
        if (argument->is_given && argument->reading != NULL) {
            warnings_add(&driver->doubts, "%s", argument->reading);
        }
    }
    driver->report.command = command->name;
    driver->report.doubts = &driver->doubts;
    driver->run = (struct run){.arena = &driver->row_arena,
                               .doubts = &driver->doubts,
                               .leads = &driver->report,
                               .watch = &driver->progress.watch,
                               .arguments = &driver->arguments,
                               .explain = driver->common.explain,
                               .kept = &driver->kept,
                               .db = &driver->db,
                               .emit = driver->is_inside ? rows_emit : rows_emit_amid,
                               .driver = driver};
    driver->reader.nominal = driver->common.nominal;
    driver->input = arena_array(&driver->arena, 1, command->input_size);
    return true;
}

static bool open_output(struct driver *driver, struct error *error)
{
    if (driver->is_inside) {
        output_inside(&driver->output, &driver->arena);
        return true;
    }
    if (!output_open(&driver->output, driver->common.output, &driver->arena, error)) {
        return false;
    }
    driver->is_open = true;
    if (driver->is_batch && batch_is_file(&driver->batch, driver->output.descriptor)) {
        return fail(error, ERROR_USAGE,
                    "--batch reads the file that rows are written to: it would have no end");
    }
    if (driver->report.format == &format_text) {
        terminal_prepare(&driver->output, driver->arguments.color);
        driver->report.remedy = "--columns NAMES chooses, --csv shows all";
    } else {
        terminal_guard(&driver->output);
    }
    return true;
}

/* Rows of a batch go to the command in blocks if it takes them; those of photographs are few. */
static bool takes_blocks(const struct driver *driver)
{
    const struct command *command = driver->command;
    return driver->is_batch && driver->photographs.count == 0 && command->takes_blocks != NULL &&
           command->takes_blocks(driver->input, &driver->asking);
}

/* Everything that can be wrong with the question is found before a byte is written. */
static bool driver_ask(struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    const struct common *common = &driver->common;
    /* rows that are kept for something point into what they were made from */
    driver->reader.recalls = !driver->is_inside && common->table == NULL && common->plot == NULL &&
                             !artifacts_asked(command, &driver->arguments);
    if (!common_format(common, arguments_given(&driver->arguments, "format"),
                       &driver->report.format, error) ||
        !question_settle(driver, error)) {
        return false;
    }
    const struct sheet *sheet = question_sheet(driver);
    const struct echo_question question = {.command = command,
                                           .sheet = sheet,
                                           .all = driver->common.columns != NULL,
                                           .is_for_people = driver->report.format->is_for_people,
                                           .given = asked_given,
                                           .varied = asked_varied,
                                           .asked = driver,
                                           .input = driver->input};
    echo_open(&driver->echo, &question, &driver->arena);
    driver->report.sheet = &driver->echo.sheet;
    if (takes_blocks(driver)) {
        queue_open(&driver->queue, command, sheet, driver->batch.passed_count, &driver->arena);
    }
    driver->common.columns = columns_from_options(command, driver->report.sheet,
                                                  common_columns(common), ",", &driver->arena);
    /* before a row is printed: a batch finds out row by row */
    for (size_t i = 0; command->choose_sheet != NULL && i < driver->sweep.total; i++) {
        if (!sweep_recall(&driver->sweep, i, driver->input, error) ||
            !rows_check_sheet(driver, error)) {
            return false;
        }
    }
    return set_up_report(driver, error) && set_up_collection(driver, error) &&
           order_artifacts(driver, error) && open_output(driver, error);
}

static bool driver_answer(struct driver *driver, struct error *error)
{
    const bool prints =
        !driver->collects && !driver->common.explain && driver->artifacts.count == 0;
    const struct command *command = driver->command;
    driver->run.report = prints ? &driver->report : NULL;
    driver->run.threads = command->threads != NULL ? command->threads(driver->input) : 1;
    if (!driver->is_inside) {
        progress_begin(&driver->progress, driver->command->name, rows_state, driver);
        driver->output.before_write = progress_make_way;
        driver->output.context = &driver->progress;
    }
    if (!driver->is_inside && (driver->report.many || driver->command->keeps_best)) {
        interrupt_watch(rows_interrupted, driver); /* rows so far are worth something */
    }
    bool done = (driver->is_batch ? rows_of_batch(driver, error) : rows_of_sweep(driver, error)) &&
                driver_finish(driver, error);
    if (!driver->is_inside) {
        progress_erase(&driver->progress);
    }
    if (!done) {
        rows_break_off(driver, error);
    }
    return done;
}

/* The files of the artifacts appear, or none. */
static bool close_artifacts(struct driver *driver, bool done, struct error *error)
{
    done = artifacts_close(&driver->artifacts, done && driver->has_answer, error) && done;
    struct text remarks = artifacts_remarks(&driver->artifacts, &driver->arena);
    if (done) {
        print_remark(remarks.start, remarks.length);
    }
    return done;
}

/* A command without rows: its answer is an artifact, which may be less than was asked. */
static int answer_without_rows(struct driver *driver)
{
    struct error error = {0};
    bool done = question_settle(driver, &error) &&
                sweep_check_single(&driver->sweep, driver->command, &error) &&
                order_artifacts(driver, &error);
    driver->report.defaults = configuration_words(&driver->arguments, &driver->arena);
    if (done) {
        progress_begin(&driver->progress, driver->command->name, rows_state, driver);
        interrupt_watch(rows_interrupted, driver); /* what there is so far may be worth something */
        done = make_artifacts(driver, &error);
        progress_erase(&driver->progress);
    }
    driver->has_answer = done;
    done = close_artifacts(driver, done, &error);
    if (done && driver->run.shortfall.code != ERROR_NONE) {
        error = driver->run.shortfall;
        done = false;
    }
    if (!done) {
        complain(&error, &driver->arguments, &driver->batch);
        return (int)error.code;
    }
    print_beside(&driver->report, true, driver->arguments.color);
    return 0;
}

/* That the solver is missing is said only of a question that it could answer: what is wrong with
   the question is to mend first. */
static int driver_compute(struct driver *driver)
{
    struct error error = {0}, closing = {0};
    bool done = driver_ask(driver, &error);
    if (done && driver->run.no_solver != NULL) {
        error = *driver->run.no_solver;
        done = false;
    }
    done = done && driver_answer(driver, &error);
    if (driver->is_open && !output_close(&driver->output, done, &closing)) {
        error = closing;
        done = false;
    }
    if (!close_artifacts(driver, done, &error)) {
        complain(&error, &driver->arguments, &driver->batch);
        return (int)error.code;
    }
    print_beside(&driver->report, driver->common.table != NULL, driver->arguments.color);
    if (driver->failed == 0) {
        return 0;
    }
    return driver->good > 0 ? ERROR_ROWS : ERROR_DOMAIN;
}

static void free_driver(struct driver *driver)
{
    if (driver->is_batch) {
        batch_close(&driver->batch);
    }
    team_close(driver->team);
    arena_free(&driver->row_arena);
    arena_free(&driver->kept);
    arena_free(&driver->doubts.arena);
    arena_free(&driver->arena);
}

/* Rows that nobody reads are not asked for where the drawing needs none of them. */
static bool draw_inside(struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    driver->run.threads = command->threads != NULL ? command->threads(driver->input) : 1;
    driver->run.shortfall.code = ERROR_NONE;
    const bool done = artifacts_make(&driver->artifacts, error);
    if (!done && driver->run.shortfall.code != ERROR_NONE) {
        *error = driver->run.shortfall; /* why there is nothing to draw */
    }
    return done;
}

/* The answer in memory: a drawing if there is one, else the rows. */
static bool answer_inside(struct driver *driver, struct text *answered, struct error *error)
{
    const struct artifacts *artifacts = &driver->artifacts;
    if (driver->command->run != NULL) {
        if (!driver_ask(driver, error)) {
            return false;
        }
        const bool needs_rows =
            artifacts->count == 0 || !artifacts->jobs[0].artifact->needs_no_rows;
        if (!(needs_rows ? driver_answer(driver, error) : draw_inside(driver, error))) {
            return false;
        }
    } else if (!sweep_build(&driver->sweep, &driver->arguments, &driver->reader, false,
                            driver->input, error) ||
               !order_artifacts(driver, error) || !artifacts_make(&driver->artifacts, error)) {
        return false;
    }
    *answered = output_kept(artifacts->count > 0 ? &artifacts->sinks[0] : &driver->output);
    return true;
}

bool command_embed(const struct embedded_command *embedding, struct run *outer,
                   struct text *answered, struct error *error)
{
    const struct driver *parent = outer->driver;
    struct driver driver = {.command = embedding->command,
                            .commands = parent->commands,
                            .database = parent->database,
                            .is_inside = true};
    struct text text = {NULL, 0};
    bool done = driver_prepare(&driver, (int)embedding->count, embedding->words, error);
    if (done) {
        driver.lenses.arena = outer->arena; /* as for a row, which knows lenses that were read */
        for (size_t i = 0; i < embedding->lens_count; i++) {
            option_lens_lend(&driver.lenses, &embedding->lenses[i]);
        }
        driver.db.directory = parent->db.directory;
        driver.db.agf = parent->db.agf;
        driver.db.lossy = parent->db.lossy;
        driver.db.glass_numbers = parent->db.glass_numbers;
        driver.db.stop_size = parent->db.stop_size;
        driver.run.watch = outer->watch;
        done = answer_inside(&driver, &text, error);
    }
    *answered = text_of(arena_string(outer->arena, done ? text.start : "", done ? text.length : 0));
    free_driver(&driver);
    return done;
}

static int execute(const struct again *question, const struct command *const *commands, char **argv,
                   const char *database, bool is_again);

static int answer_question(struct driver *driver, char **argv)
{
    const struct command *command = driver->command;
    struct error missing;
    if (driver->common.help || driver->common.usage) {
        return help_command(command, !driver->common.help, &driver->arena);
    }
    if (columns_are_asked(&driver->common)) {
        return columns_print(command, &driver->common, &driver->arena);
    }
    if (command->again != NULL) {
        /* a command that has another one answer */
        struct again question = {0};
        struct error error = {0};
        if (!sweep_build(&driver->sweep, &driver->arguments, &driver->reader, false, driver->input,
                         &error) ||
            !driver->command->again(driver->input, &driver->run, &question, &error)) {
            complain(&error, &driver->arguments, &driver->batch);
            return (int)error.code;
        }
        return execute(&question, driver->commands, argv, driver->database, true);
    }
    const bool lacks = relay_is_wanted(command, &driver->arguments) &&
                       !relay_to_ceres(argv, &driver->arena, &missing);
    driver->run.no_solver = lacks ? &missing : NULL;
    const int status = command->run == NULL ? answer_without_rows(driver) : driver_compute(driver);
    print_remark(driver->db.losses.data, driver->db.losses.length); /* of --lossy */
    return status;
}

/* Given argv, that of the program, for another one to take over. */
static int execute(const struct again *question, const struct command *const *commands, char **argv,
                   const char *database, bool is_again)
{
    struct driver driver = {.command = question->command,
                            .commands = commands,
                            .database = database,
                            .is_again = is_again};
    struct error error = {0};
    int status;
    if (!driver_prepare(&driver, question->count, question->words, &error)) {
        complain(&error, &driver.arguments, &driver.batch);
        status = (int)error.code;
    } else {
        driver.run.parts = question->parts;
        driver.run.part_count = question->part_count;
        status = answer_question(&driver, argv);
    }
    free_driver(&driver);
    return status;
}

int command_execute(const struct command *command, const struct command *const *commands, int argc,
                    char **argv, const char *database)
{
    const struct again question = {.command = command, .words = argv + 2, .count = argc - 2};
    return execute(&question, commands, argv, database, false);
}
