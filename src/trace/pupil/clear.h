/* trace/pupil/clear.h - what the clear apertures let through of a beam: pupils with their vignetting. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_CLEAR_H
#define LENSCALC_TRACE_PUPIL_CLEAR_H

#include "base/arena.h"
#include "trace/aim/beam.h"
#include "trace/pupil/edges.h"
#include "trace/pupil/pupil_inside.h"
#include "trace/pupil/pupil_islands.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

struct clear_intervals; /* trace/pupil/clear_intervals.h */

/* A ray at the edge that an integral over the pupil is taken by. */
struct clear_arm {
    struct clear_edge edge;
    double area; /* that it stands for, from the centre to the edge, mm^2 */
    const struct clear_intervals *intervals; /* the clear parts of the way there */
};

/*
 * The edge in smooth pieces, from corner to corner, each with CLEAR_ARC arms at Gauss's points of
 * its angles; without corners one piece with equal angles.
 */
enum { CLEAR_ARC = 40 };

/*
 * The part of a beam that arrives, star-shaped about `centre`. Its edge is that of the beam without
 * what blocks within; what does is cut out of the arms and the area alone.
 */
struct clear_pupil {
    bool is_empty; /* nothing arrives: the rest is not set */
    bool is_cut;   /* something may block light within the edge */
    double centre[2];
    double low[2], high[2];         /* bounds along the two axes of the beam, mm */
    size_t ends[4];                 /* what ends it there: clear_edge_at; high, then low */
    double area;                    /* in the plane of the beam, mm^2 */
    double within;                  /* all that lies within the edge, mm^2 */
    const struct clear_edge *edges; /* counterclockwise, the first at -90 degrees: below */
    size_t edge_count;
    struct clear_arm *arms;   /* counterclockwise, in `arcs` pieces of CLEAR_ARC each */
    size_t arm_count, arcs;   /* arcs: 0 where there are no corners */
    const double *arc_angles; /* how wide each piece is, rad */
    /* two for each piece, just before and behind its beginning */
    const struct clear_edge *corners;
    size_t corner_count;
    double nodes[CLEAR_ARC], gauss[CLEAR_ARC]; /* Gauss's points and weights on 0 .. 1 */
    struct pupil_islands islands;              /* what passes beside it, beyond a gap */
};

/*
 * The shape of a beam that passes all clear apertures and the stop.
 *
 * Given     system      compiled with clip on, forward or reversed; rays are lost by clear
 *                       apertures, by total reflection or by missing a surface
 *           directions  how many edges are wanted for their own sake: none, or a multiple of 4
 *           guess       from clear_guess_of
 * Formula   a point inside is searched for (trace/pupil/pupil_inside.h); about it the boundary
 *           (trace/pupil/pupil_boundary.h). Area: the sum of r^2/2 over equal angles about the
 *           centre where there are no corners, which converges as fast as Fourier series do; else
 *           by Gauss's rule from one corner to the next. Where apertures are listed a side of a
 *           polygon is a piece of the edge too. Where something blocks within the edge, every arm
 *           is cut (trace/pupil/clear_intervals.h), what it crosses belongs to what it is compared
 *           by, and the angles t of a piece of the width w are w (1 - cos(pi u))/2 with Gauss's
 *           points u: lines that touch an edge do no harm. Bounds: clear_extreme
 * Limits    1e-10 of the area, 1e-14 of discs and ellipses. A shape that is not star-shaped about
 *           its centroid is cut at its nearest edges; one with more than PUPIL_BOUNDARY_CORNERS
 *           corners is summed over equal angles, which leaves about 1e-5 of the area. With
 *           something that blocks 1e-8 of the area within the edge; an arm of a spider that is seen
 *           under less than a degree may be missed
 */
void clear_find(const struct system *system, const struct beam *beam,
                const struct clear_guess *guess, size_t directions, struct arena *arena,
                struct clear_pupil *pupil);

/*
 * The largest of sign * coordinate on a curve that the edge is taken to.
 *
 * Given     points  where the corners cross some plane, then the arms
 *           which   receives what ends the pupil there: clear_edge_at
 * Formula   a corner, or the peak of the polynomial through sixteen arms about the farthest one
 * Limits    1e-9 of the size where the plane maps the beam smoothly
 */
double clear_extreme(const struct clear_pupil *pupil, const double (*points)[2], int axis,
                     double sign, size_t *which);

/* The edge at a corner or of an arm, in the order of the points of clear_extreme. */
const struct clear_edge *clear_edge_at(const struct clear_pupil *pupil, size_t which);

#endif
