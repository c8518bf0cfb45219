/* file/lens_grade.h - the tolerances of a grade, laid upon a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_GRADE_H
#define LENSCALC_FILE_LENS_GRADE_H

#include "data/lensdb.h"
#include "optics/lens.h"
#include "optics/tolerance.h"

/*
 * A grade of tolerances.tsv: the user's own of that name, else the embedded one.
 *
 * Result    of all surfaces and elements of the lens, each a range
 * Errors    ERROR_USAGE: there is no such grade, with a suggestion; ERROR_DATA: a row that is no
 *           tolerance, as lens_tolerance_read
 */
bool lens_grade_read(struct lensdb *db, struct text name, const struct lens *lens,
                     struct arena *arena, struct tolerances *grade, struct error *error);

#endif
