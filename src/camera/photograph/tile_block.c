/* camera/photograph/tile_block.c - blocks of rays of a tile: traced, timed and looked along. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tile_block.h"

void tile_block_trace(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      size_t wavelength, struct tile_room *room)
{
    if (tile->in_strands) {
        film_rays_cells(plan, room->cells, block, SET_BEST, &room->samples);
    } else {
        film_rays_plan(plan, block, SET_BEST, &room->samples);
    }
    lens_film_start(tile->film, &room->samples, room->rays.blocks);
    lens_film_trace(tile->film, wavelength, &room->samples, &room->rays);
}

/* When the rays of a block come: evenly within the time that each has, the middle of all at 0. */
static void tile_block_time_rays(const struct tile_rays *tile, uint32_t block,
                                 struct tile_room *room)
{
    const double duration = tile->duration;
    if (duration > 0) {
        sobol_points(&tile->when, room->when, block, room->times);
        const double *begin = room->samples.begin, *end = room->samples.end;
        const bool is_shut = tile->film->shutter != NULL;
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            room->times[i] = is_shut ? begin[i] + room->times[i] * (end[i] - begin[i])
                                     : duration * (room->times[i] - 0.5);
        }
    }
}

void tile_block_look(const struct tile_rays *tile, uint32_t block, const struct lanes *lanes,
                     struct tile_room *room)
{
    tile_block_time_rays(tile, block, room);
    const struct subject_rays rays = {.block = room->rays.blocks,
                                      .weights = room->samples.weight,
                                      .times = room->times,
                                      .lanes = lanes,
                                      .sequence = &room->sequence,
                                      .number = block};
    tile->subject.look(&tile->subject, &rays, room->counts, room->light);
}
