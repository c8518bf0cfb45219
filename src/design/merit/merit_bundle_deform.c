/* design/merit/merit_bundle_deform.c - rays of a position through surfaces that are deformed. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_bundle.h"
#include "design/tolerance/bent.h"

#include <string.h>

/* The part of a ray that moves: those of struct bent. */
static double *part(struct ray_block *block, int which)
{
    double *const of[BENT_PARTS] = {block->x, block->y, block->p, block->q, block->path};
    return of[which];
}

bool merit_bundle_deform(struct merit_bundle *bundle, struct error *error)
{
    const struct bundle_wish *wish = &bundle->wish;
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct bundle_block *block = &bundle->blocks[k];
        const struct bundle_light *light = &bundle->lights[block->light];
        const struct irregularity_sweep sweep = {&light->system, &light->layout, &bundle->work.tape,
                                                 bundle->gradient};
        struct ray_block end, adjoint;
        struct aimed_rates rates;
        block->is_deformed = false;
        if (!merit_bundle_trace(bundle, k, true, &end, error)) {
            return false;
        }
        if (block->deformed == NULL) {
            block->deformed = ARENA_ARRAY(
                bundle->arena, BENT_PARTS * wish->irregularity_count * RAYS_BLOCK, double);
        }
        for (int which = 0; which < BENT_PARTS; which++) {
            memset(&adjoint, 0, sizeof adjoint);
            for (int i = 0; i < block->aimed.lanes; i++) {
                part(&adjoint, which)[i] = 1;
            }
            aimed_sweep(&block->aimed, &light->layout, &adjoint, bundle->gradient, &rates);
            for (size_t i = 0; i < wish->irregularity_count; i++) {
                irregularity_column(
                    &wish->irregularities[i], &sweep,
                    block->deformed + ((size_t)which * wish->irregularity_count + i) * RAYS_BLOCK);
            }
        }
        block->is_deformed = true;
    }
    return true;
}
