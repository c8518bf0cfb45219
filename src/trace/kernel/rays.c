/* trace/kernel/rays.c - filling and reading blocks of rays. */
/* SPDX-License-Identifier: MIT */
#include "trace/kernel/rays.h"

#include <assert.h>
#include <stdint.h>
#include <string.h>

/* The axis in lanes from one on. */
static void put_axis(struct ray_block *block, size_t from)
{
    double *const zeros[] = {block->x, block->y,    block->z,   block->p,
                             block->q, block->path, block->lost};
    for (size_t k = 0; k < sizeof zeros / sizeof zeros[0]; k++) {
        memset(zeros[k] + from, 0, (RAYS_BLOCK - from) * sizeof *zeros[k]);
    }
    for (size_t lane = from; lane < RAYS_BLOCK; lane++) {
        block->r[lane] = 1;
    }
}

struct rays rays_room(struct arena *arena, size_t count)
{
    const size_t blocks = (count + RAYS_BLOCK - 1) / RAYS_BLOCK, last = count % RAYS_BLOCK;
    /* the arena aligns to 16 only */
    enum { LINE = 64 };
    char *memory = arena_buffer(arena, blocks * sizeof(struct ray_block) + LINE);
    const size_t shift = (LINE - (uintptr_t)memory % LINE) % LINE;
    const struct rays rays = {(struct ray_block *)(void *)(memory + shift), count};
    if (last > 0) {
        put_axis(&rays.blocks[blocks - 1], last);
    }
    return rays;
}

struct rays rays_new(struct arena *arena, size_t count)
{
    const struct rays rays = rays_room(arena, count);
    for (size_t b = 0; b < rays_blocks(&rays); b++) {
        put_axis(&rays.blocks[b], 0);
    }
    return rays;
}

void rays_set(const struct rays *rays, size_t i, double n, const struct ray *ray)
{
    assert(i < rays->count);
    struct ray_block *block = &rays->blocks[i / RAYS_BLOCK];
    size_t lane = i % RAYS_BLOCK;
    block->x[lane] = ray->point[0];
    block->y[lane] = ray->point[1];
    block->z[lane] = ray->point[2];
    block->p[lane] = n * ray->cosine[0];
    block->q[lane] = n * ray->cosine[1];
    block->r[lane] = n * ray->cosine[2];
    block->path[lane] = ray->path;
    block->lost[lane] = ray->status == RAY_OK ? 0 : RAY_LOST_AT(0, ray->surface, ray->status);
}

struct ray rays_get(const struct rays *rays, size_t i, double n)
{
    assert(i < rays->count);
    const struct ray_block *block = &rays->blocks[i / RAYS_BLOCK];
    size_t lane = i % RAYS_BLOCK;
    return (struct ray){.point = {block->x[lane], block->y[lane], block->z[lane]},
                        .cosine = {block->p[lane] / n, block->q[lane] / n, block->r[lane] / n},
                        .path = block->path[lane],
                        .status = ray_block_status(block, lane),
                        .surface = ray_block_surface(block, lane)};
}

const char *ray_status_name(enum ray_status status)
{
    static const char names[][20] = {"ok", "miss", "total_reflection", "clipped", "not_converged"};
    return names[status];
}

void ray_block_copy(struct ray_block *to, const struct ray_block *from, size_t lanes)
{
    for (size_t i = 0; i < lanes; i++) {
        to->x[i] = from->x[i], to->y[i] = from->y[i], to->z[i] = from->z[i];
        to->p[i] = from->p[i], to->q[i] = from->q[i], to->r[i] = from->r[i];
        to->path[i] = from->path[i];
        to->lost[i] = from->lost[i];
    }
}
