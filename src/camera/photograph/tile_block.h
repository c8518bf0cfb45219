/* camera/photograph/tile_block.h - a block of a tile's rays, on its way from the film to the light. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILE_BLOCK_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILE_BLOCK_H

#include "camera/photograph/tile_rays.h"

/* Start and trace a block of points of a plan, at a wavelength of the lens. */
void tile_block_trace(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      size_t wavelength, struct tile_room *room);

/* The light along a block of traced rays, in these lanes: room->light. */
void tile_block_look(const struct tile_rays *tile, uint32_t block, const struct lanes *lanes,
                     struct tile_room *room);

/* Does a ray arrive, from a lit place, taken by the pixel? */
static inline bool tile_block_arrives(const struct tile_room *room, size_t i)
{
    return room->samples.weight[i] > 0 && room->rays.blocks->lost[i] == 0;
}

/* Count a traced ray. */
static inline void tile_block_count(size_t i, struct tile_room *room)
{
    room->counts[PHOTOGRAPH_TRACED] += room->samples.weight[i] > 0;
    room->counts[PHOTOGRAPH_PASSED] += tile_block_arrives(room, i);
}

#endif
