/* base/quantity.h - a quantity as people write it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_QUANTITY_H
#define LENSCALC_BASE_QUANTITY_H

#include "base/error.h"
#include "base/units.h"

#include <stdbool.h>

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
