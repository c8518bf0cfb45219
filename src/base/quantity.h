/* base/quantity.h - dimensions, units, and the reading of a quantity as people write it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_QUANTITY_H
#define LENSCALC_BASE_QUANTITY_H

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* One unit. The value in the program's own unit is typed x multiplier x 10^power x factor. */
struct unit {
    const char *name;  /* typed, and the end of a column's name: "mm" */
    const char *label; /* in the head of a table: "mm", "1/m" */
    struct number_scale scale;
    double factor;         /* what of the conversion is no decimal: pi/180; else 1 */
    const char *spellings; /* other ways to type it, separated by blanks; null = none */
    const char *help;
};

/* What a quantity measures, and how it may be written. The first unit is the program's own. */
struct dimension {
    const char *name;
    const struct unit *units;
    size_t unit_count;
    const char *prefixes; /* that may stand before the number ("f/ f T"), case ignored; or null */
    bool fraction;        /* 1/125 */
    bool ratio;           /* 1:2 */
    const char *series;   /* the stop series its labels come from, a file of lensdb; or null */
};

extern const struct dimension dimension_number, dimension_length, dimension_angle, dimension_time,
    dimension_fnumber, dimension_ratio, dimension_vergence, dimension_iso, dimension_ev,
    dimension_stops, dimension_luminance, dimension_illuminance, dimension_exposure,
    dimension_speed, dimension_rotation, dimension_frequency, dimension_rate;

/* All dimensions, for lists and for naming the right one in a message; ends with null. */
extern const struct dimension *const dimensions[];

/* The unit of that dimension with this name or spelling; null if there is none. */
const struct unit *unit_find(const struct dimension *dimension, struct text name);

/* Is it the program's own unit of its dimension? */
bool unit_is_own(const struct unit *unit);

/* Convert between a unit and the program's own (mm, rad, s, 1/mm). One rounding for decimal units.
 */
double unit_to_own(const struct unit *unit, double value);
double unit_from_own(const struct unit *unit, double value);

/*
 * Read a quantity: a number with or without a unit, in any notation of its dimension
 * ("50mm" "5ft6in" "5'6\"" "f/2.8" "1/125s" "180deg@24fps" "1:2" "0.5x" "inf").
 *
 * Given     text       the whole quantity; blanks around it are passed over
 *           dimension  what it must measure
 *           unit       what a bare number means; null for the program's own
 *           value      receives the value in the program's own unit, never NaN; -0 becomes 0
 *           typed      if not null receives the unit that was typed, null for a bare number
 * Result    false with ERROR_USAGE and a caret: no number, an unknown unit, a unit of another
 *           dimension, a decimal comma, a number too large or too small for a double
 */
bool quantity_read(struct text text, const struct dimension *dimension, const struct unit *unit,
                   double *value, const struct unit **typed, struct error *error);

/*
 * Write a value of the program's own unit in `unit`, with the fewest digits that quantity_read
 * turns back into the same double where 15 suffice (so that what was typed is printed as it was
 * typed), else with the shortest text of the converted double.
 *
 * Given     to     room for NUMBER_LENGTH characters; returns the end of what was written
 */
char *quantity_write(char *to, double value, const struct unit *unit);

#endif
