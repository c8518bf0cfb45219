/* optics/pickup.h - numbers of a lens that follow others: pick-ups. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_PICKUP_H
#define LENSCALC_OPTICS_PICKUP_H

#include "optics/lens.h"

enum { LENS_MOST_PICKUPS = 300 };

/*
 * Put a pick-up into the lens: no number changes yet.
 *
 * Given     lens    has all its surfaces, positions and settings
 *           pickup  glasses follow glasses; of other numbers those of the same dimension, in
 *                   which R, t and f are lengths
 * Result    null, or in words why the lens cannot have it: no such number, one that is a word of
 *           the positions, is marked, or has a pick-up; of itself, in a circle
 */
const char *lens_pickup_add(struct lens *lens, struct lens_pickup pickup, struct arena *arena);

/*
 * Put the numbers of all pick-ups into their places.
 *
 * Given     lens  its surfaces are the caller's own
 *           from  the lens itself in one position; of one with positions their first
 * Formula   factor from + offset; of a plane's infinite radius a plane's
 */
void lens_pickups_put(struct lens *lens, const struct lens *from, struct arena *arena);

#endif
