/* camera/photograph/reuse_grid.h - what a sharp tile sees, through a net of few rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_REUSE_GRID_H
#define LENSCALC_CAMERA_PHOTOGRAPH_REUSE_GRID_H

#include "camera/photograph/ray_reuse.h"

/* What one thread looks through: a net for each wavelength. */
struct reuse_grid;
struct reuse_grid *reuse_grid_new(size_t passes, struct arena *arena);

/*
 * Trace the nets of a tile: rays through the middle of the pupil, and how far others of the tile's
 * middle are from these.
 *
 * Result    false: one of a net is lost, or the pupil is dark
 */
bool reuse_grid_trace(const struct ray_reuse *spare, const struct film_plan *plan,
                      struct reuse_grid *net);

/*
 * The light of half of the samples' points of the film, through nets that were traced.
 *
 * Given     sights, sums  as ray_reuse_take has them
 * Result    false: the watch has ended it
 */
bool reuse_grid_look(const struct ray_reuse *spare, const struct ray_reuse_tile *tile,
                     struct reuse_grid *net, uint64_t sights[DEPTH_CARD_SIGHTS],
                     double (*sums)[CARD_CHANNELS]);

#endif
