/* data/lines.h - spectral lines by name. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_LINES_H
#define LENSCALC_DATA_LINES_H

#include "base/number.h"
#include "data/lensdb.h"

/*
 * Is it the name of a line, as "d" or "F'"? Case counts: D is not d. The user's lines.tsv comes
 * before the embedded one.
 *
 * Given     from_nm     from nm to the unit that is wanted: {1, -6} for mm, {1, -3} for um
 *           found       whether there is such a line
 *           wavelength  receives it, rounded once, if found
 * Errors    ERROR_DATA, ERROR_IO: the user's table is bad
 */
bool lines_find(struct lensdb *db, struct text name, struct number_scale from_nm, bool *found,
                double *wavelength, struct error *error);

/* The line of this name, um, in the embedded table alone: what the name means in a lens file,
 * whatever tables its reader has. False if there is none. */
bool lines_standard(struct text name, double *wavelength);

/* The name of the line of a wavelength (mm, as lines_find gives it); empty if there is none. */
struct text lines_name(struct lensdb *db, double wavelength);

#endif
