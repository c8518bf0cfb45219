/* analysis/waves/fan_edge.h - where lines across a stop leave what is clear of it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_FAN_EDGE_H
#define LENSCALC_ANALYSIS_WAVES_FAN_EDGE_H

#include "analysis/pupil/bundle.h"

#include <stdbool.h>
#include <stddef.h>

/* One such place. */
struct fan_edge {
    double along[2]; /* the line through the centre of the stop: a unit vector */
    double h;        /* the place on it, in radii of the stop: about; receives it */
    bool is_found;
};

enum { FAN_EDGES_MOST = RAYS_BLOCK / 3 };

/*
 * Places of rays aimed at the stop, without aiming each that is looked at.
 *
 * Given     source  of rays that are aimed at a stop; else none is found
 *           edges   up to FAN_EDGES_MOST
 * Formula   Newton's method in the beam, its slopes by differences: the worst excess of all rims
 *           (trace/pupil/clearances.h) is 0, and so is the distance from the line where the ray
 *           crosses the
 *           stop
 * Limits    what is found is an edge, but perhaps another one: rays beside it tell
 */
void fan_edges_find(const struct bundle_source *source, struct fan_edge *edges, size_t count,
                    struct arena *arena);

#endif
