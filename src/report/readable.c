/* report/readable.c - numbers and units as people read them. */
/* SPDX-License-Identifier: MIT */
#include "report/readable.h"

#include "base/number.h"
#include "report/spoken.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TYPED_DIGITS = 9 };

/* Hoare's selection: only the part that holds the middle is sorted on. */
double readable_median(double *values, size_t count)
{
    const ptrdiff_t middle = (ptrdiff_t)(count / 2);
    ptrdiff_t low = 0, high = (ptrdiff_t)count - 1;
    while (low < high) {
        const double pivot = values[middle];
        ptrdiff_t i = low, j = high;
        while (i <= j) {
            while (values[i] < pivot) {
                i++;
            }
            while (values[j] > pivot) {
                j--;
            }
            if (i <= j) {
                const double other = values[i];
                values[i++] = values[j];
                values[j--] = other;
            }
        }
        low = j < middle ? i : low;
        high = i > middle ? j : high;
    }
    return count > 0 ? values[middle] : (double)NAN;
}

static const struct unit *length_unit(const char *name)
{
    return unit_find(&dimension_length, text_of(name));
}

/* Metres down to millimetres and up to kilometres; millimetres down to nanometres. */
static const struct unit *metric_length(const struct unit *usual, double typical)
{
    bool metres = strcmp(usual->name, "m") == 0;
    double smallest = metres ? 500 : 1e-3;
    double largest = metres ? 1e7 : 1e5;
    if (!(typical > 0) || isinf(typical) || (typical >= smallest && typical < largest)) {
        return usual;
    }
    static const struct {
        double below; /* mm */
        const char *unit;
    } ladder[] = {{1e-3, "nm"}, {1, "um"}, {1e4, "mm"}, {1e7, "m"}, {INFINITY, "km"}};
    size_t i = 0;
    while (typical >= ladder[i].below) {
        i++;
    }
    return length_unit(ladder[i].unit);
}

const struct unit *readable_unit(const struct shown *shown, enum unit_system system, double typical)
{
    /* Is it a unit that the user named with the column? Then it is kept. */
    if (shown->unit == NULL ||
        (shown->column->unit != NULL && strcmp(shown->unit->name, shown->column->unit) != 0)) {
        return shown->unit;
    }
    if (shown->column->dimension == &dimension_time) {
        return NULL; /* each value says its own */
    }
    if (shown->column->dimension != &dimension_length) {
        return shown->unit;
    }
    if (system == UNITS_IMPERIAL && strcmp(shown->unit->name, "m") == 0) {
        /* feet stand for feet and inches, or inches alone where all is short */
        const double size = fabs(typical);
        const char *far = size < 1e7 || isinf(size) || isnan(size) ? "ft" : "mi";
        return length_unit(size < unit_to_own(length_unit("ft"), 1) ? "in" : far);
    }
    return metric_length(shown->unit, fabs(typical));
}

/* Feet of a column in metres stand for feet and inches. */
static bool is_feet_and_inches(const struct shown *shown, const struct unit *unit)
{
    return unit != NULL && strcmp(unit->name, "ft") == 0 && strcmp(shown->unit->name, "m") == 0;
}

static bool is_spoken_time(const struct shown *shown, const struct unit *unit)
{
    return unit == NULL && shown->column->dimension == &dimension_time;
}

const char *readable_unit_label(const struct shown *shown, const struct unit *unit)
{
    if (is_feet_and_inches(shown, unit)) {
        return "ft in";
    }
    if (unit != NULL) {
        return unit->label;
    }
    return "";
}

int readable_inch_places(const struct shown *shown, const struct unit *unit, double typical,
                         int digits)
{
    bool any = is_feet_and_inches(shown, unit) && isfinite(typical);
    int places = any ? spoken_inch_places(typical, digits) : -1;
    if (places > 0) {
        return places;
    }
    if (any && places >= -1) {
        return 0;
    }
    return -1;
}

