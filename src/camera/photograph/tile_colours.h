/* camera/photograph/tile_colours.h - tiles whose colours share the rays that look at a scene. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILE_COLOURS_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILE_COLOURS_H

#include "camera/photograph/tile_rays.h"

/* What shared rays have brought to one tile since its last round. */
struct tile_colours *tile_colours_new(size_t passes, struct arena *arena);

/* Begin a tile, in which nothing is shared yet. */
void tile_colours_begin(struct tile_room *room);

/*
 * May rays of one colour stand for those of all in this tile, but for where they come from? Then
 * tile_rays_sum looks along them alone.
 *
 * Result    room->fringes; null: they may not
 */
bool tile_colours_share(const struct tile_rays *tile, const struct film_plan *plan,
                        struct tile_room *room);

/*
 * Blocks begin .. end - 1 of points of a tile whose colours share rays.
 *
 * Result    room->sums, where a round ends: after a power of two of blocks, 8 at least
 * Formula   of each pixel and colour the light that its own rays bring from a white scene, times
 *           the mean of what the shared rays show that look where these do. Means of few are off by
 *           as much as weights and light have to do with each other over their number: rounds are
 *           as long as all before them
 */
void tile_colours_sum(const struct tile_rays *tile, const struct film_plan *plan, size_t begin,
                      size_t end, struct tile_room *room);

#endif
