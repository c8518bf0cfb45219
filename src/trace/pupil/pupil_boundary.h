/* trace/pupil/pupil_boundary.h - boundary of the clear pupil in polar form about a point inside. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_PUPIL_BOUNDARY_H
#define LENSCALC_TRACE_PUPIL_PUPIL_BOUNDARY_H

#include "trace/pupil/clear_intervals.h"
#include "trace/pupil/edges.h"

enum { PUPIL_BOUNDARY_DIRECTIONS = 256 + 64, PUPIL_BOUNDARY_CORNERS = 64 };

/* Its edge in some directions, ascending in angle, and the corners between smooth pieces of it. */
struct pupil_boundary {
    struct edge_frame frame;
    double angles[PUPIL_BOUNDARY_DIRECTIONS]; /* rad */
    struct edge edges[PUPIL_BOUNDARY_DIRECTIONS];
    size_t count;
    double corners[PUPIL_BOUNDARY_CORNERS]; /* rad, ascending */
    double radii[PUPIL_BOUNDARY_CORNERS];
    size_t corner_count;
    /* both, by pupil_boundary_join */
    double knots[PUPIL_BOUNDARY_DIRECTIONS + PUPIL_BOUNDARY_CORNERS],
        knot_radii[PUPIL_BOUNDARY_DIRECTIONS + PUPIL_BOUNDARY_CORNERS];
    size_t knot_count;
    double tolerance; /* of the excess at edges */
    bool is_whole;    /* the stop or the disc alone ends it, or its edge is even */
    bool is_plain;    /* only margins end it: neither lists of apertures nor rays lost otherwise */
};

/*
 * The clear part of a pupil.
 *
 * Result    false: nothing is clear
 * Formula   edges (trace/pupil/edges.h) about the chief ray if it passes, else about the ray that
 *           passes best of the largest part that passes (trace/pupil/pupil_parts.h); where more
 *           than the stop ends it about its centroid, in a frame stretched as it is. Edges in 32
 *           directions, 256 where apertures are listed or rays are lost otherwise at the edge, to a
 *           share of how deep the centre lies within. Two neighbours that end at different things
 *           hold a corner: where both excesses are 0, by Newton's method; where that does not lead
 *           to a corner between the two, by cutting the angle in five. A piece that no direction
 *           meets is looked for where its excess, a parabola through three neighbours, has its peak
 *           above or near 0. Of halves that mirror each other (stop_beam_is_mirrored) one is looked
 *           in
 * Limits    more than PUPIL_BOUNDARY_CORNERS corners are none. What lies behind a gap, seen from
 *           the centre, is not found
 */
bool pupil_boundary_find(const struct clearances *margins, struct arena *arena,
                         struct pupil_boundary *boundary);

/*
 * The same from that of a beam close by, of another field or wavelength, in a third of the time.
 *
 * Given     before  of the same lens; with a count of 0 there is none
 * Result    false: it does not lead to a boundary of as many corners; ask pupil_boundary_find
 * Formula   edges about those before, in a frame fitted anew; corners by Newton's method from those
 *           before. What is checked of it is what pupil_boundary_find does
 */
bool pupil_boundary_follow(const struct clearances *margins, const struct pupil_boundary *before,
                           struct pupil_boundary *boundary);

/*
 * Corners that were missed, by edges in other directions that end at what is not known
 * there.
 *
 * Given     edges  in the boundary's frame, found to rounding
 * Result    true: there are more corners than before
 * Limits    none where apertures are listed
 */
bool pupil_boundary_learn(const struct clearances *margins, const double *angles, size_t count,
                          const struct edge *edges, struct pupil_boundary *boundary);

/* Join edges and corners into one list, ascending from the first edge on, for pupil_boundary_near.
   */
void pupil_boundary_join(struct pupil_boundary *boundary);

/* About where the edge is in a direction, by its neighbours: within 1 % but for narrow pieces. */
double pupil_boundary_near(const struct pupil_boundary *boundary, double angle);

/* An excess that counts as none at edges that numbers are taken from. */
#define PUPIL_BOUNDARY_ROUNDING 1e-13

/* The edge in any directions, rad, to rounding: edges_find about pupil_boundary_near. */
void pupil_boundary_edges(const struct clearances *margins, const struct pupil_boundary *boundary,
                          const double *angles, size_t count, struct arena *arena,
                          struct edge *edges);

/* What is clear of lines from the centre of a frame to edges. */
void pupil_boundary_intervals(const struct clearances *margins, const struct edge_frame *frame,
                              const double *angles, size_t count, const struct edge *edges,
                              struct clear_intervals *intervals);

#endif
