/* file/lens_unit.h - the units in which the lengths of a lens may be typed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_UNIT_H
#define LENSCALC_FILE_LENS_UNIT_H

#include "base/number.h"
#include "base/text.h"

enum { LENS_UNITS = 4 };

/* Their names, of the lengths in base/units, which has their factors; mm is that of a file that
 * names none. Ends with null. */
extern const struct word lens_units[LENS_UNITS + 1];

/* The unit of this name, as lens.unit has it; null: lenses are not typed in it. */
const char *lens_unit_named(struct text name);

/* A number of this unit in mm: exact, and as a double. `unit` is one of the names. */
struct number_scale lens_unit_scale(const char *unit);
double lens_unit_mm(const char *unit);

#endif
