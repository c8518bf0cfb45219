/* cli/answer/columns.c - the columns a command prints, for whoever looks for one. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/columns.h"

#include "cli/answer/complain.h"
#include "cli/question/echo.h"
#include "cli/question/trade_names.h"
#include "report/report.h"

#include <string.h>

#define OF_COLUMN(member) COLUMN(struct column_row, member)

const struct column columns_of_columns[COLUMNS_OF_COLUMNS] = {
    {OF_COLUMN(command), .name = "command", .label = "command", .help = "whose rows have it"},
    {OF_COLUMN(column), .flags = COLUMN_BRIEF, .name = "column", .label = "column",
     .help = "its name in machine formats; without the unit it will do for --columns"},
    {OF_COLUMN(letter), .flags = COLUMN_BRIEF, .name = "letter", .label = "letter",
     .help = "of the option it repeats: a name for --columns and --table too"},
    {OF_COLUMN(unit), .flags = COLUMN_BRIEF, .name = "unit", .label = "unit",
     .help = "unit in machine formats"},
    {OF_COLUMN(label), .flags = COLUMN_BRIEF, .name = "label", .label = "label",
     .help = "as people read it: a name for --columns too"},
    {OF_COLUMN(help), .flags = COLUMN_BRIEF, .name = "meaning", .label = "meaning",
     .help = "in one sentence"},
    {OF_COLUMN(shown), .flags = COLUMN_BRIEF, .name = "shown", .label = "shown",
     .help = "where it is printed without --columns"},
};

static const struct sheet described = SHEET(columns_of_columns, struct column_row);

/* "with --film", or the kinds of answers that have it anyway. */
static const char *shown_where(const struct column *column, struct arena *arena)
{
    if ((column->flags & COLUMN_EXTRA) != 0 && (column->flags & COLUMN_ASSUMED) == 0) {
        struct text rest = text_of(column->with != NULL ? column->with : "");
        const char *words = rest.length > 0 ? "with" : "on request";
        for (const char *between = " "; rest.length > 0; between = ", ") {
            struct text option = text_cut(&rest, ' ');
            words =
                arena_printf(arena, "%s%s--%.*s", words, between, (int)option.length, option.start);
        }
        return words;
    }
    if ((column->flags & COLUMN_ASSUMED) != 0) {
        return "as an assumption";
    }
    if ((column->flags & COLUMN_NOTE) != 0) {
        return "as a warning";
    }
    if ((column->flags & COLUMN_HIDDEN) != 0) {
        return "in machine formats";
    }
    if ((column->flags & COLUMN_BRIEF) != 0) {
        return "always";
    }
    return "not in tables for people";
}

static bool has_column(const struct sheet *sheet, const char *name, size_t length)
{
    for (size_t i = 0; name != NULL && i < sheet->column_count; i++) {
        if (strlen(sheet->columns[i].name) == length &&
            memcmp(sheet->columns[i].name, name, length) == 0) {
            return true;
        }
    }
    return false;
}

static bool never(const void *asked, const char *option)
{
    (void)asked;
    (void)option;
    return false;
}

static struct column_row describe(const struct command *command, const struct column *column,
                                  struct arena *arena)
{
    const char *unit = column->unit, *letter = NULL;
    const struct option *option;
    for (size_t i = 0; letter == NULL && (option = command_option(command, i)) != NULL; i++) {
        if (option->letter != '\0' && option->column != NULL &&
            strcmp(option->column, column->name) == 0) {
            letter = arena_string(arena, &option->letter, 1);
        }
    }
    return (struct column_row){
        .command = command->name,
        .column = unit != NULL ? ARENA_JOIN(arena, column->name, "_", unit) : column->name,
        .letter = letter,
        .unit = unit != NULL ? unit_find(column->dimension, text_of(unit))->label : NULL,
        .label = column_label(column),
        .help = column->help,
        .shown = shown_where(column, arena),
    };
}

/* Of options with lists that some kind of row has no column for: each comes where one varies. */
static size_t describe_echoes(const struct command *command, const struct sheet *const *sheets,
                              struct column_row *rows, struct arena *arena)
{
    size_t count = 0;
    const char **names = ARENA_ARRAY(arena, command->option_count + 1, const char *);
    for (size_t i = 0; sheets[i] != NULL; i++) {
        const struct echo_question question = {
            .command = command, .sheet = sheets[i], .all = true, .given = never, .varied = never};
        struct echo echo;
        echo_open(&echo, &question, arena);
        for (size_t k = 0; k < echo.count; k++) {
            const struct column *column = &echo.sheet.columns[k];
            const struct option *option = echo.items[k].option;
            const bool is_named = option->kind->recall != NULL && option->column != NULL;
            bool known =
                !(option->kind->is_list || is_named) || (option->flags & OPTION_ASIDE) != 0;
            for (size_t n = 0; sheets[n] != NULL && !known; n++) {
                known = has_column(sheets[n], column->name, strlen(column->name));
            }
            for (size_t n = 0; n < count && !known; n++) {
                known = strcmp(names[n], column->name) == 0;
            }
            if (!known) {
                rows[count] = describe(command, column, arena);
                rows[count].shown = is_named
                                        ? "on request"
                                        : arena_printf(arena, "where --%s varies", column->with);
                names[count++] = column->name;
            }
        }
    }
    return count;
}

