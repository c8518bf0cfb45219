/* analysis/pupil/pupil_area.h - area and centroid of what passes of a beam, in some plane. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_PUPIL_AREA_H
#define LENSCALC_ANALYSIS_PUPIL_PUPIL_AREA_H

#include "trace/aim/beam.h"
#include "trace/pupil/clear.h"
#include "trace/system.h"

#include <stddef.h>

/*
 * What a closed curve encloses.
 *
 * Given     clear   whose arms the points belong to, as trace/pupil/clear.h cut them into pieces
 *           points  one an arm, mm: where these rays cross some plane
 *           centre  receives the centroid, mm
 * Result    the area, mm^2, whichever way round the curve goes
 * Formula   A = |integral of (x y' - y x') dt|/2, centroid = integral of X (x y' - y x') dt/(3 A);
 *           t is the angle of the arms. Derivatives: on a circle of equal angles by differences of
 *           eighth order, on pieces by those of the polynomial through Gauss's points
 * Source    Green's theorem; [Berrut04] for the polynomial
 * Limits    1e-9 of the area where the plane maps the beam smoothly
 */
double contour_area(const struct clear_pupil *clear, const double (*points)[2], double centre[2]);

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
