/* analysis/quadrature_whole.c - rays aimed at Gauss's points of a whole stop. */
/* SPDX-License-Identifier: MIT */
#include "analysis/quadrature_whole.h"

#include "trace/aim_block.h"

#include <math.h>

/* From u, v that would be the points of a stop without aberrations. */
static void start_block(const struct pupil_point *points, size_t count, double radius,
                        struct aim_block *block)
{
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const struct pupil_point *point = &points[i < count ? i : 0];
        block->goal_x[i] = point->x * radius;
        block->goal_y[i] = point->y * radius;
        block->a[i] = point->x;
        block->b[i] = point->y;
        block->step_a[i] = block->step_b[i] = 0;
        block->miss_x[i] = block->miss_y[i] = INFINITY;
        block->m[0][i] = block->m[3][i] = 1 / radius;
        block->m[1][i] = block->m[2][i] = 0;
        block->state[i] = AIM_OPEN;
    }
}

/* Up to 128 rays to their points of the stop; receives u and v, and renames the points. */
static bool aim_points(const struct margins *margins, struct pupil_point *points, size_t count,
                       double (*at)[2])
{
    enum { STEPS = 12 };
    const struct system *system = margins->system;
    const double radius = margins->beam->radius, enough = 1e-10 * radius;
    struct aim_block block;
    size_t open = count;
    start_block(points, count, radius, &block);
    for (int step = 0; step < STEPS && open > 0; step++) {
        for (size_t i = 0; i < count; i++) {
            at[i][0] = block.a[i] + block.step_a[i];
            at[i][1] = block.b[i] + block.step_b[i];
        }
        margins_go(margins, (const double(*)[2])at, count, system_place(system, system->stop) + 1);
        for (size_t i = 0; i < count; i++) {
            /* on its way to a point of the stop a ray may cross it beyond its edge */
            bool is_clipped = ray_block_status(margins->work.blocks, i) == RAY_CLIPPED;
            margins->work.blocks->lost[i] = is_clipped ? 0 : margins->work.blocks->lost[i];
        }
        for (size_t i = 0; i < count && system->lens->surfaces[system->stop].decentre != NULL;
             i++) {
            double point[3];
            margins_cross(margins, system->stop, i, point);
            margins->work.blocks->x[i] = point[0];
            margins->work.blocks->y[i] = point[1];
        }
        dispatch_aim(SET_BEST)(margins->work.blocks, enough * enough, enough * enough, &block);
        open = 0;
        for (size_t i = 0; i < count; i++) {
            open += block.state[i] != AIM_DONE;
            if (block.state[i] == AIM_ASTRAY) {
                return false;
            }
        }
    }
    for (size_t i = 0; i < count; i++) {
        at[i][0] = block.a[i];
        at[i][1] = block.b[i];
        points[i].x = (block.goal_x[i] - block.miss_x[i]) / radius;
        points[i].y = (block.goal_y[i] - block.miss_y[i]) / radius;
    }
    return open == 0;
}

/* Does the outermost ring go around once, the way the points do, and arrive? */
static bool is_sound(const struct margins *margins, const double (*ring)[2], size_t count)
{
    const struct ray_block *block = margins->work.blocks;
    bool sound = true;
    for (size_t done = 0; done < count && sound; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        margins_go(margins, ring + done, here, margins->system->places);
        for (size_t i = 0; i < here; i++) {
            const double *from = ring[done + i], *to = ring[(done + i + 1) % count];
            /* angles count from v towards u */
            bool turns = from[1] * to[0] - from[0] * to[1] > 0;
            sound = sound && turns && ray_block_status(block, i) == RAY_OK;
        }
    }
    return sound;
}

bool quadrature_whole(const struct margins *margins, size_t rays, struct arena *arena,
                      struct quadrature *all)
{
    const struct stop_beam *beam = margins->beam;
    const bool is_disc = margins->all[0].surface == LENS_NONE;
    struct error ignored;
    *all = (struct quadrature){.is_empty = false};
    if (margins->count != 1 || margins->is_listed || !(is_disc || beam->weight == WEIGHT_PUPIL) ||
        !sample_make(PATTERN_GAUSS, rays, 0, arena, &all->sample, &ignored)) {
        return false;
    }
    const size_t count = all->sample.count;
    size_t arms = 1;
    double(*at)[2] = arena_array(arena, count, sizeof *at);
    while (arms * (arms - 1) / 2 < count) {
        arms += 2;
    }
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        struct pupil_point *points = all->sample.points + done;
        for (size_t i = 0; i < here; i++) {
            at[done + i][0] = points[i].x;
            at[done + i][1] = points[i].y;
            points[i].weight *=
                beam->weight == WEIGHT_BEAM ? stop_beam_density(beam, points[i].x, points[i].y) : 1;
        }
        if (!is_disc && !aim_points(margins, points, here, at + done)) {
            return false;
        }
    }
    if (!is_sound(margins, (const double(*)[2])at + count - arms, arms)) {
        return false;
    }
    all->rays = rays_new(arena, count);
    margins_start(margins, (const double(*)[2])at, &all->rays);
    return true;
}
