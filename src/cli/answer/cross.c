/* cli/answer/cross.c - cross-tables of two swept options. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/collect.h"
#include "cli/answer/columns.h"
#include "report/grid.h"
#include "report/readable.h"
#include "report/row.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What "--table ROW,COL:VALUE" asks for. */
struct cross {
    const struct axis *down, *across;
    struct shown *values;
    size_t value_count;
    const struct unit **units; /* for people, one a value */
};

static bool is_machine(const struct report *report)
{
    return !report->format->is_for_people;
}

/* The swept option of this letter, name or column. */
static bool read_axis(const struct collection *collection, struct text name,
                      const struct axis **axis, struct error *error)
{
    for (size_t i = 0; i < collection->sweep->axis_count; i++) {
        *axis = &collection->sweep->axes[i];
        const struct option *option = (*axis)->option;
        if ((name.length == 1 && name.start[0] == option->letter) ||
            text_same_name(name, text_of(option->name)) ||
            (option->column != NULL && text_same_name(name, text_of(option->column)))) {
            return true;
        }
    }
    return fail(error, ERROR_USAGE, "--table: '%.*s' is not an option with several values here",
                text_shown_up_to(name, 40), name.start);
}

static bool read_specification(const struct collection *collection, const char *specification,
                               const struct report *report, struct cross *cross,
                               struct error *error)
{
    struct text values = text_of(specification);
    struct text axes = text_cut(&values, ':');
    struct text down = text_cut(&axes, ',');
    const char *typed_names = values.start != NULL ? values.start : collection->command->cell;
    const char *names = columns_from_options(collection->command, collection->sheet, typed_names,
                                             "+", collection->arena);
    if (axes.start == NULL || typed_names == NULL) {
        return fail(error, ERROR_USAGE, "--table '%s' is not of the form ROW,COL%s", specification,
                    typed_names == NULL ? ":VALUE" : "[:VALUE]");
    }
    if (!read_axis(collection, text_trim(down), &cross->down, error) ||
        !read_axis(collection, text_trim(axes), &cross->across, error)) {
        return false;
    }
    if (cross->down == cross->across || collection->sweep->axis_count != 2) {
        return fail(error, ERROR_USAGE,
                    "--table needs exactly two options with several values, there are %zu",
                    collection->sweep->axis_count);
    }
    bool people = !is_machine(report), typed = values.start != NULL;
    if (!collection_columns(collection, names, '+', people && !typed, &cross->values,
                            &cross->value_count, error)) {
        return error_prefix(error, "--table: ");
    }
    return !people ||
           collection_check_units(cross->values, cross->value_count, "--table", false, error);
}

/* Programs find a column by its name: values that are written alike would give one name twice. */
static bool check_heads(const struct collection *collection, const struct axis *across,
                        struct error *error)
{
    const char **values = ARENA_ARRAY(collection->arena, across->count, const char *);
    for (size_t j = 0; j < across->count; j++) {
        values[j] = axis_machine_value(collection, across, j);
    }
    qsort(values, across->count, sizeof *values, text_order);
    for (size_t j = 1; j < across->count; j++) {
        if (strcmp(values[j - 1], values[j]) == 0) {
            return fail(error, ERROR_USAGE,
                        "--table: --%s has the value %s twice: two columns "
                        "would have one name",
                        across->option->name, values[j]);
        }
    }
    return true;
}

bool cross_table_check(const struct collection *collection, const char *specification,
                       const char *columns, const struct report *report, struct error *error)
{
    struct cross cross;
    if (columns != NULL) {
        return fail(error, ERROR_USAGE,
                    "--columns does nothing beside --table: what its cells show stands behind a "
                    "colon there, ROW,COL:VALUE");
    }
    const char *able = "";
    for (size_t i = 0; formats[i] != NULL; i++) {
        if (formats[i]->write_grid != NULL) {
            able = arena_printf(report->arena, "%s%s%s", able, able[0] != '\0' ? ", " : "",
                                formats[i]->word.word);
        }
    }
    if (report->format->write_grid == NULL) {
        return fail(error, ERROR_USAGE, "--table is for %s", able);
    }
    return read_specification(collection, specification, report, &cross, error) &&
           (!is_machine(report) || check_heads(collection, cross.across, error));
}

/* The row at a place of the table; null if it failed. */
static const void *row_at(const struct collection *collection, const struct cross *cross, size_t i,
                          size_t j)
{
    bool down_is_slow = cross->down == &collection->sweep->axes[0];
    size_t index = down_is_slow ? i * cross->across->count + j : j * cross->down->count + i;
    return collection_row(collection, index);
}

