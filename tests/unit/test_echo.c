/* tests/unit/test_echo.c - whatever option varies, a column says which value a row has. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "cli/question/echo.h"
#include "commands/commands.h"

#include <string.h>

static struct arena arena;

/* The only option that is given, with several values. */
static bool is_asked(const void *asked, const char *option)
{
    return strcmp(asked, option) == 0;
}

static bool shows_once(const struct report *report, const struct option *option)
{
    size_t says = 0, same_name = 0;
    for (size_t i = 0; i < report->shown_count; i++) {
        says += text_equal(column_repeated(report->shown[i].column), option->name);
        for (size_t k = 0; k < i; k++) {
            same_name += strcmp(report->shown[i].name, report->shown[k].name) == 0;
        }
    }
    return says > 0 && same_name == 0;
}

/* Does a column say that it tells it in another form? A point by its x. */
static bool is_otherwise_told(const struct sheet *sheet, const struct option *option)
{
    bool found = false;
    for (size_t i = 0; i < sheet->column_count && !found; i++) {
        const char *tells = sheet->columns[i].tells;
        found = tells != NULL && strcmp(tells, option->name) == 0;
    }
    return found;
}

/* Of all columns, of a table for people, and of one with a column that somebody names. */
static bool is_told(const struct command *command, const struct sheet *sheet,
                    const struct option *option)
{
    const struct selection selections[] = {
        {.many = true, .layout = SELECT_ALL},
        {.many = true, .layout = SELECT_TABLE},
        {.many = true, .layout = SELECT_TABLE, .columns = sheet->columns[0].name},
        {.many = true,
         .layout = SELECT_TABLE,
         .columns = sheet->columns[sheet->column_count - 1].name},
    };
    bool told = true;
    for (size_t i = 0; i < sizeof selections / sizeof selections[0]; i++) {
        const struct echo_question question = {.command = command,
                                               .sheet = sheet,
                                               .all = selections[i].columns != NULL,
                                               .is_for_people = selections[i].layout != SELECT_ALL,
                                               .given = is_asked,
                                               .varied = is_asked,
                                               .asked = option->name};
        struct echo echo;
        echo_open(&echo, &question, &arena);
        struct report report = {.arena = &arena, .sheet = &echo.sheet, .many = true};
        struct selection selection = selections[i];
        selection.given = selection.varied = is_asked;
        selection.asked = option->name;
        struct error error;
        told = report_select(&report, &selection, &error) && told &&
               (shows_once(&report, option) ||
                (!question.is_for_people && is_otherwise_told(sheet, option)));
        echo_settle(&echo, &report);
        told = told && echo.sheet.row_size >= sheet->row_size;
    }
    return told;
}

/* What --columns may call a column of the command by still means that one. */
static void check_names(const struct command *command, const struct sheet *sheet)
{
    const struct echo_question question = {.command = command,
                                           .sheet = sheet,
                                           .all = true,
                                           .given = is_asked,
                                           .varied = is_asked,
                                           .asked = ""};
    struct echo echo;
    echo_open(&echo, &question, &arena);
    for (size_t i = 0; i < echo.count; i++) {
        struct shown shown;
        struct error error;
        const char *name = echo.sheet.columns[i].name;
        const bool is_new = !report_find_column(sheet, text_of(name), &arena, &shown, &error);
        CHECK(is_new);
        if (!is_new) {
            printf("    %s: '%s' is '%s' too\n", command->name, name, shown.name);
        }
    }
}

/* The title of a lens tells lenses apart; a column of its name, which finds it, is there on
   request. */
static void check_name_of_lens(const struct command *command, const struct sheet *sheet,
                               const struct option *option)
{
    const struct echo_question question = {.command = command,
                                           .sheet = sheet,
                                           .all = true,
                                           .given = is_asked,
                                           .varied = is_asked,
                                           .asked = option->name};
    struct echo echo;
    echo_open(&echo, &question, &arena);
    size_t found = 0;
    for (size_t i = 0; i < echo.sheet.column_count; i++) {
        found += strcmp(echo.sheet.columns[i].name, "lens_name") == 0;
    }
    CHECK(found == 1);
}

