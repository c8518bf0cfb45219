/* analysis/pupil/pupil_shape.h - entrance and exit pupil of one point, as its rays see them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_PUPIL_SHAPE_H
#define LENSCALC_ANALYSIS_PUPIL_PUPIL_SHAPE_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/first_order.h"
#include "trace/aim/beam.h"
#include "trace/pupil/pupil_islands.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

/* Where on the outline: towards +x, +y, -x, -y. */
enum pupil_end { PUPIL_RIGHT, PUPIL_UPPER, PUPIL_LEFT, PUPIL_LOWER, PUPIL_ENDS };

/* The outline in one plane across the axis; all NaN where the rays do not cross it. */
struct pupil_extent {
    double z;               /* of the plane, mm, from the first or the last vertex */
    double low[2], high[2]; /* x, y, mm */
    double centre[2];       /* centroid */
    double area;            /* mm^2 */
    bool folds; /* some points are met twice: area, centroid and unknown bounds are NaN */
    const double (*outline)[2]; /* one point an edge, mm; counterclockwise or clockwise */
};

/* One side of the lens. */
struct pupil_side {
    struct pupil_extent pupil;  /* in the plane of the paraxial pupil */
    struct pupil_extent vertex; /* in that of the first (last) vertex */
    size_t limit[PUPIL_ENDS];   /* surface that ends it there, 1-based; 0 = not known */
    struct ray chief;           /* where it crosses the plane of the vertex, and its direction */
};

struct pupil_shape {
    bool is_empty;          /* no ray arrives: only has_chief, status, surface and rays are set */
    enum ray_status status; /* what stops the chief ray or, without one, the middle of the beam */
    size_t surface;         /* and where, 1-based; 0 = nothing */
    bool has_chief;
    size_t count; /* of edges */
    struct pupil_side entrance, exit;
    const double (*stop)[2];       /* the edges in the stop, in units of its radius */
    double vignetting[PUPIL_ENDS]; /* 1 - the farthest edge in the stop, of its radius */
    const double (*across)[2];     /* the edges as the point sees them, from the chief ray, mm */
    double obstruction; /* share of the beam within its edges that is blocked; NaN: nothing may */
    double projected;   /* area across the beam, in the plane of the vertex, mm^2 */
    double cosine_area; /* of a near point: integral of cos dw; NaN for one infinitely far away */
    size_t rays;        /* about how many were traced */
    struct pupil_islands islands; /* what passes beside the bundle, beyond a gap */
};

/* What is looked at. Both systems are of one lens and wavelength, and go the same way. */
struct pupil_question {
    const struct system *clipped, *open; /* compiled with clip, and without */
    const struct beam *beam;             /* of a field point; of the film for reversed systems */
    const struct first_order *first;
    size_t directions; /* edges of outlines: a multiple of 4; 0: none is wanted */
};

/*
 * The pupils of a point: the rays that pass all clear apertures and the stop, where they enter the
 * lens and where they leave it.
 *
 * Given     question  as above
 * Result    outline, bounds and areas on both sides. On the side of the point areas are integrals
 *           over the beam, on the other side those of the curve of the edges (pupil_area.h), which
 *           a bundle that folds there has none of (folding.h)
 * Formula   edges by trace/pupil/clear.h. Area in a plane z, as seen from a point at the distance
 * h from
 *           it, per area of the beam's plane at the distance d: d h^2/(rho^3 cos^3), rho the way to
 *           the beam's plane, cos the direction cosine along z; projected solid angle per area:
 *           cos d/rho^3. Vignetting is measured in the stop, as pupil coordinates are
 * Source    [Welford86] ch. 5 (pupils); derived here: dw = d/rho^3 dA
 * Errors    ERROR_DOMAIN: no stop, or no radius of it. A point from which nothing arrives is data
 * Limits    1e-7 of the areas (discs, ellipses and wide arcs 1e-9); a shape with more than
 *           PUPIL_BOUNDARY_CORNERS corners: 1e-5; one that is not star-shaped: as clear.h says; a
 *           plane that rays meet at more than 89.9 deg counts as not met. What apertures block
 *           within the edges is taken out of areas and centroids (1e-7 too, clear.h says when
 *           less), not of outlines, bounds and vignetting, which are those of the edges
 */
bool pupil_shape(const struct pupil_question *question, struct arena *arena,
                 struct pupil_shape *shape, struct error *error);

#endif
