/* cli/answer/collect.c - all rows of a sweep kept, for cross-tables and plots. */
/* SPDX-License-Identifier: MIT */
#include "cli/answer/collect.h"

#include "report/spoken.h"

#include <math.h>
#include <string.h>

bool collection_open(struct collection *collection, size_t most, const char *option,
                     struct error *error)
{
    if (collection->sweep->total > most) {
        return fail(error, ERROR_USAGE, "--%s takes at most %zu rows, the sweep has %zu", option,
                    most, collection->sweep->total);
    }
    collection->rows =
        arena_array(collection->arena, collection->sweep->total, collection->sheet->row_size);
    collection->is_there = ARENA_ARRAY(collection->arena, collection->sweep->total, bool);
    return true;
}

void collection_keep(struct collection *collection, size_t index, const void *row)
{
    collection->is_ambiguous = collection->is_ambiguous || collection->is_there[index];
    if (!collection->is_there[index]) {
        memcpy(collection->rows + index * collection->sheet->row_size, row,
               collection->sheet->row_size);
        collection->is_there[index] = true;
    }
}

const void *collection_row(const struct collection *collection, size_t index)
{
    return collection->is_there[index] ? collection->rows + index * collection->sheet->row_size
                                       : NULL;
}

const void *collection_first_row(const struct collection *collection)
{
    for (size_t i = 0; i < collection->sweep->total; i++) {
        if (collection->is_there[i]) {
            return collection_row(collection, i);
        }
    }
    return NULL;
}

const char *axis_label(const struct collection *collection, const struct axis *axis)
{
    for (size_t i = 0; i < collection->sheet->column_count; i++) {
        const struct column *column = &collection->sheet->columns[i];
        if (axis->option->column != NULL && strcmp(column->name, axis->option->column) == 0) {
            return column_label(column);
        }
    }
    return axis->option->name;
}

const char *axis_value(const struct collection *collection, const struct axis *axis, size_t i,
                       bool with_unit)
{
    const struct option *option = axis->option;
    const char *member = axis->values + i * option->kind->size;
    const char *name = option_value_name(option, member);
    if (name != NULL) {
        return name;
    }
    if (option->kind == &kind_count) {
        return arena_printf(collection->arena, "%ld", *(const long *)(const void *)member);
    }
    if (option->kind == &kind_coc) {
        return arena_printf(collection->arena, "%.6g%s",
                            ((const struct coc_value *)(const void *)member)->coc.value,
                            with_unit ? " mm" : "");
    }
    double own = axis_number(axis, i);
    double value = axis->unit != NULL ? unit_from_own(axis->unit, own) : own;
    /* a number as people write it: f/2.8, 1/125 s, 3 m */
    const struct dimension *dimension = axis->option->dimension;
    if (with_unit && dimension == &dimension_fnumber) {
        return arena_printf(collection->arena, "f/%.4g", value);
    }
    if (dimension == &dimension_time && isfinite(value)) {
        char words[SPOKEN_LENGTH];
        spoken_time(words, axis->unit != NULL ? unit_to_own(axis->unit, value) : value, 6);
        return arena_string(collection->arena, words, strlen(words));
    }
    bool unit = with_unit && axis->unit != NULL && axis->unit->label[0] != '\0';
    return arena_printf(collection->arena, "%.6g%s%s", value, unit ? " " : "",
                        unit ? axis->unit->label : "");
}

bool collection_columns(const struct collection *collection, const char *names, char separator,
                        bool convert, struct shown **shown, size_t *count, struct error *error)
{
    struct text rest = text_of(names);
    size_t most = rest.length + 1;
    *shown = ARENA_ARRAY(collection->arena, most, struct shown);
    *count = 0;
    while (rest.start != NULL) {
        struct text name = text_trim(text_cut(&rest, separator));
        struct shown found;
        if (!report_find_column(collection->sheet, name, collection->arena, &found, error)) {
            if (text_equal(name, "error")) {
                continue;
            }
            return false;
        }
        for (size_t k = 0; k < *count; k++) {
            if (strcmp((*shown)[k].name, found.name) == 0) {
                return fail(error, ERROR_USAGE, "column %s is named twice", found.name);
            }
        }
        if (convert && collection->units == UNITS_IMPERIAL && found.unit != NULL &&
            found.column->dimension == &dimension_length && strcmp(found.unit->name, "m") == 0) {
            found.unit = unit_find(&dimension_length, text_of("ft"));
            found.name = arena_printf(collection->arena, "%s_ft", found.column->name);
            found.divisor = 0;
        }
        (*shown)[(*count)++] = found;
    }
    return *count > 0 || fail(error, ERROR_USAGE, "no column is named");
}

bool collection_check_units(const struct shown *shown, size_t count, const char *option,
                            bool numbers, struct error *error)
{
    for (size_t k = 0; k < count; k++) {
        if (numbers && shown[k].column->type != COLUMN_NUMBER &&
            shown[k].column->type != COLUMN_INTEGER) {
            return fail(error, ERROR_USAGE, "%s: column %s is not a number", option, shown[k].name);
        }
        if (shown[k].unit != shown[0].unit) {
            return fail(error, ERROR_USAGE, "%s: columns %s and %s have different units", option,
                        shown[0].name, shown[k].name);
        }
    }
    return true;
}

const char *axis_machine_value(const struct collection *collection, const struct axis *axis,
                               size_t i)
{
    char number[NUMBER_LENGTH + 1];
    if (axis->option->kind->set_number == NULL || axis->option->kind->number_of == NULL) {
        return axis_value(collection, axis, i, false);
    }
    *quantity_write(number, axis_number(axis, i), axis->unit) = '\0';
    return arena_string(collection->arena, number, strlen(number));
}
