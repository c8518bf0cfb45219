/* analysis/rays/spot_radius.h - how far from a point of the image plane rays arrive at most. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_SPOT_RADIUS_H
#define LENSCALC_ANALYSIS_RAYS_SPOT_RADIUS_H

#include "analysis/pupil/bundle.h"

#include <stdbool.h>
#include <stddef.h>

/* Where rays are looked at. */
struct spot_plane {
    size_t to;           /* the place behind the surface */
    bool is_angular;     /* sines of angles, not mm */
    double origin[2];    /* that points are counted from, mm */
    double across[2][3]; /* of angles */
};

/* Where the ray in a lane of a block is, about the origin; n: index of its medium. */
void spot_place(const struct spot_plane *plane, const struct ray_block *block, size_t lane,
                double n, double at[2]);

/* What is asked. */
struct spot_radius_question {
    const struct bundle_source *sources; /* of PATTERN_GAUSS, one a wavelength */
    size_t count;
    const struct spot_plane *plane;
    double about[2];
};

/*
 * The largest distance of the rays that pass the clear pupil from a point.
 *
 * Given     error  receives what the distance is off by its search
 * Formula   48 directions and all corners times eight rings, the outermost the edge itself; the
 *           peaks that parabolas say are as high as the highest are looked at closer, on grids of
 *           nine rings and lines about the vertices of such parabolas, until they stand. Where
 *           rays graze a surface at the edge: cubics of the root of the way to it, to its end
 * Limits    the edge of what blocks light in the middle is met to 1e-9 of the pupil at best
 */
double spot_radius_find(const struct spot_radius_question *question, struct arena *arena,
                        double *error);

#endif
