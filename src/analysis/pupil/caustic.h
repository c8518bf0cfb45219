/* analysis/pupil/caustic.h - whether a bundle of rays turns over on its way. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_CAUSTIC_H
#define LENSCALC_ANALYSIS_PUPIL_CAUSTIC_H

#include "base/arena.h"
#include "trace/pupil/clear.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * Rays by which a fold is seen: on arms from the centre to the edge, three side by side each time.
 *
 * Result    `count` places in the beam, mm, a multiple of three
 */
enum caustic_grid { CAUSTIC_COARSE, CAUSTIC_FINE };
const double (*folding_places(const struct clear_pupil *clear, enum caustic_grid grid,
                              struct arena *arena, size_t *count))[2];

/*
 * The least and the largest Jacobian d(plane)/d(beam) that were seen, at least 0 and at most; the
 * largest inverse of one, infinite if a ray was lost.
 */
struct jacobian_extremes {
    double least, most, inverse;
};

/*
 * Does the bundle fold in a plane: do two of its rays meet there, beside a caustic?
 *
 * Given     points  where some rays of folding_places cross the plane, mm, a multiple of three;
 *                   NaN: they do not
 *           folding begins as { 0 }
 * Formula   the sign of the Jacobian, by differences, is not the same everywhere
 * Limits    of the fine grid: a fold between two of the 128 arms or of the 12 rings, and one that
 *           changes nothing but less than 1e-6 of the largest Jacobian, goes unseen
 */
void caustic_add(struct jacobian_extremes *folding, const double (*points)[2], size_t count);
bool caustic_seen(const struct jacobian_extremes *folding);

/* Are Jacobians so much alike, within a factor of 2, that a coarse grid is enough? */
bool caustic_ruled_out(const struct jacobian_extremes *folding);

#endif
