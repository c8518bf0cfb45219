/* trace/aim/continuation.h - rays led from the chief ray to points of the stop, in steps that are sure. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_CONTINUATION_H
#define LENSCALC_TRACE_AIM_CONTINUATION_H

#include "trace/aim/aim.h"

#include <stdbool.h>
#include <stddef.h>

/* A ray on its way along the straight line in the stop from the chief ray to its goal. */
struct continuation {
    double goal[2];        /* in the stop, mm */
    double at[2], miss[2]; /* how far it has come: the beam's coordinates; left to its last aim */
    double done;           /* share of the way; 1: it is there, to `reached` of the radius */
};

/* A ray that is so near its place, in radii of the stop, is there. */
static const double lead_reached = 1e-9;

/*
 * Lead rays to their goals.
 *
 * Given     leads  with their goals
 *           count  1 to RAYS_BLOCK: they go side by side, each as it would alone
 * Result    done < 1: the rays of the line end before the goal, or its slopes change their sign:
 *           the pupil is folded there
 * Formula   Newton's method from place to place of the line, with the slopes of each, by steps that
 *           grow where they succeed and are halved where they do not, to 1e-4 of the way
 */
void continuation_rays(const struct aim *aim, struct continuation *leads, size_t count);

#endif
