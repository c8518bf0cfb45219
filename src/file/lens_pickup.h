/* file/lens_pickup.h - pick-ups of a .lens file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_PICKUP_H
#define LENSCALC_FILE_LENS_PICKUP_H

#include "file/file_words.h"
#include "optics/growing.h"

/*
 * Read what follows the word `pickup`: R6 = -R3, t9 = 0.5 t4 + 2, glass5 = glass2. Factors are
 * plain numbers, what is added is in the unit of the number.
 *
 * Given     words  the line; the lens has all its surfaces, positions and settings
 * Errors    ERROR_DATA with line and column: unknown names, no number that is followed, two of
 *           them, and what lens_pickup_add refuses
 */
bool lens_pickup_read(struct file_words *words, struct lens *lens);
void lens_pickup_write(const struct lens_pickup *pickup, const char *unit,
                       struct text_buffer *text);

/*
 * Put the numbers of all pick-ups in, once the lens is whole.
 *
 * Result    what was typed keeps its digits where it is what the pick-up gives; where it is not,
 *           to the digits typed, the pick-up has a warning
 */
void lens_pickups_begin(struct lens *lens, struct arena *arena);

#endif
