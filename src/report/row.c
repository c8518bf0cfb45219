/* report/row.c - the values of a row. */
/* SPDX-License-Identifier: MIT */
#include "report/row.h"

#include "base/number.h"

#include <math.h>

double row_number(const void *row, const struct column *column)
{
    if (column->other != NULL &&
        *(const bool *)((const char *)row + column->turned) != column->is_other) {
        return NAN;
    }
    return *(const double *)((const char *)row + column->offset);
}

long row_integer(const void *row, const struct column *column)
{
    return *(const long *)((const char *)row + column->offset);
}

bool row_flag(const void *row, const struct column *column)
{
    return *(const bool *)((const char *)row + column->offset);
}

const char *row_text(const void *row, const struct column *column)
{
    return *(const char *const *)((const char *)row + column->offset);
}

bool row_is_absent(const void *row, const struct column *column)
{
    switch (column->type) {
    case COLUMN_NUMBER:
        return isnan(row_number(row, column));
    case COLUMN_INTEGER:
        return row_integer(row, column) == NO_INTEGER;
    case COLUMN_TEXT:
        return row_text(row, column) == NULL;
    case COLUMN_FLAG:
        break;
    }
    return false;
}

size_t sheet_forms(const struct sheet *sheet)
{
    size_t forms = sheet->column_count;
    for (size_t i = 0; i < sheet->column_count; i++) {
        forms += sheet->columns[i].other != NULL ? 1 : 0;
    }
    return forms;
}

size_t sheet_spread(const struct sheet *sheet, struct column *columns, struct arena *arena)
{
    size_t count = 0, first = 0; /* of those whose other form is still to come */
    for (size_t i = 0; i < sheet->column_count; i++) {
        const struct column *here = &sheet->columns[i];
        columns[count++] = *here;
        if (here->other == NULL) {
            continue;
        }
        size_t next = i + 1;
        while (next < sheet->column_count && sheet->columns[next].other == NULL) {
            next++;
        }
        if (next < sheet->column_count && sheet->columns[next].other == here->other) {
            continue;
        }
        for (; first <= i; first++) {
            if (sheet->columns[first].other != NULL) {
                /* The other form of a column. */
                struct column other = sheet->columns[first];
                other.is_other = true;
                other.dimension = sheet->columns[first].other->dimension;
                other.unit = sheet->columns[first].other->unit;
                other.flags |= COLUMN_SPARSE;
                other.help = ARENA_JOIN(arena, sheet->columns[first].help, "; ",
                                        sheet->columns[first].other->help);
                columns[count++] = other;
            }
        }
    }
    return count;
}

void row_clear(const struct sheet *sheet, void *row)
{
    for (size_t i = 0; i < sheet->column_count; i++) {
        const struct column *column = &sheet->columns[i];
        void *at = (char *)row + column->offset;
        if (column->other != NULL) {
            *(bool *)((char *)row + column->turned) = false;
        }
        switch (column->type) {
        case COLUMN_NUMBER:
            *(double *)at = NAN;
            break;
        case COLUMN_INTEGER:
            *(long *)at = NO_INTEGER;
            break;
        case COLUMN_TEXT:
            *(const char **)at = NULL;
            break;
        case COLUMN_FLAG:
            *(bool *)at = false;
            break;
        }
    }
}

char *shown_write_number(char *to, const void *row, const struct shown *shown, int digits)
{
    double value = row_number(row, shown->column);
    if (isnan(value)) {
        return to;
    }
    if (digits == 0) {
        return quantity_write(to, value, shown->unit);
    }
    if (shown->divisor > 1) {
        value /= shown->divisor;
    } else if (shown->divisor == 0) {
        value = unit_from_own(shown->unit, value);
    }
    return number_write_digits(to, value, digits);
}

struct text column_repeated(const struct column *column)
{
    if (column->repeats != NULL) {
        return text_of(column->repeats);
    }
    const struct text none = {"", 0};
    bool echo = (column->flags & COLUMN_ECHO) != 0;
    struct text depends = text_of(column->depends != NULL ? column->depends : "");
    struct text first = text_cut(&depends, ' ');
    if (echo && column->with != NULL) {
        return text_of(column->with);
    }
    return echo || text_equal(first, column->name) ? first : none;
}
