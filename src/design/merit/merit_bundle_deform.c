/* design/merit/merit_bundle_deform.c - rays of a position through surfaces that are deformed. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_bundle.h"
#include "design/tolerance/linear_rays.h"

#include <string.h>

/* The part of a ray that moves: those of struct bent. */
static double *part(struct ray_block *block, int which)
{
    double *const of[LINEAR_RAYS_PARTS] = {block->x, block->y, block->p, block->q, block->path};
    return of[which];
}

/* Of the block that was traced last. */
static void deform(struct merit_bundle *bundle, struct bundle_block *block,
                   struct irregularity_weights *weights)
{
    const struct bundle_wish *wish = &bundle->wish;
    const struct bundle_light *light = &bundle->lights[block->light];
    const struct irregularity_sweep sweep = {&light->system, &light->layout, &bundle->work.tape,
                                             bundle->gradient};
    const size_t count = wish->irregularity_count, lanes = (size_t)block->aimed.lanes;
    struct ray_block adjoint;
    struct aimed_rates rates;
    for (size_t i = 0; i < count; i++) {
        irregularity_weigh(&wish->irregularities[i], &sweep, &weights[i]);
    }
    for (int which = 0; which < LINEAR_RAYS_PARTS; which++) {
        memset(&adjoint, 0, sizeof adjoint);
        for (int i = 0; i < block->aimed.lanes; i++) {
            part(&adjoint, which)[i] = 1;
        }
        aimed_sweep(&block->aimed, &light->layout, &adjoint, bundle->gradient, &rates);
        for (size_t i = 0; i < count; i++) {
            irregularity_gain(&wish->irregularities[i], &sweep, &weights[i],
                              block->deformed + ((size_t)which * count + i) * lanes);
        }
    }
}

bool merit_bundle_deform(struct merit_bundle *bundle, struct error *error)
{
    const size_t count = bundle->wish.irregularity_count;
    struct arena room = arena_within(&bundle->within);
    struct irregularity_weights *weights = ARENA_ARRAY(&room, count, struct irregularity_weights);
    for (size_t k = 0; k < bundle->block_count; k++) {
        struct bundle_block *block = &bundle->blocks[k];
        struct ray_block end;
        block->is_deformed = false;
        if (!merit_bundle_goes_on(bundle, (size_t)block->aimed.lanes, error) ||
            !merit_bundle_trace(bundle, k, true, &end, error)) {
            return false;
        }
        if (block->deformed == NULL) {
            block->deformed = ARENA_ARRAY(
                bundle->arena, LINEAR_RAYS_PARTS * count * (size_t)block->aimed.lanes, double);
        }
        deform(bundle, block, weights);
        block->is_deformed = true;
    }
    return true;
}
