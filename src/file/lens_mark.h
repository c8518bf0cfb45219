/* file/lens_mark.h - what of a .lens file the designer may change, and wants. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_MARK_H
#define LENSCALC_FILE_LENS_MARK_H

#include "file/file_words.h"
#include "optics/growing.h"

/*
 * Read what stands behind the '~' of a mark: nothing, or [low,high] in the unit of its number; inf
 * is no bound.
 *
 * Given     mark  its kind and order are known
 * Errors    ERROR_DATA with line and column: not two numbers, a glass, the lower above the upper.
 *           Of a radius or focal length [50,-100] leads through a plane
 */
bool lens_bounds_read(const struct file_words *words, struct text bounds, struct vary *mark);

/* "t~[2,10]"; without a name "~[2,10]". */
void lens_mark_write(const struct vary *mark, const char *name, const char *unit,
                     struct text_buffer *text);

/* As typed; a computed one with the shortest digits of the unit ("mm"), or of degrees. */
void lens_number_write(struct text_buffer *text, const struct figure *figure,
                       enum parameter_kind kind, int order, const char *unit);

/* Are the bounds in the right order? */
bool lens_bounds_are_sound(const struct vary *mark);

/* Read the numbers of a word behind `let d5`, one a position: 2.4 8.3~ 15.2~[10,20]. */
bool lens_let_read(struct file_words *words, size_t positions, struct lens_variable *variable,
                   size_t *count);

/*
 * Has a word its numbers, and may it vary where it is marked?
 *
 * Given     words  the line that it was first used in
 */
bool lens_let_check(const struct file_words *words, const struct lens *lens, size_t word);

/* A line with `goal`, kept as it is: cli/options/goals.h reads it. */
bool lens_goal_read(struct file_words *words, struct lens *lens);

#endif
