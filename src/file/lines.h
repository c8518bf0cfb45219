/* file/lines.h - spectral lines by name. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LINES_H
#define LENSCALC_FILE_LINES_H

#include "file/lensdb.h"

/*
 * Is it the name of a line, as "d" or "F'"? Case counts: D is not d. The user's lines.tsv comes
 * before the embedded one.
 *
 * Given     found       whether there is such a line
 *           wavelength  receives it, mm, if found
 * Errors    ERROR_DATA, ERROR_IO: the user's table is bad
 */
bool lines_find(struct lensdb *db, struct text name, bool *found, double *wavelength,
                struct error *error);

/* The name of the line of a wavelength (mm, as lines_find gives it); empty if there is none. */
struct text lines_name(struct lensdb *db, double wavelength);

#endif