static int cross_digits_of(const struct report *report, const struct column *column)
{
    const int own = column->digits != 0 ? column->digits : 4;
    return report->digits != 0 ? report->digits : own;
}

/* One unit for the whole table, and one form of feet and inches: values that share a cell share
   both. */
static void cross_choose_units(const struct collection *collection, const struct report *report,
                               const struct cross *cross)
{
    const struct shown *first = &cross->values[0];
    /* the median magnitude of a column over the whole table */
    size_t total = collection->sweep->total, count = 0;
    double *values = ARENA_ARRAY(collection->arena, total, double);
    for (size_t i = 0; i < total; i++) {
        const void *row = collection_row(collection, i);
        if (row != NULL && first->column->type == COLUMN_NUMBER) {
            double value = fabs(row_number(row, first->column));
            if (isfinite(value)) {
                values[count++] = value;
            }
        }
    }
    double size = readable_median(values, count);
    const struct unit *unit = readable_unit(first, collection->units, size);
    int places = readable_inch_places(first, unit, size, cross_digits_of(report, first->column));
    for (size_t k = 0; k < cross->value_count; k++) {
        cross->units[k] = unit;
        cross->values[k].inch_places = places + 1;
    }
}

/* A value as the csv of rows has it; "" where there is none. */
static const char *machine_value(const struct collection *collection, const void *row,
                                 const struct shown *shown, int digits)
{
    if (row == NULL || row_is_absent(row, shown->column)) {
        return "";
    }
    char number[NUMBER_LENGTH + 1];
    switch (shown->column->type) {
    case COLUMN_NUMBER:
        *shown_write_number(number, row, shown, digits) = '\0';
        return arena_string(collection->arena, number, strlen(number));
    case COLUMN_INTEGER:
        return arena_printf(collection->arena, "%ld", row_integer(row, shown->column));
    case COLUMN_FLAG:
        return row_flag(row, shown->column) ? "true" : "false";
    case COLUMN_TEXT:
        break;
    }
    return row_text(row, shown->column);
}

/*
 * "distance (m)", or for machines "distance_m": the output column that repeats the axis, in the
 * unit of its values.
 */
static const char *axis_head(const struct collection *collection, const struct axis *axis,
                             bool is_for_machines)
{
    const struct option *option = axis->option;
    const char *column = option->column != NULL ? option->column : option->name;
    const char *name = is_for_machines ? column : axis_label(collection, axis);
    /* times say their own, as prints do */
    const bool has_unit = axis->unit != NULL && axis->unit->name[0] != '\0' &&
                          option->kind != &kind_print &&
                          (is_for_machines || option->dimension != &dimension_time);
    if (!has_unit) {
        return name;
    }
    return is_for_machines ? arena_printf(collection->arena, "%s_%s", name, axis->unit->name)
                           : arena_printf(collection->arena, "%s (%s)", name, axis->unit->label);
}

static void cross_write_head(const struct collection *collection, const struct cross *cross,
                             const struct report *report, struct grid *grid)
{
    grid_add_row(grid);
    grid_set(grid, 0, axis_head(collection, cross->down, is_machine(report)));
    for (size_t j = 0; j < cross->across->count; j++) {
        const char *value = axis_value(collection, cross->across, j, true);
        if (!is_machine(report)) {
            grid_set(grid, 1 + j, value);
            continue;
        }
        for (size_t k = 0; k < cross->value_count; k++) {
            grid_set(grid, 1 + j * cross->value_count + k,
                     arena_printf(collection->arena, "%s_%s_%s", cross->values[k].name,
                                  axis_head(collection, cross->across, true),
                                  axis_machine_value(collection, cross->across, j)));
        }
    }
}

static struct grid cross_build(const struct collection *collection, const struct cross *cross,
                               const struct report *report)
{
    size_t cells = cross->across->count * (is_machine(report) ? cross->value_count : 1);
    struct grid grid = grid_new(collection->arena, 1 + cells, 1);
    cross_write_head(collection, cross, report, &grid);
    for (size_t i = 0; i < cross->down->count; i++) {
        grid_add_row(&grid);
        grid_set(&grid, 0,
                 is_machine(report) ? axis_machine_value(collection, cross->down, i)
                                    : axis_value(collection, cross->down, i, false));
        for (size_t j = 0; j < cross->across->count; j++) {
            const void *row = row_at(collection, cross, i, j);
            const char *words = "";
            for (size_t k = 0; k < cross->value_count; k++) {
                const char *value = "-";
                const struct shown *shown = &cross->values[k];
                if (is_machine(report)) {
                    grid_set(&grid, 1 + j * cross->value_count + k,
                             machine_value(collection, row, shown, report->digits));
                    continue;
                }
                if (row != NULL && !row_is_absent(row, shown->column)) {
                    value = readable_words(collection->arena, row, shown, cross->units[k],
                                           cross_digits_of(report, shown->column));
                }
                words = arena_printf(collection->arena, "%s%s%s", words, k > 0 ? " - " : "", value);
            }
            if (!is_machine(report)) {
                grid_set(&grid, 1 + j, words);
            }
        }
    }
    return grid;
}

