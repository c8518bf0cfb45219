/* cli/answer/question.c - options, defaults and the columns of a batch into the input of a command. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/question.h"

#include "cli/question/configuration.h"
#include "cli/question/idle.h"

#include <string.h>

bool question_configure(struct driver *driver, struct error *error)
{
    struct arguments *arguments = &driver->arguments;
    const struct argument *kit = arguments_find(arguments, text_of("kit"));
    if (driver->is_inside || driver->is_again || !command_has_defaults(driver->command) ||
        arguments_given(arguments, "no-config") || arguments_given(arguments, "help") ||
        arguments_given(arguments, "usage")) {
        return true;
    }
    struct configuration_use use = {
        .commands = driver->commands,
        .kits =
            kit->is_given ? arena_string(&driver->arena, kit->text.start, kit->text.length) : NULL,
        .has_database = driver->database != NULL,
        .arena = &driver->arena};
    arguments->defaults = &driver->defaults;
    if (!configuration_open(&driver->defaults, &use.opened, &driver->arena, error)) {
        return false;
    }
    if (!driver->defaults.is_there) {
        const char *path = driver->defaults.source;
        return use.kits == NULL ||
               fail(error, ERROR_USAGE, "--kit '%s': %s%s", use.kits,
                    path != NULL ? "there is no file " : "no configuration is read",
                    path != NULL ? path : "");
    }
    return configuration_check(&driver->defaults, driver->commands, error) &&
           configuration_apply(&use, arguments, error);
}

const struct sheet *question_sheet(const struct driver *driver)
{
    const struct command *command = driver->command;
    const bool chooses = command->choose_sheet != NULL;
    return chooses ? command->choose_sheet(driver->input, &driver->asking) : &command->sheet;
}

static bool question_open_batch(struct driver *driver, struct error *error)
{
    const struct common *common = &driver->common;
    if (driver->sweep.total > 1) {
        return fail(error, ERROR_USAGE, "%s and options with several values exclude each other",
                    driver->photographs.count > 0 ? "photographs" : "--batch");
    }
    driver->constants = arena_array(&driver->arena, 1, driver->command->input_size);
    memcpy(driver->constants, driver->input, driver->command->input_size);
    /* what the header needs lies below the first row's mark and stays */
    driver->reader.arena = &driver->row_arena;
    driver->batch = (struct batch){.arguments = &driver->arguments,
                                   .reader = &driver->reader,
                                   .arena = &driver->arena,
                                   .sheet = question_sheet(driver),
                                   .commands = driver->commands,
                                   .constants = driver->constants};
    const bool is_open = driver->photographs.count > 0
                             ? photographs_open(&driver->batch, &driver->photographs, error)
                             : batch_open(&driver->batch, common->batch,
                                          (enum batch_format)common->batch_format, error);
    if (!is_open || !batch_settle(&driver->batch, question_sheet(driver),
                                  driver->report.format->is_keyed, error)) {
        return false;
    }
    driver->passed = driver->batch.passed;
    driver->known_columns = driver->batch.column_count;
    if (!batch_knows_any(&driver->batch) &&
        (driver->photographs.count == 0 || photographs_any(&driver->batch))) {
        warnings_add(&driver->doubts,
                     "no column of %s means anything to %s: all its rows have one answer",
                     driver->batch.source, driver->command->name);
    }
    return true;
}

/* The options into the input; not into the arena of a batch's rows. */
static bool question_build(struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    struct arena *const arena = driver->reader.arena;
    driver->reader.arena = &driver->arena;
    const bool built = sweep_build(&driver->sweep, &driver->arguments, &driver->reader,
                                   driver->common.force, driver->input, error);
    driver->reader.arena = arena;
    driver->report.many =
        built && command->makes_many != NULL && command->makes_many(driver->input);
    return built;
}

/* The same, without defaults that turn out to say nothing. */
static bool question_build_whole(struct driver *driver, struct error *error)
{
    bool withdrawn = true;
    while (withdrawn) {
        if (!question_build(driver, error) ||
            !idle_check(&driver->sweep, &driver->arguments, &driver->asking, driver->input,
                        &withdrawn, error)) {
            return false;
        }
    }
    return true;
}

/* -------- defaults of what is solved for -------- */

enum { MOST_SOLVED = 6 };

static bool trial_emit(struct run *run, const void *row)
{
    (void)run;
    (void)row;
    return true;
}

