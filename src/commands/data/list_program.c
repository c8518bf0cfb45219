/* commands/data/list_program.c - lenscalc list: stop series, units, commands, options. */
/* SPDX-License-Identifier: MIT */
#include "commands/commands.h"
#include "commands/data/list.h"
#include "commands/tables.h"

#include "cli/answer/columns.h"

#include <math.h>

/* Stop series. */
struct stop_row {
    const char *quantity, *series, *label, *note;
    double exact, off;
};

#define ROW struct stop_row

static const struct column stop_columns[] = {
    {SHOWN(quantity), .name = "quantity", BRIEF, .help = "f-number, time in s, or ISO"},
    {SHOWN(series), .name = "series", BRIEF, .help = "full, half or third stops"},
    {SHOWN(label), .name = "label", BRIEF, .help = "as lenses and cameras print it"},
    {SHOWN(exact), .name = "exact", BRIEF, .help = "the value --nominal puts in its place"},
    {SHOWN(off), .name = "label_error_stops", BRIEF, .label = "label is off by",
     .help = "light by the label over light by the exact value, stops"},
    {SHOWN(note), .name = "note", .help = "remark"},
};

static bool list_series(struct list *list, const char *file, const char *quantity,
                        double stops_per_octave, const char *series, struct error *error)
{
    struct lensdb_stop *stops;
    size_t count;
    if (!lensdb_stops(list->run->db, file, series, &stops, &count, error)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        struct stop_row row = {
            .quantity = quantity,
            .series = series,
            .label = list_string(list, stops[i].label),
            .note = list_string(list, stops[i].note),
            .exact = stops[i].exact,
            .off = stops_per_octave * log2(stops[i].value / stops[i].exact) + 0.0,
        };
        if (list_matches(list, series, (const char *[]){row.label, quantity, series}, 3)) {
            list_row(list, &row);
        }
    }
    return true;
}

static bool list_stops(struct list *list, struct error *error)
{
    static const struct {
        const char *file, *quantity;
        double stops_per_octave; /* a larger f-number passes less light */
    } quantities[] = {
        {"fstops.tsv", "f-number", -2}, {"shutters.tsv", "time (s)", 1}, {"iso.tsv", "iso", 1}};
    static const char *const series[] = {"full", "half", "third"};
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) {
            if (!list_series(list, quantities[i].file, quantities[i].quantity,
                             quantities[i].stops_per_octave, series[j], error)) {
                return false;
            }
        }
    }
    return true;
}

/* Units. */
struct unit_row {
    const char *dimension, *unit, *spellings, *help;
    double value;
};

#undef ROW
#define ROW struct unit_row

static const struct column unit_columns[] = {
    {SHOWN(dimension), .name = "dimension", BRIEF, .help = "what it measures"},
    {SHOWN(unit), .name = "unit", BRIEF,
     .help = "as it is typed, and as it ends the name of a column"},
    {SHOWN(spellings), .name = "spellings", BRIEF, .label = "also typed",
     .help = "other spellings"},
    {SHOWN(value), .name = "value", BRIEF | COLUMN_ECHO,
     .help = "in the first unit of its dimension"},
    {SHOWN(help), .name = "help", BRIEF, .label = "meaning", .help = "in words"},
};

static bool list_program_list_units(struct list *list, struct error *error)
{
    (void)error;
    for (size_t i = 0; dimensions[i] != NULL; i++) {
        for (size_t j = 0; j < dimensions[i]->unit_count; j++) {
            const struct unit *unit = &dimensions[i]->units[j];
            struct unit_row row = {dimensions[i]->name, unit->name, unit->spellings, unit->help,
                                   unit_to_own(unit, 1)};
            if (unit->name[0] != '\0' &&
                list_matches(list, row.dimension,
                             (const char *[]){row.dimension, row.unit, row.spellings, row.help},
                             4)) {
                list_row(list, &row);
            }
        }
    }
    return true;
}

/* Commands and their options. */
struct command_row {
    const char *command, *group, *summary;
};

#undef ROW
#define ROW struct command_row

static const struct column command_columns[] = {
    {SHOWN(command), .name = "command", BRIEF, .help = "its name"},
    {SHOWN(group), .name = "group", BRIEF, .help = "what it is about"},
    {SHOWN(summary), .name = "summary", BRIEF, .help = "what it does"},
};

