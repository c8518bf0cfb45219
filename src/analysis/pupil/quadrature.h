/* analysis/pupil/quadrature.h - rays that integrate over what is clear of a stop. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_PUPIL_QUADRATURE_H
#define LENSCALC_ANALYSIS_PUPIL_QUADRATURE_H

#include "base/arena.h"
#include "trace/aim/sample.h"
#include "trace/kernel/rays.h"
#include "trace/pupil/clear.h"
#include "trace/pupil/pupil_boundary.h"
#include "trace/pupil/pupil_islands.h"
#include "trace/pupil/stop_beam.h"

#include <stdbool.h>
#include <stddef.h>

/* The arcs between corners: arms of each, at Gauss's points of it. None: arms all around, equal. */
struct quadrature_arcs {
    const size_t *arms;
    size_t count;
};

/* Rays, where they start, by their points of the stop or disc and with their weights. */
struct quadrature {
    struct sample sample;
    struct rays rays;
    bool is_empty;      /* nothing is clear */
    size_t arms, rings; /* points: ring after ring outwards, the arms in each; 0: not so orderly */
    struct quadrature_arcs arcs;
};

/* What is clear of a pupil, found once for quadratures of any number of rays. */
struct quadrature_region {
    const struct stop_beam *beam;
    struct clearances margins;
    struct pupil_boundary *boundary; /* once it is known; a count of 0: it is not */
    const struct pupil_boundary
        *near; /* one of a beam close by, to be set before; null: there is none */
    bool is_known, is_empty;
    bool in_r;    /* points are Gauss's in r, not in r^2: to be set before it is filled */
    bool in_beam; /* points stay u and v, their weights areas there, and have no rays: the same */
    bool in_half; /* what is integrated mirrors as the pupil does: half of it, twice; the same */
};

/* Make ready; nothing is traced yet. All lies in the arena. */
struct quadrature_region quadrature_open(const struct stop_beam *beam, struct arena *arena);

/*
 * Points and weights that integrate over the clear part of a stop or an entrance pupil.
 *
 * Given     rays   about how many
 * Result    weights that add up to the clear share of the area they are equal in: of the stop, of
 *           the disc; with WEIGHT_BEAM and a stop of the unit disc of u and v, which the beam of
 *           the whole stop fills but for aberrations
 * Formula   the clear part is star-shaped (trace/pupil/pupil_boundary.h), found in u and v, where
 *           no ray has to be aimed; k rings of Gauss's points in r^2, whose error in r itself
 *           cancels about a centroid. Where the whole stop or disc is clear 2 k + 1 equal arms,
 *           else 3 k + 2 and more, at Gauss's points of the angle from corner to corner, where
 *           integrands are smooth. At least `rays` in all. Weights of the stop are du dv times
 *           d(x, y)/d(u, v) by trace/tangent.h, those of the beam du dv and the density of a
 *           projection. A stop that no rim can clip is aimed at, which is faster
 *           With in_r the rings are Gauss's points in r: more of them for the same, but odd powers
 *           of r are integrated too, wherever the centre is, which more than eight digits want
 * Source    [Forbes88]; tested against an independent program: vignetted spots of the double Gauss
 *           at 14 degrees, with two corners, to 1e-6 with 162 rays and 1e-9 with 338, of a 58 mm
 *           f/0.95 with eight to 1e-6 with 648
 * Limits    as pupil_boundary_find; what it does not see makes integrals converge slowly, as a
 * doubled sample
 *           shows
 */
struct quadrature quadrature_fill(struct quadrature_region *region, size_t rays,
                                  struct arena *arena);

/* What of the light a quadrature leaves out: see pupil_islands_find. */
struct pupil_islands quadrature_islands(struct quadrature_region *region, struct arena *arena);

/* The boundary of what is clear; null: nothing is. */
const struct pupil_boundary *quadrature_boundary(struct quadrature_region *region,
                                                 struct arena *arena);

/* Points on its edge, in directions of the boundary's frame. */
struct quadrature_rim {
    const double (*points)[2]; /* u and v */
    const double *radii;       /* in the boundary's frame */
    size_t count;
};

/* Given: near: radii close by, but for a share of `slack`; null: what the boundary says. */
struct quadrature_rim quadrature_edge(const struct quadrature_region *region, const double *angles,
                                      size_t count, const double *near, double slack,
                                      struct arena *arena);

/* Rays at shares of the way to such points from its centre, where they start: for each
   share a ring of them. */
void quadrature_rays_within(const struct quadrature_region *region,
                            const struct quadrature_rim *rim, const double *shares, size_t rings,
                            const struct rays *rays);

/*
 * Equal areas of the stop, or of the disc that is aimed at, as what they are of the beam.
 *
 * Given     rays    through the points, where they start
 *           points  of radius 1, whose weights change; that of a ray lost before the stop does not
 */
void quadrature_weigh_beam(const struct stop_beam *beam, const struct rays *rays,
                           struct pupil_point *points, struct arena *arena);

/* The same as quadrature_fill for one time. */
struct quadrature quadrature_make(const struct stop_beam *beam, size_t rays, struct arena *arena);

#endif
