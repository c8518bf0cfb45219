/* design/merit_bundle_deform.c - rays of a position through surfaces that are deformed. */
/* SPDX-License-Identifier: MIT */
#include "design/merit_bundle.h"

#include <math.h>
#include <string.h>

/* What deformations move: of the final ray x, y, p, q and its path. */
enum { MOVED = 5 };

static double *moved(struct ray_block *block, int which)
{
    double *const of[MOVED] = {block->x, block->y, block->p, block->q, block->path};
    return of[which];
}

static double *rows_of(const struct bundle_wish *wish, const struct bundle_block *block, int which)
{
    return block->deformed + (size_t)which * wish->irregularity_count * RAYS_BLOCK;
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
            block->deformed =
                ARENA_ARRAY(bundle->arena, MOVED * wish->irregularity_count * RAYS_BLOCK, double);
        }
        for (int which = 0; which < MOVED; which++) {
            memset(&adjoint, 0, sizeof adjoint);
            for (int i = 0; i < block->aimed.lanes; i++) {
                moved(&adjoint, which)[i] = 1;
            }
            aimed_sweep(&block->aimed, &light->layout, &adjoint, bundle->gradient, &rates);
            for (size_t i = 0; i < wish->irregularity_count; i++) {
                irregularity_column(&wish->irregularities[i], &sweep,
                                    rows_of(wish, block, which) + i * RAYS_BLOCK);
            }
        }
        block->is_deformed = true;
    }
    return true;
}

void merit_bundle_bend(const struct merit_bundle *bundle, const struct bundle_block *block,
                       struct ray_block *end)
{
    const struct bundle_wish *wish = &bundle->wish;
    const double *amounts = wish->irregularity_amounts;
    const int lanes = block->aimed.lanes;
    double change[MOVED][RAYS_BLOCK];
    memset(change, 0, sizeof change);
    for (int which = 0; which < MOVED; which++) {
        for (size_t i = 0; i < wish->irregularity_count; i++) {
            const double *restrict row = rows_of(wish, block, which) + i * RAYS_BLOCK;
            const double amount = amounts[i];
            for (int l = 0; amount != 0 && l < lanes; l++) {
                change[which][l] += amount * row[l];
            }
        }
    }
    for (int l = 0; l < lanes; l++) { /* p keeps its length */
        const double dp = change[2][l], dq = change[3][l], p = end->p[l], q = end->q[l];
        end->r[l] -= (p * dp + q * dq) / end->r[l];
    }
    for (int which = 0; which < MOVED; which++) {
        double *to = moved(end, which);
        for (int l = 0; l < lanes; l++) {
            to[l] += change[which][l];
        }
    }
}
