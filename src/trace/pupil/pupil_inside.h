/* trace/pupil/pupil_inside.h - a ray that passes, from which the edge of a pupil is looked for. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_PUPIL_INSIDE_H
#define LENSCALC_TRACE_PUPIL_PUPIL_INSIDE_H

#include "base/arena.h"
#include "optics/first_order.h"
#include "trace/aim/beam.h"
#include "trace/system.h"

#include <stdbool.h>

/* Where to look: a point inside, roughly, and a size. */
struct clear_guess {
    double centre[2], radius; /* mm, in the beam */
};

/* By the paraxial entrance pupil, or for a reversed system by the exit pupil. */
struct clear_guess clear_guess_of(const struct system *system, const struct beam *beam,
                                  const struct first_order *first);

/*
 * A ray that passes, well inside of what does.
 *
 * Given     clipped  compiled with clip
 *           inside   receives its coordinates in the beam
 * Formula   descent on the excess of clearances.h, which is the largest of functions that are
 *           convex but for aberrations: coarse grids about the guess and over the first surface,
 *           then from the least of each grid smaller and smaller ones, until the excess is below 0,
 *           or so far above that no smaller step can bring it there. So a sliver is found however
 *           thin it is, and where nothing passes a few thousand rays say so
 * Result    false: nothing passes
 * Limits    light that neither the grids nor a way downhill from them meets is not found: parts
 *           smaller than a grid's step behind surfaces that everything about them misses
 */
bool pupil_inside_find(const struct system *clipped, const struct beam *beam,
                       const struct clear_guess *guess, struct arena *arena, double inside[2]);

#endif