static void check_sheet(const struct command *command, const struct sheet *sheet)
{
    check_names(command, sheet);
    for (size_t i = 0; i < command->option_count; i++) {
        const struct option *option = &command->options[i];
        if (option->kind == &kind_lens && option->column != NULL) {
            check_name_of_lens(command, sheet, option);
        }
        if (option->kind->is_list || (option->flags & OPTION_MANY) != 0) {
            const bool told = is_told(command, sheet, option);
            CHECK(told);
            if (!told) {
                printf("    %s --%s, rows with the column %s\n", command->name, option->name,
                       sheet->columns[0].name);
            }
        }
    }
}

/* Every option that may have several values, of every command and every kind of its rows. */
static void check_commands(void)
{
    for (size_t i = 0; commands[i] != NULL; i++) {
        const struct sheet *const single[] = {&commands[i]->sheet, NULL};
        const struct sheet *const *sheets =
            commands[i]->sheets != NULL ? commands[i]->sheets : single;
        for (size_t k = 0; commands[i]->run != NULL && sheets[k] != NULL; k++) {
            check_sheet(commands[i], sheets[k]);
        }
    }
}

struct input {
    double distance, fnumber;
    long rays;
    int aim;
    struct vector_value point;
};

static const struct word aims[] = {{"stop", ""}, {"entrance", ""}, {NULL, NULL}};

static const struct option options[] = {
    {OPTION(struct input, distance), .name = "distance", .dimension = &dimension_length,
     .unit = "mm"},
    {OPTION(struct input, fnumber), .name = "aperture", .column = "fnumber",
     .dimension = &dimension_fnumber, .lowest = 0, .highest = INFINITY,
     .flags = OPTION_NO_INFINITY},
    {OPTION(struct input, rays), .name = "rays-wanted"},
    {OPTION(struct input, aim), .name = "aim", .words = aims},
    {OPTION(struct input, point), .name = "point", .dimension = &dimension_length, .unit = "mm"},
};

struct row {
    bool answer; /* members that follow must lie where a double may */
};

static const struct column columns[] = {{COLUMN(struct row, answer), .name = "answer"}};

static bool always(const void *asked, const char *option)
{
    (void)asked;
    (void)option;
    return true;
}

static const struct column *column_of(const struct echo *echo, const char *name)
{
    for (size_t i = 0; i < echo->sheet.column_count; i++) {
        if (strcmp(echo->sheet.columns[i].name, name) == 0) {
            return &echo->sheet.columns[i];
        }
    }
    return NULL;
}

static void check_values(void)
{
    const struct command command = {.options = options, .option_count = 5};
    const struct sheet sheet = SHEET(columns, struct row);
    const struct echo_question question = {
        .command = &command, .sheet = &sheet, .given = always, .varied = always};
    const struct input input = {INFINITY, 5.6, 500, 1, {true, {0, 1.5, -20}}};
    const struct row row = {true};
    struct echo echo;
    echo_open(&echo, &question, &arena);
    CHECK(echo.sheet.column_count == 6);
    CHECK_TEXT(echo.sheet.columns[0].name, "distance"); /* those that were added stand first */
    CHECK_TEXT(echo.sheet.columns[5].name, "answer");
    CHECK((column_of(&echo, "distance")->flags & COLUMN_INFINITE) != 0);
    CHECK((column_of(&echo, "fnumber")->flags & COLUMN_INFINITE) == 0);
    const void *longer = echo_row(&echo, &row, &input, &arena);
    CHECK(row_flag(longer, column_of(&echo, "answer")));
    CHECK(isinf(row_number(longer, column_of(&echo, "distance"))));
    CHECK_NEAR(row_number(longer, column_of(&echo, "fnumber")), 5.6, 0, "f-number");
    CHECK(row_integer(longer, column_of(&echo, "rays_wanted")) == 500);
    CHECK_TEXT(row_text(longer, column_of(&echo, "aim")), "entrance");
    CHECK_TEXT(row_text(longer, column_of(&echo, "point")), "0:1.5:-20mm");
}

int main(void)
{
    check_commands();
    check_values();
    arena_free(&arena);
    return check_report();
}
