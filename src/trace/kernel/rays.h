/* trace/kernel/rays.h - rays in blocks of 128, one array a coordinate. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_KERNEL_RAYS_H
#define LENSCALC_TRACE_KERNEL_RAYS_H

#include "base/arena.h"

#include <stddef.h>

/* Rays a block: seven arrays of it stay in the first-level cache. */
enum { RAYS_BLOCK = 128 };

/* So many at most are traced by kernels for a few, in a third of the time of a block or less. */
enum { RAYS_FEW = 16 };

enum ray_status { RAY_OK, RAY_MISS, RAY_TOTAL_REFLECTION, RAY_CLIPPED, RAY_NOT_CONVERGED };

/*
 * Points and directions, in the frame of the surface last met (before the first: of the first
 * vertex). Lanes that nobody uses may be traced too: rays_new fills them with the axis.
 *
 * What a lost ray holds after a trace: a clipped one goes on as if there were no clear aperture,
 * and has numbers if it arrives; every other one has NaN in all coordinates. A ray that is RAY_OK
 * never has a NaN or an infinity.
 */
struct ray_block {
    double x[RAYS_BLOCK]; /* mm */
    double y[RAYS_BLOCK], z[RAYS_BLOCK];
    double p[RAYS_BLOCK], q[RAYS_BLOCK], r[RAYS_BLOCK]; /* n times the direction cosines */
    double path[RAYS_BLOCK];                            /* optical path, mm; adds to what is here */
    double lost[RAYS_BLOCK]; /* 0 = on its way; else RAY_LOST_AT, larger the earlier it was */
};

/*
 * What `lost` says, a whole number: surface 1-based, place in the order of light from 0. A place
 * before another gives a larger number, so that kernels keep the first loss by a maximum.
 */
#define RAY_LOST_AT(place, surface, status)                                                        \
    ((1048576.0 - (double)(place)) * 1048576 + 8 * (double)(surface) + (double)(status))
#define RAY_LOST_PLACE(lost) (1048576 - (size_t)(lost) / 1048576)

/* Many rays: ray i is lane i % RAYS_BLOCK of block i / RAYS_BLOCK. */
struct rays {
    struct ray_block *blocks; /* aligned to 64 bytes by rays_new */
    size_t count;             /* of rays */
};

/* Room for `count` rays, all along the axis from the first vertex in a medium of index 1. */
struct rays rays_new(struct arena *arena, size_t count);

/* The same for who sets all of them before they are traced: they hold nothing yet. */
struct rays rays_room(struct arena *arena, size_t count);

/* How many blocks. */
static inline size_t rays_blocks(const struct rays *rays)
{
    return (rays->count + RAYS_BLOCK - 1) / RAYS_BLOCK;
}

/* One ray by itself: what is convenient outside of hot loops. */
struct ray {
    double point[3];  /* mm */
    double cosine[3]; /* direction cosines, unit length */
    double path;      /* mm */
    enum ray_status status;
    size_t surface; /* where it was lost, 1-based, the stop counted; 0 = nowhere */
};

/*
 * Put a ray in, take it out.
 *
 * Given     n  index of the medium the ray is in: system.index_first before a trace,
 *              system.index_last after it
 */
void rays_set(const struct rays *rays, size_t i, double n, const struct ray *ray);
struct ray rays_get(const struct rays *rays, size_t i, double n);

/* The first lanes of a block into those of another, whose further lanes stay good to trace. */
void ray_block_copy(struct ray_block *to, const struct ray_block *from, size_t lanes);

static inline enum ray_status ray_block_status(const struct ray_block *block, size_t lane)
{
    return (enum ray_status)((size_t)block->lost[lane] % 8);
}

static inline size_t ray_block_surface(const struct ray_block *block, size_t lane)
{
    return (size_t)block->lost[lane] % 1048576 / 8;
}

/* "ok", "miss", "total_reflection", "clipped", "not_converged" */
const char *ray_status_name(enum ray_status status);

#endif
