/* trace/pupil/pupil_islands.h - what passes light of a pupil beyond the boundary that is integrated within. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_PUPIL_ISLANDS_H
#define LENSCALC_TRACE_PUPIL_PUPIL_ISLANDS_H

#include "base/arena.h"
#include "trace/pupil/clearances.h"
#include "trace/pupil/pupil_boundary.h"

/* What of the pupil passes light beyond the boundary. */
struct pupil_islands {
    double share; /* of all that passes, in areas of the beam; 0: there are none */
};

/*
 * What a quadrature leaves out: light that comes through beyond a gap.
 *
 * Formula   first about two hundred rays that usually show that there is nothing: in patches of the
 *           angle and of the way from the boundary outwards, nine rays each. A patch is dark where
 *           one clearance is above 0 at all nine by more than it can fall between them, by its
 *           second differences; at the edge, where it begins at 0, if it rises from there; or where
 *           all nine are lost in the same place in the same way. What is not is cut in four, or in
 *           two where only the way outwards changes what ends the rays. Of halves that mirror each
 *           other one is looked at. Only where a ray passes, or too much is left, a grid
 *           (trace/pupil/pupil_parts.h): what passes of it beyond the edge in its direction, be it
 *           joined with the rest elsewhere or not
 * Limits    islands smaller than a cell, 1/128 of what the first surface lets in, are not seen; the
 *           share of thin ones is a quarter off. Far from the chief ray of a point of the film the
 *           same area of its beam holds less light
 */
struct pupil_islands pupil_islands_find(const struct clearances *margins,
                                        const struct pupil_boundary *boundary, struct arena *arena);

#endif
