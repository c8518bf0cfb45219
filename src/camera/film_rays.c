/* camera/film_rays.c - the choice of instructions for camera/kernel_film.c. */
/* SPDX-License-Identifier: MIT */
#include "camera/film_rays.h"

void film_rays_plan(const struct film_plan *plan, uint32_t block, enum instruction_set set,
                    struct film_samples *samples)
{
    static kernel_film_plan *const kernels[] = {NULL, kernel_film_plan_sse2, kernel_film_plan_avx2,
                                                kernel_film_plan_avx512};
    kernels[instruction_set_best(set)](plan, block, samples);
}

void film_rays_cells(const struct film_plan *plan, const unsigned char cells[RAYS_BLOCK],
                     uint32_t block, enum instruction_set set, struct film_samples *samples)
{
    static kernel_film_cells *const kernels[] = {NULL, kernel_film_cells_sse2,
                                                 kernel_film_cells_avx2, kernel_film_cells_avx512};
    kernels[instruction_set_best(set)](plan, cells, block, samples);
}

void film_rays_start(const struct film_region *region, struct film_samples *samples,
                     enum instruction_set set, struct ray_block *block)
{
    static kernel_film *const kernels[] = {NULL, kernel_film_sse2, kernel_film_avx2,
                                           kernel_film_avx512};
    kernels[instruction_set_best(set)](region, samples, block);
}
