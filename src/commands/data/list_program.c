/* commands/data/list_program.c - lenscalc list: stop series, units, commands, options, columns, keywords. */
/* SPDX-License-Identifier: MIT */
#include "commands/commands.h"
#include "commands/data/list.h"
#include "commands/tables.h"

#include "cli/answer/columns.h"
#include "exchange/lens_formats.h"
#include "exchange/word_table.h"

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
            struct lensdb_stop *stops;
            size_t count;
            if (!lensdb_stops(list->run->db, quantities[i].file, series[j], &stops, &count,
                              error)) {
                return false;
            }
            for (size_t k = 0; k < count; k++) {
                struct stop_row row = {
                    .quantity = quantities[i].quantity,
                    .series = series[j],
                    .label = list_string(list, stops[k].label),
                    .note = list_string(list, stops[k].note),
                    .exact = stops[k].exact,
                    .off = quantities[i].stops_per_octave * log2(stops[k].value / stops[k].exact) +
                           0.0,
                };
                list_offer(list, &row, series[j],
                           (const char *[]){row.label, quantities[i].quantity, series[j]}, 3);
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
        list_offer(list, &row, row.group, (const char *[]){row.command, row.summary}, 2);
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
    list_offer(list, &row, command, (const char *[]){command, row.option}, 2);
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
            /* Is it of the commands of --kind, with the words that are searched for? */
            const char *const texts[] = {rows[k].column, rows[k].label, rows[k].help};
            bool found = words.length == 0;
            for (size_t j = 0; j < sizeof texts / sizeof texts[0] && !found; j++) {
                found = texts[j] != NULL && text_contains_name(text_of(texts[j]), words);
            }
            if (found && (list->input->kind == NULL ||
                          text_same_name(text_of(list->input->kind), text_of(rows[k].command)))) {
                list_row(list, &rows[k]);
            }
        }
    }
    return true;
}

/* -------- keywords -------- */

struct keyword_row {
    const char *keyword, *format, *place, *fate, *what;
};

#undef ROW
#define ROW struct keyword_row

static const struct column keyword_columns[] = {
    {SHOWN(keyword), .name = "keyword", BRIEF, .help = "the word"},
    {SHOWN(format), .name = "format", BRIEF, .help = "the kind of file it is of"},
    {SHOWN(place), .name = "place", BRIEF, .help = "where in the file it stands"},
    {SHOWN(fate), .name = "fate", BRIEF,
     .help = "kept (what a lens cannot hold of it is a loss), harmless, lost or refused"},
    {SHOWN(what), .name = "meaning", BRIEF, .help = "what it says"},
};

static bool list_keywords(struct list *list, struct error *error)
{
    (void)error;
    for (const struct foreign_format *const *one = foreign_formats; *one != NULL; one++) {
        struct word_entry entry = {(*one)->words, {NULL, 0}};
        while (entry.group != NULL && word_table_next(&entry)) {
            const struct keyword_row row = {list_string(list, entry.word), (*one)->type.word.word,
                                            entry.group->place, word_fate_name(entry.group->fate),
                                            entry.group->what};
            list_offer(list, &row, row.format, (const char *[]){row.keyword, row.fate, row.what},
                       3);
        }
    }
    return true;
}

const struct topic topic_keywords = {SHEET(keyword_columns, struct keyword_row), list_keywords,
                                     false};

const struct topic topic_stops = {SHEET(stop_columns, struct stop_row), list_stops, false};
const struct topic topic_units = {SHEET(unit_columns, struct unit_row), list_program_list_units,
                                  false};
const struct topic topic_commands = {SHEET(command_columns, struct command_row), list_commands,
                                     false};
const struct topic topic_options = {SHEET(option_columns, struct option_row),
                                    list_program_list_options, false};
const struct topic topic_columns = {SHEET(columns_of_columns, struct column_row), list_columns,
                                    false};
