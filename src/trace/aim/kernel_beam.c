/* trace/aim/kernel_beam.c - rays of a beam where they start: a lane loop for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/beam.h"
#include "trace/kernel/lanes.h"

/* All directions are alike. */
INLINE void start_far(const struct beam *beam, const double *restrict a, const double *restrict b,
                      size_t count, struct ray_block *restrict block)
{
    const double *u = beam->across[0], *v = beam->across[1];
    const double p = beam->n * beam->axis[0], q = beam->n * beam->axis[1];
    const double r = beam->n * beam->axis[2];
    for (size_t i = 0; i < count; i++) {
        block->x[i] = a[i] * u[0] + b[i] * v[0];
        block->y[i] = a[i] * u[1] + b[i] * v[1];
        block->z[i] = a[i] * u[2] + b[i] * v[2];
        block->p[i] = p;
        block->q[i] = q;
        block->r[i] = r;
        block->path[i] = 0;
        block->lost[i] = 0;
    }
}

/* From a point or towards one. */
INLINE void start_near(const struct beam *beam, const double *restrict a, const double *restrict b,
                       size_t count, struct ray_block *restrict block)
{
    const double *u = beam->across[0], *v = beam->across[1], *foot = beam->foot;
    const double d = fabs(beam->distance), sign = beam->distance > 0 ? 1 : -1, n = beam->n;
    const double along[3] = {d * beam->axis[0], d * beam->axis[1], d * beam->axis[2]};
    for (size_t i = 0; i < count; i++) {
        double x = a[i] * u[0] + b[i] * v[0], y = a[i] * u[1] + b[i] * v[1];
        double z = a[i] * u[2] + b[i] * v[2], r2 = a[i] * a[i] + b[i] * b[i];
        double length = sqrt(d * d + r2);
        block->x[i] = foot[0] + x;
        block->y[i] = foot[1] + y;
        block->z[i] = foot[2] + z;
        block->p[i] = n * ((along[0] + sign * x) / length);
        block->q[i] = n * ((along[1] + sign * y) / length);
        block->r[i] = n * ((along[2] + sign * z) / length);
        block->path[i] = sign * n * (r2 / (length + d));
        block->lost[i] = 0;
    }
}

void NAME(kernel_beam, KERNEL)(const struct beam *beam, const double *a, const double *b,
                               size_t count, struct ray_block *block)
{
    if (isinf(beam->distance)) {
        start_far(beam, a, b, count, block);
    } else {
        start_near(beam, a, b, count, block);
    }
}
