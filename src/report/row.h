/* report/row.h - the values of a row. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_ROW_H
#define LENSCALC_REPORT_ROW_H

#include "base/arena.h"
#include "base/text.h"
#include "report/table.h"

#include <stdbool.h>

/* A column as it is printed: in this unit, under this name. */
struct shown {
    const struct column *column;
    const struct unit *unit; /* null = none */
    const char *name;        /* "near_m" */
    double divisor;          /* own units in this one: near_m is near / 1000; 0 = not one number */
    int inch_places;         /* decimals of inches in feet and inches, plus 1; 0 = as digits say */
};

/* In words, for people; null label: its name. */
static inline const char *column_label(const struct column *column)
{
    return column->label != NULL ? column->label : column->name;
}

/* The option whose value a column has; empty: it repeats none. */
struct text column_repeated(const struct column *column);

/* The values of a row. Numbers in the program's own unit. */
double row_number(const void *row, const struct column *column);
long row_integer(const void *row, const struct column *column);
bool row_flag(const void *row, const struct column *column);
const char *row_text(const void *row, const struct column *column);

/* How many forms the columns of a sheet have. */
size_t sheet_forms(const struct sheet *sheet);

/*
 * The columns of a sheet with both forms of those that have another one: behind the last of
 * neighbours that share it, theirs.
 *
 * Given     columns  room for sheet_forms
 * Result    how many they are
 */
size_t sheet_spread(const struct sheet *sheet, struct column *columns, struct arena *arena);

/* Is there no value? */
bool row_is_absent(const void *row, const struct column *column);

/* Make all values of a row absent, flags false; members without a column stay as they are. */
void row_clear(const struct sheet *sheet, void *row);

/*
 * Write a number of a row for machines: `digits` significant digits (0 = shortest that reads
 * back), `inf`; nothing for NaN. Room for NUMBER_LENGTH; returns the end.
 */
char *shown_write_number(char *to, const void *row, const struct shown *shown, int digits);

#endif
