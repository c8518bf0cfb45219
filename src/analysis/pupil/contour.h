/* analysis/pupil/contour.h - area and centroid of a pupil from the points of its edge. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_CONTOUR_H
#define LENSCALC_ANALYSIS_PUPIL_CONTOUR_H

#include "trace/pupil/clear.h"

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

#endif