const struct column_row *columns_describe(const struct command *command, size_t *count,
                                          struct arena *arena)
{
    const struct sheet *const single[] = {&command->sheet, NULL};
    const struct sheet *const *sheets = command->sheets != NULL ? command->sheets : single;
    size_t most = command->option_count;
    for (size_t i = 0; sheets[i] != NULL; i++) {
        most += 2 * sheets[i]->column_count;
    }
    struct column_row *rows = ARENA_ARRAY(arena, most, struct column_row);
    *count = 0;
    for (size_t i = 0; sheets[i] != NULL; i++) {
        struct column *columns = ARENA_ARRAY(arena, 2 * sheets[i]->column_count, struct column);
        const size_t spread = sheet_spread(sheets[i], columns, arena);
        for (size_t k = 0; k < spread; k++) {
            const char *name = columns[k].name;
            bool stands_before = false;
            for (size_t earlier = 0; earlier < i && !stands_before; earlier++) {
                stands_before = has_column(sheets[earlier], name, strlen(name));
            }
            if (!stands_before) {
                rows[(*count)++] = describe(command, &columns[k], arena);
            }
        }
    }
    if (command->run != NULL) {
        *count += describe_echoes(command, sheets, rows + *count, arena);
    }
    return rows;
}

bool columns_are_asked(const struct common *common)
{
    const char *names = common_columns(common);
    return names != NULL && strcmp(names, "?") == 0;
}

int columns_print(const struct command *command, const struct common *common, struct arena *arena)
{
    const struct format *format;
    struct output output;
    struct error error;
    enum color_when color = (enum color_when)common->color;
    if (!common_format(common, common->format != 0, &format, &error)) {
        error_print(&error, command->name, color);
        return (int)error.code;
    }
    struct report report = {.format = format,
                            .output = &output,
                            .arena = arena,
                            .command = command->name,
                            .sheet = &described,
                            .is_headless = common->no_header,
                            .remedy = "--csv shows all",
                            .many = true};
    const struct selection selection = {.many = true,
                                        .layout = format->is_for_people ? SELECT_TABLE : SELECT_ALL,
                                        .given = never,
                                        .varied = never};
    if (!report_select(&report, &selection, &error) ||
        !output_open(&output, common->output, arena, &error)) {
        error_print(&error, command->name, color);
        return (int)error.code;
    }
    if (format == &format_text) {
        terminal_prepare(&output, color);
    }
    format->begin(&report);
    size_t count;
    const struct column_row *rows = columns_describe(command, &count, arena);
    for (size_t i = 0; i < count && output.failure == 0; i++) {
        format->row(&report, &rows[i], NULL, NULL);
        report.rows++;
    }
    format->end(&report);
    if (!output_close(&output, true, &error)) {
        error_print(&error, command->name, color);
        return (int)error.code;
    }
    return 0;
}

/* The column, perhaps with a unit, that the trade calls so; null: none of this sheet. */
static const char *column_of_trade(const struct sheet *sheet, struct text name, struct arena *arena)
{
    struct shown shown;
    struct error ignored;
    for (size_t i = 0; trade_columns[i].names != NULL; i++) {
        if (text_lists_name(trade_columns[i].names, name) &&
            report_find_column(sheet, text_of(trade_columns[i].option), arena, &shown, &ignored)) {
            return trade_columns[i].option;
        }
    }
    return NULL;
}

const char *columns_from_options(const struct command *command, const struct sheet *sheet,
                                 const char *names, const char *separators, struct arena *arena)
{
    const char *all = names != NULL ? "" : NULL;
    const struct sheet own = report_own_columns(sheet);
    struct shown shown;
    struct error ignored;
    while (names != NULL && *names != '\0') {
        size_t length = strcspn(names, separators);
        struct text name = text_trim((struct text){names, length});
        bool known = name.length == 0 || has_column(sheet, name.start, name.length);
        /* the column that repeats the option of this letter or name */
        const char *column = NULL;
        const struct option *option;
        for (size_t i = 0;
             !known && column == NULL && (option = command_option(command, i)) != NULL; i++) {
            bool letter = name.length == 1 && name.start[0] == option->letter;
            bool is_meant = letter || text_same_name(name, text_of(option->name));
            column = is_meant ? option->column : NULL;
        }
        bool taken = column != NULL && has_column(sheet, column, strlen(column));
        if (taken && !has_column(&own, column, strlen(column))) {
            /* it was added: a name that one of the command's own answers to means that */
            taken = !report_find_column(&own, name, arena, &shown, &ignored);
        }
        if (!known && !taken && !report_find_column(sheet, name, arena, &shown, &ignored)) {
            column = column_of_trade(sheet, name, arena);
            taken = column != NULL;
        }
        all = taken ? arena_printf(arena, "%s%s", all, column)
                    : arena_printf(arena, "%s%.*s", all, (int)length, names);
        names += length;
        if (*names != '\0') {
            all = arena_printf(arena, "%s%c", all, *names++);
        }
    }
    return all;
}
