/* report/readable.h - numbers and units as people read them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_READABLE_H
#define LENSCALC_REPORT_READABLE_H

#include "report/report.h"

/* The upper one of the middle values, which are sorted for it; NaN if there are none. */
double readable_median(double *values, size_t count);

/*
 * The unit in which a person would read these values of one column.
 *
 * Given     system   metric or imperial (only columns printed in metres become feet)
 *           shown    the column and the unit of machine output
 *           typical  a typical magnitude in the program's own unit; inf or NaN: no opinion
 * Result    the unit, one that the user named with --columns as it is; null for a plain number,
 *           and for times, whose values say their own
 */
const struct unit *readable_unit(const struct shown *shown, enum unit_system system,
                                 double typical);

/* What stands behind the values or in the head: "m", "ft in", "" where there is nothing to say. */
const char *readable_unit_label(const struct shown *shown, const struct unit *unit);

/*
 * The decimals of inches that suit a column of feet and inches, so that all its cells can have one
 * form.
 *
 * Given     as readable_unit; digits  significant digits
 * Result    below 0: no opinion
 */
int readable_inch_places(const struct shown *shown, const struct unit *unit, double typical,
                         int digits);

/*
 * Write the value of a column in words for people: `digits` significant digits, no exponent in
 * the usual range, no more digits than the value's condition allows ("~" before a value of which
 * not even one digit is certain), "inf" for infinity, "" if absent; feet and inches as 9' 4.3",
 * times as 1/125 s and 2 min 30 s.
 *
 * Given     to, room  receives a string with NUL; 80 characters suffice for numbers
 *           unit      as readable_unit gave it
 */
void readable_value(char *to, size_t room, const void *row, const struct shown *shown,
                    const struct unit *unit, int digits);

/* The same, however long a text is; it is the row's own or lies in the arena. */
const char *readable_words(struct arena *arena, const void *row, const struct shown *shown,
                           const struct unit *unit, int digits);

#endif
