/* camera/film/kernel_disc.c - rays through a disc: a lane loop for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/disc_rays.h"
#include "trace/kernel/lanes.h"

/* Own copies, which the compiler knows to lie apart from all tables. */
struct kernel_disc_aimed {
    double p[RAYS_BLOCK], q[RAYS_BLOCK], r[RAYS_BLOCK], weight[RAYS_BLOCK];
};

INLINE void kernel_disc_aim(const struct disc *disc, const struct film_samples *samples,
                            struct kernel_disc_aimed *aimed, int i)
{
    double x = samples->x[i], y = samples->y[i], h = sqrt(x * x + y * y), over = 1 / h;
    bool beside = h > 0;
    double up_x = beside ? x * over : 0, up_y = beside ? y * over : 1;
    double sectors = samples->u[i] * DISC_SECTORS, t = sqrt(samples->v[i]);
    int k = (int)sectors;
    k = k < DISC_SECTORS - 1 ? k : DISC_SECTORS - 1;
    const double *from = disc->corners[k], *to = disc->corners[k + 1];
    double w = sectors - k;
    double right = t * (from[0] + w * (to[0] - from[0]));
    double up = t * (from[1] + w * (to[1] - from[1]));
    double dx = right * up_y + up * up_x - x, dy = up * up_y - right * up_x - y;
    double z = disc->place - disc->film, p2 = dx * dx + dy * dy + z * z;
    /* towards the lens, also where the pupil lies on the other side of the film */
    double n = (disc->film * z > 0 ? -disc->index : disc->index) / sqrt(p2);
    aimed->p[i] = dx * n;
    aimed->q[i] = dy * n;
    aimed->r[i] = z * n;
    aimed->weight[i] = disc->area * (z * z) / (p2 * p2);
}

void NAME(kernel_disc, KERNEL)(const struct disc *disc, struct film_samples *samples,
                               struct ray_block *block)
{
    struct kernel_disc_aimed aimed;
    for (int i = 0; i < RAYS_BLOCK; i++) {
        kernel_disc_aim(disc, samples, &aimed, i);
    }
    memcpy(block->x, samples->x, sizeof block->x);
    memcpy(block->y, samples->y, sizeof block->y);
    memcpy(block->p, aimed.p, sizeof block->p);
    memcpy(block->q, aimed.q, sizeof block->q);
    memcpy(block->r, aimed.r, sizeof block->r);
    memcpy(samples->weight, aimed.weight, sizeof samples->weight);
    for (int i = 0; i < RAYS_BLOCK; i++) {
        block->z[i] = disc->film;
        block->path[i] = 0;
        block->lost[i] = 0;
    }
}
