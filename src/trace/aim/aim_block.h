/* trace/aim/aim_block.h - the searches of trace/aim/aim for a block of rays, one array a number. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_AIM_BLOCK_H
#define LENSCALC_TRACE_AIM_AIM_BLOCK_H

#include "trace/aim/aim.h"
#include "trace/aim/sample.h"
#include "trace/dispatch.h"
#include "trace/kernel/rays.h"

#include <math.h>

/* Astray: a whole step leads nowhere nearer. The last step: only while a kernel works. */
enum aim_state { AIM_OPEN, AIM_DONE, AIM_ASTRAY, AIM_LAST };

struct aim_block {
    _Alignas(64) double goal_x[RAYS_BLOCK]; /* in the stop, mm */
    double goal_y[RAYS_BLOCK];
    double a[RAYS_BLOCK], b[RAYS_BLOCK];           /* as near as the search has come */
    double step_a[RAYS_BLOCK], step_b[RAYS_BLOCK]; /* what is tried next, from there .. */
    double next_a[RAYS_BLOCK], next_b[RAYS_BLOCK]; /* .. and where that leads */
    double miss_x[RAYS_BLOCK], miss_y[RAYS_BLOCK]; /* there */
    double m[4][RAYS_BLOCK];                       /* d(a, b)/d(x, y), row by row: an estimate */
    double state[RAYS_BLOCK];
    int lanes; /* the first so many are at work: as kernel_lanes says */
};

/*
 * What one step of all rays has brought.
 *
 * Given     at_stop        where rays from next_a, next_b cross the stop
 *           enough2, near2 squared misses: one that the next step is sure to leave, which is made
 *                          without looking; at rounding if a step brings no ray closer
 * Formula   the step is taken where it leads closer; m then takes the change of the miss to it
 *           (Broyden's rank-one correction, by Sherman and Morrison)
 */
typedef void kernel_aim(const struct ray_block *at_stop, double enough2, double near2,
                        struct aim_block *block);
kernel_aim kernel_aim_sse2, kernel_aim_avx2, kernel_aim_avx512;

/*
 * Where a point lies in the stop, mm. One on the very edge is taken a little within, so that the
 * stop lets it pass whichever way its last bits fall.
 */
static inline void aim_goal(const struct aim *aim, const struct pupil_point *point, double goal[2])
{
    const double on_edge = 1e-13, within = 1 - 2e-15;
    bool is_edge = fabs(point->x * point->x + point->y * point->y - 1) < on_edge;
    const double radius = aim->stop_radius * (is_edge ? within : 1);
    goal[0] = point->x * radius;
    goal[1] = point->y * radius;
}

/* How many rays are not done yet, but not astray. */
static inline size_t aim_block_open(const struct aim_block *block)
{
    size_t open = 0;
    for (int i = 0; i < block->lanes; i++) {
        open += block->state[i] == AIM_OPEN;
    }
    return open;
}

#endif
