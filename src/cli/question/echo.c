/* cli/question/echo.c - columns that repeat the options which vary, where a command has none for them. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/echo.h"

#include <math.h>
#include <string.h>

enum { VALUE = 8 }; /* bytes that any value of a row fits in */

/* A name with another sign between its words: "ceiling_subject". */
static const char *spelt(const char *name, char sign, char other, struct arena *arena)
{
    char *copy = arena_array(arena, strlen(name) + 1, 1);
    for (size_t i = 0; name[i] != '\0'; i++) {
        copy[i] = name[i] == sign ? other : name[i];
    }
    return copy;
}

static const char *column_name(const struct option *option, struct arena *arena)
{
    return option->column != NULL ? option->column : spelt(option->name, '-', '_', arena);
}

/* Is it named as the option, or does it follow from it first of all? */
static bool echo_is_like(const struct column *column, const struct option *option, const char *name)
{
    struct text depends = text_of(column->depends != NULL ? column->depends : "");
    const bool assumed = (column->flags & COLUMN_ASSUMED) != 0;
    return strcmp(column->name, name) == 0 ||
           (assumed && text_equal(text_cut(&depends, ' '), option->name));
}

/* Place of the column that says which value of the option a row has; their count: none does. */
static size_t echo_find_column(const struct sheet *sheet, const struct option *option,
                               const char *name)
{
    const size_t count = sheet->column_count;
    size_t i = 0;
    while (i < count && !text_equal(column_repeated(&sheet->columns[i]), option->name)) {
        i++;
    }
    if (i < count) {
        return i;
    }
    i = 0;
    while (i < count && !echo_is_like(&sheet->columns[i], option, name)) {
        i++;
    }
    return i;
}

/* Does a column say it in another form? */
static bool is_told(const struct sheet *sheet, const struct option *option)
{
    bool told = false;
    for (size_t i = 0; i < sheet->column_count && !told; i++) {
        const char *tells = sheet->columns[i].tells;
        told = tells != NULL && strcmp(tells, option->name) == 0;
    }
    return told;
}

/* It tells rows apart here, whatever else brings it or keeps it back. */
static void bring(struct column *column, const struct option *option)
{
    const unsigned kept_back = COLUMN_HIDDEN | COLUMN_TIED | COLUMN_WITH;
    column->repeats = option->name;
    column->flags = (column->flags & ~kept_back) | COLUMN_BRIEF;
    if (!text_lists(column->with, text_of(option->name))) {
        column->flags &= ~(unsigned)COLUMN_EXTRA;
        column->with = NULL;
    }
}

static bool echo_is_number(const struct option *option)
{
    return option->kind == &kind_quantity || option->kind == &kind_wavelength ||
           option->kind == &kind_focal;
}

static enum column_type echo_type_of(const struct option *option)
{
    if (echo_is_number(option)) {
        return COLUMN_NUMBER;
    }
    if (option->kind == &kind_count) {
        return COLUMN_INTEGER;
    }
    if (option->kind == &kind_flag) {
        return COLUMN_FLAG;
    }
    return COLUMN_TEXT;
}

/* Does another column tell its values apart than one by which they are read again? A lens's title
   does, but its name is what finds it. */
static bool echo_is_other(const struct column *column, const struct option *option)
{
    return option->kind->recall != NULL && option->column != NULL &&
           strcmp(column->name, option->column) != 0;
}

/* Are there words or numbers for its values? */
static bool is_sayable(const struct option *option)
{
    return echo_type_of(option) != COLUMN_TEXT || option_has_names(option) ||
           option->kind->words_of != NULL;
}

static bool may_be_infinite(const struct option *option)
{
    return option->kind == &kind_quantity && (option->flags & OPTION_NO_INFINITY) == 0 &&
           (isinf(option->highest) || (option->lowest == 0 && option->highest == 0));
}

/* What was given as an equivalent focal length stands among the assumptions, beside the sensor. */
static void add_equivalent(struct echo *echo, const struct option *option, struct column *place,
                           struct arena *arena)
{
    *place = (struct column){
        .name = arena_printf(arena, "%s_equivalent", column_name(option, arena)),
        .unit = "mm",
        .dimension = &dimension_length,
        .type = COLUMN_NUMBER,
        .offset = echo->sheet.row_size,
        .flags = COLUMN_ASSUMED | COLUMN_EXTRA | COLUMN_ECHO,
        .depends = option->name,
        .label = "equivalent focal length",
        .help = "focal length with the same diagonal angle on 36 x 24 mm, as given",
    };
    echo->sheet.row_size += VALUE;
    echo->sheet.column_count++;
    echo->items[echo->count++] = (struct echo_item){option, place->offset, true, true};
}

/* A column of an option's values, behind those that were added before. Where one of the command
   tells them apart it is there on request. */
