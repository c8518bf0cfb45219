/* trace/pupil/pupil_boundary_search.h - what a boundary is found by: edges, what ends them, corners. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_PUPIL_BOUNDARY_SEARCH_H
#define LENSCALC_TRACE_PUPIL_PUPIL_BOUNDARY_SEARCH_H

#include "trace/pupil/pupil_boundary.h"

struct pupil_boundary_search {
    const struct clearances *margins;
    struct pupil_boundary *boundary;
    const struct pupil_boundary *before; /* one close by; null: nothing is known */
    double tolerance;                    /* of edges that are only compared */
};

/* Are its halves on both sides of u = 0, from where angles count, mirror images? */
static inline bool pupil_boundary_is_mirrored(const struct pupil_boundary_search *search)
{
    return search->margins->is_mirrored && search->boundary->frame.centre[0] == 0;
}

/* Edges to compare with each other: where apertures are listed it counts which piece ends one. */
void pupil_boundary_limits_find(const struct pupil_boundary_search *search, const double *angles,
                                const double *near, size_t count, struct edge *edges);

/* From a direction to the next one, rad. */
double pupil_boundary_gap(const struct pupil_boundary *boundary, size_t i);

/* A further direction and its edge, in its place. */
void pupil_boundary_enter(struct pupil_boundary *boundary, double angle, const struct edge *edge);

/*
 * Corners between directions whose edges end at different things.
 *
 * Result    corners of the boundary; more than there is room for: none
 * Formula   Newton's method where two margins meet, cuts in five elsewhere
 */
void pupil_boundary_corners_find(const struct pupil_boundary_search *search);

#endif
