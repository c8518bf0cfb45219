/* file/lens_tolerance.h - tolerances of a .lens file, of a file of their own, and of a grade. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_TOLERANCE_H
#define LENSCALC_FILE_LENS_TOLERANCE_H

#include "data/lensdb.h"
#include "file/file_words.h"
#include "optics/growing.h"
#include "optics/lens.h"
#include "optics/tolerance.h"

/*
 * Read what follows the word `tolerance`: R1 0.1% uniform, t3..t5 0.02mm normal 3sigma,
 * element 3..5 tilt 2arcmin pivot 4.
 *
 * Given     words  the line; the lens has all its surfaces
 * Result    one more of the lens
 * Errors    ERROR_DATA with line and column: what it is of, the unit or the distribution is unknown
 *           or does not belong to it, a surface that the lens has not, an amount of 0 or less, or
 *           of 100 % and more, more than 1000 lines
 */
bool lens_tolerance_read(struct file_words *words, struct lens *lens);

/* The same, as a line of a file in this unit has it. */
void lens_tolerance_write(const struct lens_tolerance *tolerance, const char *unit,
                          struct text_buffer *text);

/*
 * Read a file that has nothing but such lines and comments.
 *
 * Given     source   its name, for messages
 *           content  the list points into it
 *           lens     that they are for: bare lengths are in its unit
 * Errors    ERROR_DATA as lens_tolerance_read; another line; no line at all
 */
bool lens_tolerances_read(const char *source, struct text content, const struct lens *lens,
                          struct arena *arena, struct tolerances *tolerances, struct error *error);

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
