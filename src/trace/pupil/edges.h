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
    size_t limit;  /* what ends it: struct margins */
};

/* u and v of a place in a frame. */
void edge_point(const struct edge_frame *frame, double angle, double radius, double point[2]);

/* The other way round: its angle, rad, that next to `about`, and its radius. */
void edge_polar(const struct edge_frame *frame, const double point[2], double about, double *angle,
                double *radius);

/* Where to look. */
struct edge_directions {
    struct edge_frame frame; /* its centre passes */
    const double *angles;    /* rad */
    const double *near;      /* radii close by, or 0 where they are not known; null: none is */
    size_t count;
    double slack; /* what they may be off by, a share of them; 0: 3 % */
};

/*
 * Edges in any number of directions.
 *
 * Given     tolerance  an excess that counts as none; rounding is 1e-14
 * Formula   a bracket by steps of 0.14, so that a narrow gap is not passed over, or the slack about
 *           what is near; in it the root of the parabola through three excesses; halves where a ray
 *           is lost by something that has no excess
 */
void edges_find(const struct clearances *margins, const struct edge_directions *directions,
                double tolerance, struct edge *edges);

#endif
