/* trace/pupil/probe.h - trying rays of a beam by the block, for trace/clear. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_PROBE_H
#define LENSCALC_TRACE_PUPIL_PROBE_H

#include "trace/aim/beam.h"
#include "trace/kernel/rays.h"
#include "trace/pupil/clear_guess.h"
#include "trace/system.h"

#include <stdbool.h>
#include <stddef.h>

/* What is tried, and one block to try it in. */
struct probe {
    const struct system *system; /* with clip, unobstructed */
    const struct system *full;   /* with what cuts within; null: nothing does */
    const struct beam *beam;
    struct rays work;
};

/*
 * Given     clipped  compiled with clip
 */
struct probe probe_open(const struct system *clipped, const struct beam *beam, struct arena *arena);

/* The same in a block that something else works in too, from rays_new. */
struct probe probe_share(const struct system *clipped, const struct beam *beam, struct rays work);

static inline bool probe_passes(const struct probe *probe, size_t lane)
{
    return ray_block_status(probe->work.blocks, lane) == RAY_OK;
}

/*
 * By how much rays fail to pass: the largest r^2/a^2 - 1 of all clear apertures, 0 and less for
 * those that pass but for rounding; for one that misses a surface or is totally reflected
 * PROBE_LOST and more, less the farther it comes.
 *
 * Given     surfaces   whose clear apertures count, LENS_NONE behind the last; null: all
 *           at, count  up to RAYS_BLOCK rays; their fate stays in the block
 *           excess     receives `count` numbers, never NaN
 */
#define PROBE_LOST 1e30
void probe_excess(const struct probe *probe, const size_t *surfaces, const double (*at)[2],
                  size_t count, double *excess);

bool probe_passes_one(const struct probe *probe, const double at[2]);

/*
 * A ray that passes, well inside of what does.
 *
 * Formula   the excess is the largest of functions that are convex but for aberrations: coarse
 *           grids about the guess and over the first surface, then from the least of each grid
 *           smaller and smaller ones, until the excess is below 0, or so far above that no smaller
 *           step can bring it there. So a sliver is found however thin it is, and where nothing
 *           passes a few thousand rays say so
 * Result    false: nothing passes
 * Limits    light that neither the grids nor a way downhill from them meets is not found: parts
 *           smaller than a grid's step behind surfaces that everything about them misses
 */
bool probe_inside(const struct probe *probe, const struct clear_guess *guess, double inside[2]);

/*
 * Which piece of an aperture's edge rays are nearest to that end at it.
 *
 * Given     at     up to RAYS_BLOCK rays that pass
 *           edges  what ends them: receives `part`, 0 where no list of apertures does
 */
void probe_parts(const struct probe *probe, const double (*at)[2], size_t count,
                 struct clear_edge *edges);

/*
 * How far within something that blocks rays come: the largest clip_depth of all surfaces.
 *
 * Given     at     up to RAYS_BLOCK rays; probe->full is not null
 *           depth  receives it: 0 and less passes
 *           part   a number of the piece of an edge that decides
 */
void probe_depth(const struct probe *probe, const double (*at)[2], size_t count, double *depth,
                 size_t *part);

#endif
