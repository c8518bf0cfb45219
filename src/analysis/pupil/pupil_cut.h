/* analysis/pupil/pupil_cut.h - area and centroid of a pupil within which something blocks light. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_PUPIL_CUT_H
#define LENSCALC_ANALYSIS_PUPIL_PUPIL_CUT_H

#include "trace/aim/beam.h"
#include "trace/pupil/clear.h"
#include "trace/system.h"

/* A plane across the axis, on either side of a lens. */
struct cut_plane {
    const struct system *system; /* without clip */
    const struct beam *beam;
    size_t to;              /* the place that rays are taken to: 0, or all */
    double z;               /* of the plane, mm, from the first or the last vertex */
    double light_direction; /* there, along z */
};

struct cut_extent {
    double area;      /* mm^2 */
    double centre[2]; /* centroid, mm */
};

/*
 * What is clear of a beam, in a plane.
 *
 * Given     clear  of clear_find, not empty
 * Result    NaN where rays run along the plane
 * Formula   Gauss's points on the clear parts of every arm; each fills |d(x, y)/d(a, b)| of the
 *           plane, by differences of rays beside it
 * Limits    1e-8 of the area where the plane maps the beam smoothly
 */
struct cut_extent pupil_cut(const struct cut_plane *plane, const struct clear_pupil *clear,
                            struct arena *arena);

#endif
