/* trace/clear.h - what the clear apertures let through of a beam: pupils with their vignetting. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_CLEAR_H
#define LENSCALC_TRACE_CLEAR_H

#include "base/arena.h"
#include "optics/first_order.h"
#include "trace/beam.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

struct spans; /* trace/spans.h */

/* A ray at the edge: the last that passes. */
struct clear_edge {
    double at[2];           /* coordinates in the beam, mm */
    enum ray_status status; /* of its neighbour outside, and where that one is lost; 1-based */
    size_t surface;
    size_t part; /* where apertures are listed: a number of the pieces of edges that it meets */
};

/* A ray at the edge that an integral over the pupil is taken by. */
struct clear_arm {
    struct clear_edge edge;
    double area;               /* that it stands for, from the centre to the edge, mm^2 */
    const struct spans *spans; /* the clear parts of the way there */
};

/*
 * The edge in smooth pieces, from corner to corner, each with CLEAR_ARC arms at Gauss's points of
 * its angles; without corners one piece with equal angles.
 */
enum { CLEAR_ARC = 32, CLEAR_CORNERS = 16, CLEAR_CUTS = 96 };

/*
 * The part of a beam that arrives, as a star about `centre`. Its edge is that of the beam without
 * what blocks within; what does is cut out of the arms and the area alone.
 */
struct clear_pupil {
    bool is_empty; /* nothing arrives: the rest is not set */
    bool is_cut;   /* something may block light within the edge */
    double centre[2];
    double low[2], high[2];         /* bounds along the two axes of the beam, mm */
    struct clear_edge ends[4];      /* where they are: the largest a, b, the least a, b */
    double area;                    /* in the plane of the beam, mm^2 */
    double within;                  /* all that lies within the edge, mm^2 */
    const struct clear_edge *edges; /* counterclockwise, the first at -90 degrees: below */
    size_t edge_count;
    struct clear_arm *arms;   /* counterclockwise, in `arcs` pieces of CLEAR_ARC each */
    size_t arm_count, arcs;   /* arcs: 0 where there are no corners, and the arms are the edges */
    const double *arc_angles; /* how wide each piece is, rad */
    const struct clear_edge *corners; /* two for each piece: just before and behind its beginning */
};

/* Where to look: a point inside, roughly, and a size. */
struct clear_guess {
    double centre[2], radius; /* mm, in the beam */
};

/* By the paraxial entrance pupil, or for a reversed system by the exit pupil. */
struct clear_guess clear_guess_of(const struct system *system, const struct beam *beam,
                                  const struct first_order *first);

/*
 * The shape of a beam that passes all clear apertures and the stop.
 *
 * Given     system      compiled with clip on, forward or reversed; rays are lost by clear
 *                       apertures, by total reflection or by missing a surface
 *           directions  how many edges: a multiple of 4, 4 to 4096
 *           guess       from clear_guess_of
 * Formula   a point inside is searched for (trace/probe.h); from it every edge is bracketed and
 *           bisected to rounding; the centre then moves to the centroid and all is done once more,
 *           by angles of a circle that is stretched along a and b as the shape is.
 *           Corners are where two edges side by side are ended by different surfaces: their angles
 *           are bracketed to 1e-7 and less. Bounds: the corners, and the neighbourhood of the
 *           extreme edge in 128 times as many directions
 *           Area: the sum of r^2/2 over equal angles about the centre where there are no corners,
 *           which converges as fast as Fourier series do; else by Gauss's rule from one corner to
 *           the next. Where apertures are listed a side of a polygon is a piece of the edge too.
 *           Where something blocks within the edge, every arm is cut (trace/spans.h), what it
 *           crosses belongs to what it is compared by, and the angles t of a piece of the width
 *           w are w (1 - cos(pi u))/2 with Gauss's points u: lines that touch an edge do no harm
 * Limits    1e-10 of the area with 64 directions and more, 1e-14 of discs and ellipses. A surface
 *           that ends less of the edge than one step may go unseen: some 1e-7 with 256 directions.
 *           A shape that is not a star about its centroid is cut at its nearest edges; one with
 *           more than CLEAR_CORNERS corners is summed over equal angles, which leaves about 10/k^2
 *           of the area with k directions. With something that blocks 1e-8 of the area within the
 *           edge with 256 directions, if no more than CLEAR_CUTS corners are met; an arm of a
 *           spider that is seen under less than one step of the directions may be missed
 */
void clear_find(const struct system *system, const struct beam *beam,
                const struct clear_guess *guess, size_t directions, struct arena *arena,
                struct clear_pupil *pupil);

#endif
