/* design/merit/merit_points.h - points of the pupil, one for all that are alike by symmetry. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_POINTS_H
#define LENSCALC_DESIGN_MERIT_MERIT_POINTS_H

#include "base/arena.h"
#include "trace/aim/sample.h"

#include <stdbool.h>
#include <stddef.h>

/* How a beam is like itself. */
enum merit_symmetry {
    SYMMETRY_NONE,
    SYMMETRY_MIRROR, /* in the plane x = 0: a field on the y axis of a round lens */
    SYMMETRY_ROUND   /* about the axis: the field there */
};

/* Points that stand for all of a sample. */
struct merit_points {
    struct pupil_point *points; /* weights add up to 1 */
    size_t count;
    double clear; /* what the weights of the sample added up to: the share of the pupil */
    enum merit_symmetry symmetry; /* that was made use of: of SYMMETRY_MIRROR the centroid has
                                     x = 0; of SYMMETRY_ROUND it lies on the axis and points on the
                                     y axis, so that their rays have x = 0 */
};

/*
 * The points of a sample that are not alike.
 *
 * Given     sample    its weights may have any sum above 0
 *           symmetry  of the beam; that of the sample is looked for: if it has not as much, less
 *                     is made use of; of more than 2000 points none
 */
void merit_points_of(const struct sample *sample, enum merit_symmetry symmetry, struct arena *arena,
                     struct merit_points *points);

#endif
