/* design/degenerate.h - lenses that a search may end at, and that are none. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_DEGENERATE_H
#define LENSCALC_DESIGN_DEGENERATE_H

#include "design/merit/merit.h"

/*
 * Is a lens none? Where the stop lies at an image of the object all rays of a
 * field pass one point of it, whatever they do elsewhere: small spots say nothing.
 *
 * Given     merit  for the places that it is judged in
 *           all    the lens in all its positions, as the variables have it
 * Result    null, or in words what is wrong
 * Formula   the paraxial radius of the stop is less than a thousandth of the height of the marginal
 *           ray at some surface; derived here
 */
const char *degenerate_words(const struct merit *merit, const struct lens *all,
                             struct arena *arena);

#endif
