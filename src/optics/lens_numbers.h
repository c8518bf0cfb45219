/* optics/lens_numbers.h - a lens whose numbers are set again and again. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_LENS_NUMBERS_H
#define LENSCALC_OPTICS_LENS_NUMBERS_H

#include "base/arena.h"
#include "optics/lens.h"

/*
 * A private copy of a lens in one position, with room for every number that parameter_set knows:
 * to set one takes no memory. All that reads a lens may be given &numbers->lens, in between.
 */
struct lens_numbers {
    struct lens lens;
    struct displacement *displacements; /* two a surface: its own, and of the axis before it */
    char *written;                      /* of the media, object space first */
};

/*
 * Copy a lens.
 *
 * Given     lens  in one position (lens_at_position); must outlive the copy, which shares what has
 *                 no number: apertures, names, glasses
 */
void lens_numbers_open(const struct lens *lens, struct arena *arena, struct lens_numbers *numbers);

/*
 * Set a number: parameter_set.
 *
 * Given     parameter  passed parameter_check, but for numbers that differ between positions; not
 *                      PARAMETER_GLASS, for which there is parameter_put_medium
 */
void lens_numbers_set(struct lens_numbers *numbers, struct parameter parameter, double value);

#endif
