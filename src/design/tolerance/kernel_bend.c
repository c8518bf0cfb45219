/* design/tolerance/kernel_bend.c - rays that are moved a little, for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/linear_rays.h"

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

/* Added to the change of one part of RAYS_FEW rays. */
static inline void change_of(const double *rows, size_t stride, const double *amounts, size_t count,
                             double change[RAYS_FEW])
{
    for (size_t i = 0; i < count; i++) {
        const double *restrict row = rows + i * stride;
        const double amount = amounts[i];
        if (amount == 0) { /* of a single error all others are */
            continue;
        }
        for (int l = 0; l < RAYS_FEW; l++) {
            change[l] += amount * row[l];
        }
    }
}

void NAMED(kernel_bend, KERNEL)(const double *rows, const double *amounts, size_t count, int lanes,
                                bool path, struct ray_block *end)
{
    const size_t stride = (size_t)lanes;
    for (int from = 0; from < lanes; from += RAYS_FEW) {
        double change[LINEAR_RAYS_PARTS][RAYS_FEW] = {{0}};
        for (size_t k = 0; k < (path ? LINEAR_RAYS_PARTS : LINEAR_RAYS_PARTS - 1); k++) {
            change_of(rows + k * count * stride + from, stride, amounts, count, change[k]);
        }
        for (int l = 0; l < RAYS_FEW; l++) {
            const int i = from + l;
            const double along = end->p[i] * change[2][l] + end->q[i] * change[3][l];
            end->x[i] += change[0][l];
            end->y[i] += change[1][l];
            end->r[i] -= along / end->r[i];
            end->p[i] += change[2][l];
            end->q[i] += change[3][l];
            end->path[i] += change[4][l];
        }
    }
}
