/* analysis/folding.h - whether a bundle of rays turns over on its way. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_FOLDING_H
#define LENSCALC_ANALYSIS_FOLDING_H

#include "base/arena.h"
#include "trace/clear.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * Rays by which a fold is seen: on arms from the centre to the edge, three side by side each time.
 *
 * Result    `count` places in the beam, mm, a multiple of three
 */
const double (*folding_places(const struct clear_pupil *clear, struct arena *arena,
                              size_t *count))[2];

/*
 * Does the bundle fold in a plane: do two of its rays meet there, beside a caustic?
 *
 * Given     points  where the rays of folding_places cross the plane, mm; NaN: they do not
 * Formula   the sign of the Jacobian d(plane)/d(beam), by differences, is not the same everywhere
 * Limits    a fold between two of the 128 arms or of the 12 rings, and one that changes nothing
 *           but less than 1e-6 of the largest Jacobian, goes unseen
 */
bool folding_seen(const double (*points)[2], size_t count);

#endif
