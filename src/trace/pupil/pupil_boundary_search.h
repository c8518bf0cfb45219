/* trace/pupil/star_search.h - what a star is found by: its edges, what ends them, their corners. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_STAR_SEARCH_H
#define LENSCALC_TRACE_PUPIL_STAR_SEARCH_H

#include "trace/pupil/star.h"

struct star_search {
    const struct clearances *margins;
    const struct probe *probe;
    struct pupil_boundary *star;
    const struct pupil_boundary *before; /* one close by; null: nothing is known */
    double tolerance;                    /* of edges that are only compared */
};

/* Are the halves of a star on both sides of u = 0, from where angles count, mirror images? */
static inline bool star_is_mirrored(const struct star_search *search)
{
    return search->margins->is_mirrored && search->star->frame.centre[0] == 0;
}

/* Edges to compare with each other: where apertures are listed it counts which piece ends one. */
void star_limits_find(const struct star_search *search, const double *angles, const double *near,
                      size_t count, struct edge *edges);

/* From a direction to the next one, rad. */
double star_gap(const struct pupil_boundary *star, size_t i);

/* A further direction and its edge, in its place. */
void star_enter(struct pupil_boundary *star, double angle, const struct edge *edge);

/*
 * Corners between directions whose edges end at different things.
 *
 * Result    corners of the star; more than there is room for: none
 * Formula   Newton's method where two margins meet, cuts in five elsewhere
 */
void star_corners_find(const struct star_search *search);

#endif