static bool list_commands(struct list *list, struct error *error)
{
    (void)error;
    for (size_t i = 0; commands[i] != NULL; i++) {
        struct command_row row = {commands[i]->name, commands[i]->group, commands[i]->summary};
        if (list_matches(list, row.group, (const char *[]){row.command, row.summary}, 2)) {
            list_row(list, &row);
        }
    }
    return true;
}

struct option_row {
    const char *command, *option, *letter, *value, *unit, *range, *fallback, *help;
};

#undef ROW
#define ROW struct option_row

static const struct column option_columns[] = {
    {SHOWN(command), .name = "command", BRIEF, .help = "whose option it is; all = a common one"},
    {SHOWN(option), .name = "option", BRIEF, .help = "its name"},
    {SHOWN(letter), .name = "letter", BRIEF, .help = "its short form"},
    {SHOWN(value), .name = "value", BRIEF, .help = "what it takes"},
    {SHOWN(unit), .name = "unit", BRIEF, .help = "unit of a bare number"},
    {SHOWN(range), .name = "range", BRIEF, .help = "legal range"},
    {SHOWN(fallback), .name = "default", BRIEF, .help = "what it is if not given"},
    {SHOWN(help), .name = "help", BRIEF, .help = "what it is for"},
};

static void list_option(struct list *list, const char *command, const struct option *option)
{
    const struct unit *unit = option_unit(option);
    const char *range = option_range(option, list->run->arena);
    struct option_row row = {
        .command = command,
        .option = arena_printf(list->run->arena, "--%s", option->name),
        .letter =
            option->letter != '\0' ? arena_printf(list->run->arena, "-%c", option->letter) : NULL,
        .value = option->value,
        .unit = unit != NULL && unit->name[0] != '\0' ? unit->name : NULL,
        .range = range[0] != '\0' ? range : NULL,
        .fallback = option->fallback,
        .help = option->help,
    };
    if (list_matches(list, command, (const char *[]){command, row.option}, 2)) {
        list_row(list, &row);
    }
}

static bool list_program_list_options(struct list *list, struct error *error)
{
    (void)error;
    for (size_t i = 0; commands[i] != NULL; i++) {
        for (size_t j = 0; command_option(commands[i], j) != NULL; j++) {
            list_option(list, commands[i]->name, command_option(commands[i], j));
        }
    }
    for (size_t j = 0; j < common_option_count; j++) {
        list_option(list, "all", &common_options[j]);
    }
    return true;
}

/* Is it of the commands of --kind, with the words that are searched for? */
static bool list_column_is_found(const struct column_row *row, const char *kind, struct text words)
{
    const char *const texts[] = {row->column, row->label, row->help};
    bool found = words.length == 0;
    for (size_t i = 0; i < sizeof texts / sizeof texts[0] && !found; i++) {
        found = texts[i] != NULL && text_contains_name(text_of(texts[i]), words);
    }
    return found && (kind == NULL || text_same_name(text_of(kind), text_of(row->command)));
}

static bool list_columns(struct list *list, struct error *error)
{
    (void)error;
    const char *searched = list->input->search != NULL ? list->input->search : "";
    struct text behind = text_of(searched);
    const struct command *only = command_find(text_cut(&behind, ' '));
    const struct text words = only != NULL ? behind : text_of(searched);
    for (size_t i = 0; commands[i] != NULL; i++) {
        size_t count = 0;
        const struct column_row *rows = NULL;
        if ((only == NULL || only == commands[i]) && commands[i]->run != NULL) {
            rows = columns_describe(commands[i], &count, list->run->arena);
        }
        for (size_t k = 0; k < count; k++) {
            if (list_column_is_found(&rows[k], list->input->kind, words)) {
                list_row(list, &rows[k]);
            }
        }
    }
    return true;
}

const struct topic topic_stops = {SHEET(stop_columns, struct stop_row), list_stops, false};
const struct topic topic_units = {SHEET(unit_columns, struct unit_row), list_program_list_units,
                                  false};
const struct topic topic_commands = {SHEET(command_columns, struct command_row), list_commands,
                                     false};
const struct topic topic_options = {SHEET(option_columns, struct option_row),
                                    list_program_list_options, false};
const struct topic topic_columns = {SHEET(columns_of_columns, struct column_row), list_columns,
                                    false};
