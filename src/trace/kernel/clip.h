/* trace/kernel/clip.h - rays that the apertures of a surface let pass or block. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_KERNEL_CLIP_H
#define LENSCALC_TRACE_KERNEL_CLIP_H

#include "base/arena.h"
#include "optics/aperture.h"
#include "trace/kernel/rays.h"

#include <stdbool.h>
#include <stddef.h>

struct step;

/* The apertures of one surface, without its diameter. */
struct clip {
    const struct aperture_form *forms; /* what loses rays */
    size_t count;
    const struct aperture_form *inner; /* what cuts within their convex hulls */
    size_t inner_count;
};

/* What of them loses rays: all, or as if what passes were convex and nothing blocked. */
enum clip_way { CLIP_ALL, CLIP_HULLS };

/* The apertures of a surface; null where it has none, or for hulls none that pass. */
const struct clip *clip_of(const struct surface *surface, enum clip_way way, struct arena *arena);

/* Does anything of the surface cut within the hulls: a block, a ring, a polygon with a notch? */
bool clip_cuts(const struct surface *surface, struct arena *arena);

/*
 * Lose the rays of a block that do not pass; its points are in the surface's own frame.
 *
 * Given     lanes  the first so many are looked at
 * Formula   as the clear diameter of a step does: a miss stands before it, total reflection behind.
 *           Compiled once: the same bits whatever instructions the kernel has that calls it
 */
void clip_block(const struct step *step, int lanes, struct ray_block *block);

/*
 * By how much a point is beyond all that pass, and by how much within what cuts: 0 and less where
 * light passes, as aperture_excess; -1 where there is nothing.
 *
 * Given     part  receives a number of the piece of an edge that decides; null = not wanted
 */
double clip_excess(const struct clip *clip, double x, double y, size_t *part);
double clip_depth(const struct clip *clip, double x, double y, size_t *part);

#endif
