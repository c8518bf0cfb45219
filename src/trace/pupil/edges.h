/* trace/pupil/edges.h - where a pupil ends in given directions from a point within it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_EDGES_H
#define LENSCALC_TRACE_PUPIL_EDGES_H

#include "trace/pupil/clearances.h"

#include <stddef.h>

/* Where directions begin, and what a step towards them is: angles count from v towards u. */
struct edge_frame {
    double centre[2], stretch[2];
};

/* The last that is clear in a direction. */
struct edge {
    double radius; /* in units of the frame */
    size_t limit;  /* what ends it: struct clearances */
};

/* u and v of a place in a frame. */
void edge_point(const struct edge_frame *frame, double angle, double radius, double point[2]);

/* The other way round: its angle, rad, that next to `about`, and its radius. */
void edge_polar(const struct edge_frame *frame, const double point[2], double about, double *angle,
                double *radius);

/*
 * Edges in any number of directions from a point inside, a block of rays at a time: whoever wants
 * the edge of a clear pupil finds it here.
 *
 * Given     frame      its centre passes
 *           angles     `count` of them, rad
 *           near       radii close by, or 0 where they are not known; null: none is
 *           slack      what they may be off by, a share of them; 0: 3 %
 *           tolerance  an excess that counts as none; rounding is 1e-14
 * Formula   a bracket by steps of 0.14, so that a narrow gap is not passed over, or the slack about
 *           what is near; in it Muller's method on the excess (trace/pupil/clearances.h), which is
 *           smooth but for corners; bisection where that leaves the bracket, and where a ray is
 *           lost by something that has no excess
 */
void edges_find(const struct clearances *margins, const struct edge_frame *frame,
                const double *angles, const double *near, size_t count, double slack,
                double tolerance, struct edge *edges);

/* A ray at the edge: the last that passes. */
struct clear_edge {
    double at[2];           /* coordinates in the beam, mm */
    enum ray_status status; /* of its neighbour outside, and where that one is lost; 1-based */
    size_t surface;
};

/* An edge that was found, by its ray. */
struct clear_edge clear_edge_of(const struct clearances *margins, const struct edge_frame *frame,
                                double angle, const struct edge *edge);

#endif