/* The digits that are certain: a relative error of condition x 2^-52 is always possible. */
static int certain_digits(const void *row, const struct column *column, int digits)
{
    if (column->condition == 0) {
        return digits;
    }
    double condition = *(const double *)((const char *)row + column->condition);
    double certain = -log10(condition * 0x1p-52);
    if (!(certain >= 1)) {
        return 0;
    }
    if (certain < digits) {
        return (int)floor(certain);
    }
    return digits;
}

/* Does a number of at most nine digits stand for it, as for most that people type? */
static bool is_short(double value)
{
    char digits[NUMBER_LENGTH];
    double again = 0;
    const char *end = number_write_digits(digits, value, TYPED_DIGITS);
    number_read(digits, end, NUMBER_UNSCALED, &again);
    return fabs(again - value) <= 1e-13 * fabs(value);
}

/* As much of a text as there is room for. */
static void readable_copy(char *to, size_t room, const char *text)
{
    size_t length = strlen(text);
    length = length < room ? length : room - 1;
    memcpy(to, text, length);
    to[length] = '\0';
}

static void readable_write_number(char *to, size_t room, const void *row, const struct shown *shown,
                                  const struct unit *unit, int digits)
{
    double value = row_number(row, shown->column);
    if (isinf(value)) {
        readable_copy(to, room, value > 0 ? "inf" : "-inf");
        return;
    }
    int certain = certain_digits(row, shown->column, digits);
    size_t used = 0;
    if (certain < 1) {
        certain = 1;
        to[used++] = '~';
    }
    /* in several units or as a fraction, where people write such values so */
    to += used;
    if (is_feet_and_inches(shown, unit)) {
        spoken_feet(to, value, certain, shown->inch_places - 1);
        return;
    }
    if (is_spoken_time(shown, unit)) {
        bool passes = (shown->column->flags & COLUMN_SPAN) != 0;
        if (passes) {
            spoken_span(to, value, certain);
        } else {
            spoken_time(to, value, certain);
        }
        return;
    }
    if ((shown->column->flags & COLUMN_PART) != 0) {
        spoken_part(to, value, certain);
        return;
    }
    double converted = unit != NULL ? unit_from_own(unit, value) : value;
    bool typed = (shown->column->flags & COLUMN_ECHO) != 0 && is_short(converted);
    /* Significant digits, without exponent where people would not write one; no -0. */
    *number_write_plain(to, converted + 0.0,
                        typed && certain < TYPED_DIGITS ? TYPED_DIGITS : certain, !typed) = '\0';
}

void readable_value(char *to, size_t room, const void *row, const struct shown *shown,
                    const struct unit *unit, int digits)
{
    to[0] = '\0';
    if (row_is_absent(row, shown->column)) {
        return;
    }
    switch (shown->column->type) {
    case COLUMN_NUMBER:
        readable_write_number(to, room, row, shown, unit, digits);
        break;
    case COLUMN_INTEGER:
        snprintf(to, room, "%ld", row_integer(row, shown->column));
        break;
    case COLUMN_FLAG:
        readable_copy(to, room, row_flag(row, shown->column) ? "yes" : "no");
        break;
    case COLUMN_TEXT:
        readable_copy(to, room, row_text(row, shown->column));
        if (is_spoken_time(shown, unit)) {
            readable_copy(to + strlen(to), room - strlen(to),
                          " s"); /* a label of a camera: 1/125, 15 */
        }
        break;
    }
}

const char *readable_words(struct arena *arena, const void *row, const struct shown *shown,
                           const struct unit *unit, int digits)
{
    enum { LONGEST = 256 }; /* of what is no text */
    char value[LONGEST];
    const bool is_text = shown->column->type == COLUMN_TEXT && !is_spoken_time(shown, unit);
    if (is_text && !row_is_absent(row, shown->column)) {
        return row_text(row, shown->column);
    }
    readable_value(value, sizeof value, row, shown, unit, digits);
    return arena_string(arena, value, strlen(value));
}
