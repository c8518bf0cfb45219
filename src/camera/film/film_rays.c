/* camera/film/film_rays.c - the choice of instructions for camera/film/kernel_film.c. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/film_rays.h"

void film_rays_plan(const struct film_plan *plan, uint32_t block, enum instruction_set set,
                    struct film_samples *samples)
{
    KERNEL_FOR(set, kernel_film_plan)(plan, block, samples);
}

void film_rays_cells(const struct film_plan *plan, const unsigned char cells[RAYS_BLOCK],
                     uint32_t block, enum instruction_set set, struct film_samples *samples)
{
    KERNEL_FOR(set, kernel_film_cells)(plan, cells, block, samples);
}

void film_rays_start(const struct exit_pupil_bounds *region, struct film_samples *samples,
                     enum instruction_set set, struct ray_block *block)
{
    KERNEL_FOR(set, kernel_film)(region, samples, block);
}