/* One table in any format; formulas that are asked for come behind it. */
static void write_grid(struct report *report, const struct grid *grid)
{
    if (report->format == &format_html) {
        grid_html_begin(report->output, grid->title);
        report->format->write_grid(grid, report->output, true);
        grid_html_close(grid, report->output);
        if (report->explain != NULL) {
            grid_html_paragraph(report->output, report->explain);
        }
        grid_html_end(report->output);
        return;
    }
    report->format->write_grid(grid, report->output, !report->is_headless);
    if (report->format == &format_latex) {
        grid_latex_close(grid, grid->rows - grid->head_rows, report->output);
        if (report->explain != NULL) {
            grid_latex_paragraph(report->arena, report->output, report->explain);
        }
        return;
    }
    if (report->explain != NULL && !is_machine(report)) {
        output_printf(report->output, "\n%s\n", report->explain);
    }
}

static void cross_doubt(const struct collection *collection, const struct cross *cross,
                        const struct report *report)
{
    /* values that no cell has are said to be absent, not shown as nothing */
    for (size_t k = 0; k < cross->value_count; k++) {
        const struct column *column = cross->values[k].column;
        bool any_row = false, any = false;
        for (size_t i = 0; i < cross->down->count; i++) {
            for (size_t j = 0; j < cross->across->count; j++) {
                const void *row = row_at(collection, cross, i, j);
                any_row = any_row || row != NULL;
                any = any || (row != NULL && !row_is_absent(row, column));
            }
        }
        if (any_row && !any) {
            warnings_add(report->doubts, "%s has no value here: %s", cross->values[k].name,
                         report_absence(report, column));
        }
    }
    /* what is doubtful about a lens stands in a column of its rows, which a table has not */
    for (size_t k = 0; k < report->sheet->column_count; k++) {
        const struct column *column = &report->sheet->columns[k];
        if ((column->flags & COLUMN_NOTE) == 0 || !text_equal(text_of(column->name), "warning")) {
            continue;
        }
        for (size_t i = 0; i < cross->down->count; i++) {
            for (size_t j = 0; j < cross->across->count; j++) {
                const void *row = row_at(collection, cross, i, j);
                const char *warning = row != NULL ? row_text(row, column) : NULL;
                if (warning != NULL) {
                    warnings_add(report->doubts, "%s", warning);
                }
            }
        }
    }
}

bool cross_table_write(const struct collection *collection, const char *specification,
                       struct report *report, struct error *error)
{
    struct cross cross = {0};
    if (collection->is_ambiguous) {
        return fail(error, ERROR_USAGE,
                    "--table needs one row per combination, but this question has several");
    }
    if (!read_specification(collection, specification, report, &cross, error)) {
        return false;
    }
    cross.units = ARENA_ARRAY(collection->arena, cross.value_count, const struct unit *);
    for (size_t k = 0; k < cross.value_count; k++) {
        struct shown *shown = &cross.values[k];
        /* in metres, so that readable_unit may choose feet and inches or millimetres */
        if (!is_machine(report) && shown->column->unit != NULL && shown->unit != NULL &&
            collection->units == UNITS_IMPERIAL && strcmp(shown->unit->name, "ft") == 0) {
            shown->unit = unit_find(shown->column->dimension, text_of(shown->column->unit));
        }
    }
    cross_choose_units(collection, report, &cross);
    cross_doubt(collection, &cross, report);
    struct grid grid = cross_build(collection, &cross, report);
    if (!is_machine(report)) {
        const void *row = collection_first_row(collection);
        /* "near limit - far limit (m)" */
        const char *words = "";
        for (size_t k = 0; k < cross.value_count; k++) {
            const struct shown *shown = &cross.values[k];
            words = arena_printf(collection->arena, "%s%s%s", words, k > 0 ? " - " : "",
                                 column_label(shown->column));
        }
        const char *unit = readable_unit_label(&cross.values[0], cross.units[0]);
        grid.title = arena_printf(
            collection->arena, "%s by %s and %s",
            unit[0] == '\0' ? words : arena_printf(collection->arena, "%s (%s)", words, unit),
            axis_label(collection, cross.down), axis_label(collection, cross.across));
        grid.in_blocks = true;
        grid.note = row != NULL ? report_assumptions(report, row) : NULL;
    }
    write_grid(report, &grid);
    return true;
}
