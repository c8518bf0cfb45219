/* design/merit/merit_front.c - a few real rays on their way from surface to surface. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_front.h"

#include "trace/dispatch.h"

struct merit_ray merit_front_ray(const struct merit_front *front, size_t i)
{
    const struct ray_block *block = &front->rays.blocks[i / RAYS_BLOCK];
    const size_t lane = i % RAYS_BLOCK;
    return (struct merit_ray){
        .at = {dual_of(block->x[lane]), dual_of(block->y[lane]), dual_of(block->z[lane])},
        .along = {dual_of(block->p[lane]), dual_of(block->q[lane]), dual_of(block->r[lane])}};
}

bool merit_front_lost(const struct merit_front *front, size_t i)
{
    return ray_block_status(&front->rays.blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) != RAY_OK;
}

bool merit_front_open(struct merit *merit, const struct merit_ray_question *question,
                      struct merit_ray *const *starts, size_t count, struct merit_front *front)
{
    const struct merit_place *place = &merit->places[question->slot->place];
    struct system_options options = system_options_default();
    options.stop_radius = 1; /* it limits nothing here */
    front->count = count;
    front->rays = rays_new(merit->arena, count);
    for (size_t i = 0; i < count; i++) {
        struct ray_block *block = &front->rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK;
        if (starts[i] == NULL) {
            block->lost[lane] = RAY_LOST_AT(0, 1, RAY_NOT_CONVERGED);
            continue;
        }
        block->x[lane] = starts[i]->at[0].value;
        block->y[lane] = starts[i]->at[1].value;
        block->z[lane] = starts[i]->at[2].value;
        block->p[lane] = starts[i]->along[0].value;
        block->q[lane] = starts[i]->along[1].value;
        block->r[lane] = starts[i]->along[2].value;
    }
    return system_compile(place->lens, question->light->wavelength, &options, merit->arena,
                          &front->system, &merit->why);
}

void merit_front_pass(struct merit_front *front, size_t surface)
{
    rays_trace_part(&front->system, surface, surface + 1, &front->rays, NULL);
}