/* Has the first combination an answer, and to the question asked? It leaves nothing behind. */
static bool trial_is_answered(struct driver *driver)
{
    struct arena rows = {0}, kept = {0};
    struct warnings doubts = {0};
    struct report leads = {.arena = &kept};
    struct error ignored = {0};
    struct run run = {.arena = &rows,
                      .kept = &kept,
                      .db = &driver->db,
                      .emit = trial_emit,
                      .doubts = &doubts,
                      .leads = &leads,
                      .arguments = &driver->arguments,
                      .threads = 1};
    void *input = arena_array(&kept, 1, driver->command->input_size);
    memcpy(input, driver->input, driver->command->input_size);
    const bool done = sweep_recall(&driver->sweep, 0, input, &ignored) &&
                      driver->command->run(input, &run, &ignored) && leads.title == NULL;
    arena_free(&rows);
    arena_free(&doubts.arena);
    arena_free(&kept);
    return done;
}

/* A default that may be one value too many: a number, a lens, or, if nothing else is, a sensor. */
static bool is_solved_for(const struct argument *argument)
{
    const struct option_kind *kind = argument->option->kind;
    return argument->is_given && argument->is_input && argument_rank(argument) < RANK_KIT &&
           (kind->number_of != NULL || kind == &kind_lens || kind == &kind_sensor);
}

/* The places of such defaults, sensors last; their count. */
static size_t find_solved_for(const struct arguments *arguments, size_t places[MOST_SOLVED])
{
    size_t count = 0;
    for (int sensors = 0; sensors <= 1; sensors++) {
        for (size_t i = 0; i < arguments->count && count < MOST_SOLVED; i++) {
            const struct argument *argument = &arguments->all[i];
            if (is_solved_for(argument) &&
                (argument->option->kind == &kind_sensor) == (sensors == 1)) {
                places[count++] = i;
            }
        }
    }
    return count;
}

static int count_bits(unsigned set)
{
    int count = 0;
    for (; set != 0; set &= set - 1) {
        count++;
    }
    return count;
}

/*
 * Where a command solves for what is not given, a default may be one value too many. As few of them
 * are withdrawn as give the question an answer; if none does it stays as it is, to say why.
 */
static bool question_yield(struct driver *driver, struct error *error)
{
    struct arguments *arguments = &driver->arguments;
    size_t places[MOST_SOLVED];
    const size_t count = find_solved_for(arguments, places);
    if (count == 0 || trial_is_answered(driver)) {
        return true;
    }
    const size_t size = arguments->count * sizeof *arguments->all;
    struct argument *whole = arena_array(&driver->arena, arguments->count, sizeof *whole);
    memcpy(whole, arguments->all, size);
    for (int most = 1; most <= (int)count; most++) {
        for (unsigned set = 1; set < 1U << count; set++) {
            if (count_bits(set) != most) {
                continue;
            }
            memcpy(arguments->all, whole, size);
            for (size_t i = 0; i < count; i++) {
                if ((set >> i & 1) != 0) {
                    arguments_withdraw(arguments, &arguments->all[places[i]]);
                }
            }
            struct error ignored = {0};
            if (question_build_whole(driver, &ignored) && trial_is_answered(driver)) {
                return true;
            }
        }
    }
    memcpy(arguments->all, whole, size);
    arguments_note_given(arguments);
    return question_build_whole(driver, error);
}

/* A batch whose columns say what is wanted has no use for defaults of what is solved for. */
static void batch_yield(struct driver *driver)
{
    struct arguments *arguments = &driver->arguments;
    bool has_goal = false;
    for (size_t i = 0; i < driver->batch.column_count; i++) {
        const struct batch_column *column = &driver->batch.columns[i];
        has_goal = has_goal || (column->option != NULL && !column->is_ignored &&
                                (column->option->flags & OPTION_GOAL) != 0);
    }
    for (size_t i = 0; has_goal && i < arguments->count; i++) {
        if ((arguments->all[i].option->flags & OPTION_SETTING) != 0 &&
            is_solved_for(&arguments->all[i])) {
            arguments_withdraw(arguments, &arguments->all[i]);
        }
    }
}

bool question_settle(struct driver *driver, struct error *error)
{
    const struct command *command = driver->command;
    if (!question_build(driver, error)) {
        return false;
    }
    if (!photographs_find(&driver->arguments, &driver->common, &driver->photographs, &driver->arena,
                          error)) {
        return false;
    }
    driver->is_batch = driver->common.batch != NULL || driver->photographs.count > 0;
    if (driver->is_batch && !question_open_batch(driver, error)) {
        return false;
    }
    if (!driver->defaults.is_there) {
        bool withdrawn;
        return idle_check(&driver->sweep, &driver->arguments, &driver->asking, driver->input,
                          &withdrawn, error);
    }
    if (driver->is_batch) {
        batch_yield(driver);
    }
    if (!question_build_whole(driver, error)) {
        return false;
    }
    if (driver->is_batch) {
        memcpy(driver->constants, driver->input, command->input_size);
    }
    return driver->is_batch || command->run == NULL || !command_solves(command) ||
           question_yield(driver, error);
}
