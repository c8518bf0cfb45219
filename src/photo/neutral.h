/* photo/neutral.h - neutral-density filters to put on for a wanted light loss. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_NEUTRAL_H
#define LENSCALC_PHOTO_NEUTRAL_H

#include <stddef.h>

#include "base/error.h"

/* More on one lens darken the corners; and as many strengths as anybody has. */
enum { NEUTRAL_FILTERS = 3, NEUTRAL_STRENGTHS = 32, NEUTRAL_STACKS = 2 * NEUTRAL_FILTERS };

/* Filters on each other: places in the list of strengths, the strongest first. */
struct neutral_stack {
    size_t filters[NEUTRAL_FILTERS];
    size_t count;
    double stops; /* of all together */
};

/*
 * The stacks of filters that come nearest to a wanted light loss, from both sides.
 *
 * Given     strengths  stops of each filter there is, ascending, > 0; each is there once
 *           count      of them, up to NEUTRAL_STRENGTHS
 *           most       filters on each other, 1 to NEUTRAL_FILTERS
 *           wanted     stops, > 0
 *           stacks     receives them: for one filter, then for two and three, the nearest that
 *                      takes no more than wanted and the nearest that takes more; of two and three
 *                      only what is nearer than all stacks of fewer filters on that side
 *           found      receives their number, 1 or more
 * Formula   the stops of a stack are the sum of those of its filters; all stacks are looked at
 * Source    definition of a stop: transmittances multiply, their logarithms add
 * Errors    wanted not above 0 or not finite; no strengths, or too many; most outside its range
 * Limits    Filters are off their labels by up to a third of a stop and more; light reflected
 *           between them is left out
 */
bool neutral_stacks(const double *strengths, size_t count, size_t most, double wanted,
                    struct neutral_stack stacks[NEUTRAL_STACKS], size_t *found,
                    struct error *error);

#endif