static void echo_add_column(struct echo *echo, const struct option *option, bool on_request,
                            struct column *place, struct arena *arena)
{
    const char *name = column_name(option, arena);
    const struct unit *unit = echo_is_number(option) ? option_unit(option) : NULL;
    *place = (struct column){
        .name = name,
        .unit = unit != NULL && unit->name[0] != '\0' ? unit->name : NULL,
        .dimension = echo_is_number(option) ? option->dimension : NULL,
        .type = echo_type_of(option),
        .offset = echo->sheet.row_size,
        .flags = COLUMN_ADDED | COLUMN_ECHO | (on_request ? COLUMN_EXTRA : COLUMN_BRIEF) |
                 (may_be_infinite(option) ? COLUMN_INFINITE : 0),
        .with = on_request ? NULL : option->name,
        .when = on_request ? arena_printf(arena, "with --%s", option->name) : NULL,
        .label = option->quantity != NULL ? option->quantity : spelt(name, '_', ' ', arena),
        .help = option->help,
    };
    echo->sheet.row_size += VALUE;
    echo->sheet.column_count++;
}

void echo_open(struct echo *echo, const struct echo_question *question, struct arena *arena)
{
    const struct sheet *own = question->sheet;
    const size_t most = 2 * question->command->option_count;
    struct column *columns = arena_buffer_array(arena, most + sheet_forms(own), sizeof *columns);
    *echo = (struct echo){.own = own,
                          .sheet = *own,
                          .items = arena_buffer_array(arena, most + 1, sizeof *echo->items)};
    echo->sheet.column_count = sheet_spread(own, columns + most, arena);
    echo->sheet.row_size = (own->row_size + VALUE - 1) / VALUE * VALUE;
    for (size_t i = 0; i < question->command->option_count; i++) {
        const struct option *option = &question->command->options[i];
        if (question->input != NULL && focal_is_equivalent(option, question->input)) {
            add_equivalent(echo, option, &columns[echo->count], arena);
        }
        const bool varies = question->varied(question->asked, option->name);
        const bool is_wanted = varies && (question->is_for_people || !is_told(own, option));
        if (!question->all && !is_wanted) {
            continue;
        }
        const size_t found = echo_find_column(own, option, column_name(option, arena));
        const bool lacks = found == own->column_count;
        const bool is_known = question->given(question->asked, option->name);
        if ((lacks || (question->all && echo_is_other(&own->columns[found], option))) &&
            is_sayable(option)) {
            struct column *const place = &columns[echo->count];
            echo_add_column(echo, option, !lacks, place, arena);
            echo->items[echo->count++] = (struct echo_item){
                option, place->offset, option->fallback != NULL || is_known, false};
        }
        if (!lacks && varies) {
            /* a column of the command, among those of sheet_spread */
            struct column *spread = columns + most;
            while (spread->name != own->columns[found].name) {
                spread++;
            }
            bring(spread, option);
        }
    }
    /* those that were added lie right before the command's */
    struct column *const first = columns + most - echo->count;
    memmove(first, columns, echo->count * sizeof *columns);
    echo->sheet.columns = first;
    echo->row = arena_array(arena, 1, echo->sheet.row_size);
}

void echo_settle(struct echo *echo, struct report *report)
{
    bool any = false;
    for (size_t i = 0; i < echo->count && !any; i++) {
        any = echo->items[i].is_equivalent || report_shows(report, &echo->sheet.columns[i]);
    }
    if (!any) {
        /* the columns lie where they lay: they need not be chosen again */
        echo->sheet.columns += echo->count;
        echo->sheet.column_count -= echo->count;
        echo->sheet.row_size = echo->own->row_size;
        echo->count = 0;
    }
}

/* Of an equivalent focal length none: what it is for the sensor only the command knows. */
static double echo_number_of(const struct echo_item *item, const void *member)
{
    if (item->option->kind == &kind_focal) {
        return ((const struct focal_value *)member)->length;
    }
    return item->has_value ? item->option->kind->number_of(member) : (double)NAN;
}

static void echo_set_value(char *to, const struct echo_item *item, const void *input,
                           struct arena *arena)
{
    const struct option *option = item->option;
    const void *member = (const char *)input + option->offset;
    const char *words;
    if (item->is_equivalent) {
        *(double *)(void *)to = ((const struct focal_value *)member)->equivalent;
        return;
    }
    switch (echo_type_of(option)) {
    case COLUMN_NUMBER:
        *(double *)(void *)to = echo_number_of(item, member);
        break;
    case COLUMN_INTEGER:
        *(long *)(void *)to = item->has_value ? *(const long *)member : NO_INTEGER;
        break;
    case COLUMN_FLAG:
        *(bool *)to = *(const bool *)member;
        break;
    case COLUMN_TEXT:
        words = item->has_value ? option_value_name(option, member) : NULL;
        if (item->has_value && words == NULL && option->kind->words_of != NULL) {
            words = option->kind->words_of(option, member, arena);
        }
        *(const char **)(void *)to = words;
        break;
    }
}

const void *echo_row(struct echo *echo, const void *row, const void *input, struct arena *arena)
{
    memcpy(echo->row, row, echo->own->row_size);
    for (size_t i = 0; i < echo->count; i++) {
        echo_set_value(echo->row + echo->items[i].offset, &echo->items[i], input, arena);
    }
    return echo->row;
}
