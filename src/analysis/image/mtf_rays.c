/* analysis/image/mtf_rays.c - contrast by rays, as if light had no wavelength. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/mtf_rays.h"

#include "base/instruction_set.h"

#include <math.h>

enum { FIRST_RAYS = 200, LANES = MTF_RAYS_LANES };

/* The rays of one wavelength at the end of a level. */
static bool mtf_rays_add_light(const struct mtf_rays *rays, const struct wave_light *light,
                               size_t count, struct arena *arena, struct mtf_rays_level *level,
                               struct error *error)
{
    const double unit = wave_light_weight(light);
    struct bundle bundle;
    light->source.region->in_beam = false;
    if (!bundle_trace(&light->source, count, light->system->places, arena, &bundle, error)) {
        return false;
    }
    const size_t room = level->count + bundle.count + LANES;
    double *before[] = {level->places[0], level->places[1], level->weights};
    double **lists[] = {&level->places[0], &level->places[1], &level->weights};
    for (int k = 0; k < 3; k++) {
        *lists[k] = ARENA_ARRAY(arena, room, double);
        for (size_t i = 0; i < level->count; i++) {
            (*lists[k])[i] = before[k][i];
        }
    }
    for (size_t i = 0; i < bundle.count; i++) {
        const struct ray_block *block = &bundle.rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK;
        if (ray_block_status(block, lane) != RAY_OK) {
            continue;
        }
        const double off[2] = {block->x[lane] - rays->centre[0], block->y[lane] - rays->centre[1]};
        const double weight = unit * bundle.points[i].weight;
        for (int k = 0; k < 2; k++) {
            level->places[k][level->count] =
                off[0] * rays->along[k][0] + off[1] * rays->along[k][1];
        }
        level->weights[level->count++] = weight;
        level->light += weight;
    }
    level->count += (LANES - level->count % LANES) % LANES; /* these weigh 0 */
    return true;
}

/* Trace the next level. */
static bool mtf_rays_add_level(struct mtf_rays *rays, struct arena *arena, struct error *error)
{
    struct mtf_rays_level *level = &rays->levels[rays->count];
    *level = (struct mtf_rays_level){.count = 0};
    for (size_t g = 0; g < rays->lights.count; g++) {
        const struct wave_light *light = &rays->lights.list[g];
        if (light->weight > 0 && !mtf_rays_add_light(rays, light, (size_t)FIRST_RAYS << rays->count,
                                                     arena, level, error)) {
            return false;
        }
    }
    rays->count++;
    return true;
}

bool mtf_rays_find(struct mtf_rays *rays, double frequency, double wanted, struct arena *arena,
                   struct mtf_rays_sums *sums, struct error *error)
{
    *sums = (struct mtf_rays_sums){.error = INFINITY};
    for (size_t l = 0; l < MTF_RAYS_LEVELS && !sums->has_converged; l++) {
        if (l == rays->count && !mtf_rays_add_level(rays, arena, error)) {
            return false;
        }
        const struct mtf_rays_level *level = &rays->levels[l];
        double worst = 1e-12;
        for (int k = 0; k < 2; k++) {
            double sum[2] = {0};
            KERNEL_FOR(SET_BEST, kernel_mtf_rays)
            (level->places[k], level->weights, level->count, -frequency, sum);
            const double re = sum[0] / level->light, im = sum[1] / level->light;
            worst = fmax(worst, 2 * hypot(re - sums->re[k], im - sums->im[k]));
            sums->re[k] = re;
            sums->im[k] = im;
        }
        sums->error = l > 0 ? worst : INFINITY;
        sums->has_converged = sums->error <= wanted;
    }
    return true;
}
