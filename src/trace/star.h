/* trace/star.h - what is clear of a pupil, as a star about a point within it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_STAR_H
#define LENSCALC_TRACE_STAR_H

#include "trace/edges.h"
#include "trace/spans.h"

enum { STAR_DIRECTIONS = 256 + 64, STAR_CORNERS = 64 };

/* Its edge in some directions, ascending in angle, and the corners between smooth pieces of it. */
struct star {
    struct edge_frame frame;
    double angles[STAR_DIRECTIONS]; /* rad */
    struct edge edges[STAR_DIRECTIONS];
    size_t count;
    double corners[STAR_CORNERS]; /* rad, ascending */
    double radii[STAR_CORNERS];
    size_t corner_count;
    /* both, by star_join */
    double knots[STAR_DIRECTIONS + STAR_CORNERS], knot_radii[STAR_DIRECTIONS + STAR_CORNERS];
    size_t knot_count;
    double tolerance; /* of the excess at edges */
    bool is_whole;    /* the stop or the disc alone ends it, or its edge is even */
    bool is_plain;    /* only margins end it: neither lists of apertures nor rays lost otherwise */
};

/*
 * The clear part of a pupil.
 *
 * Given     probe  for what cuts within
 * Result    false: nothing is clear
 * Formula   about the chief ray if it passes, else about the ray that passes best of the largest
 *           part that passes (trace/parts.h); where more than the stop ends it about its centroid,
 *           in a frame stretched as it is. Edges in 32 directions, 256 where apertures are listed
 *           or rays are lost otherwise at the edge, to a share of how deep the centre lies within.
 *           Two neighbours that end at different things hold a corner: where both excesses are 0,
 *           by Newton's method; where that does not lead to a corner between the two, by cutting
 *           the angle in five. A piece that no direction meets is looked for where its excess, a
 *           parabola through three neighbours, has its peak above or near 0. Of halves that mirror
 *           each other (stop_beam_is_mirrored) one is looked in
 * Limits    more than STAR_CORNERS corners are none. What lies behind a gap, seen from the centre,
 *           is not found
 */
bool star_find(const struct margins *margins, const struct probe *probe, struct arena *arena,
               struct star *star);

/*
 * The same from a star of a beam close by, of another field or wavelength, in a third of the time.
 *
 * Given     before  of the same lens; with a count of 0 there is none
 * Result    false: it does not lead to a star of as many corners; ask star_find
 * Formula   edges about those before, in a frame fitted anew; corners by Newton's method from those
 *           before. What is checked of the star is what star_find does
 */
bool star_follow(const struct margins *margins, const struct probe *probe,
                 const struct star *before, struct star *star);

/*
 * Corners that were missed, by edges in other directions that end at what the star does not know
 * there.
 *
 * Given     edges  in the star's frame, found to rounding
 * Result    true: the star has more corners than before
 * Limits    none where apertures are listed
 */
bool star_learn(const struct margins *margins, const struct probe *probe,
                const struct edge_directions *directions, const struct edge *edges,
                struct star *star);

/* Corners on one side of u = 0, with those on the other that mirror them. */
void star_mirror_corners(struct star *star);

/* Join edges and corners into one list, ascending from the first edge on, for star_near. */
void star_join(struct star *star);

/* About where the edge is in a direction, by its neighbours: within 1 % but for narrow pieces. */
double star_near(const struct star *star, double angle);

/* What is clear of lines from the centre to edges. */
void star_spans(const struct margins *margins, const struct probe *probe,
                const struct edge_directions *directions, const struct edge *edges,
                struct spans *spans);

#endif
