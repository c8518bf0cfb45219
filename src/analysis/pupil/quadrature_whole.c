/* analysis/pupil/quadrature_whole.c - rays aimed at Gauss's points of a whole stop. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/quadrature_whole.h"

#include "trace/aim/aim_block.h"
#include "trace/aim/beam.h"

#include <math.h>

/* Points of the whole pupil at work: their rays' coordinates in the beam. */
struct whole_pupil_points {
    const struct clearances *margins;
    double *a, *b; /* mm */
};

/* From the rays that would go to the points of a stop without aberrations. */
static void start_block(const struct stop_beam *beam, const struct pupil_point *points,
                        size_t count, struct aim_block *block)
{
    const double radius = beam->radius, *axes = beam->axes;
    const size_t lanes = (size_t)kernel_lanes(count);
    block->lanes = (int)lanes;
    for (size_t i = 0; i < lanes; i++) {
        const struct pupil_point *point = &points[i < count ? i : 0];
        block->goal_x[i] = point->x * radius;
        block->goal_y[i] = point->y * radius;
        block->a[i] = beam->origin[0] + point->x * axes[0] + point->y * axes[1];
        block->b[i] = beam->origin[1] + point->x * axes[2] + point->y * axes[3];
        block->state[i] = i < count ? AIM_OPEN : AIM_DONE;
    }
    for (size_t i = 0; i < lanes; i++) {
        block->next_a[i] = block->a[i];
        block->next_b[i] = block->b[i];
        block->step_a[i] = block->step_b[i] = 0;
        /* more than aberrations can be */
        block->miss_x[i] = block->miss_y[i] = 4 * radius;
    }
    for (size_t k = 0; k < 4; k++) {
        const double share = axes[k] / radius;
        for (size_t i = 0; i < lanes; i++) {
            block->m[k][i] = share;
        }
    }
}

/* On its way to a point of the stop a ray may cross it beyond its edge: it is not lost by that. */
static void keep_clipped(struct ray_block *block, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (block->lost[i] != 0 && ray_block_status(block, i) == RAY_CLIPPED) {
            block->lost[i] = 0;
        }
    }
}

/* The rays that stand in front of the stop, in its own frame. */
static void quadrature_whole_to_own(const struct clearances *margins, size_t count)
{
    const struct system *system = margins->system;
    for (size_t i = 0; i < count && system->lens->surfaces[system->stop].decentre != NULL; i++) {
        double point[3];
        clearances_cross(margins, system->stop, i, point);
        margins->work.blocks->x[i] = point[0];
        margins->work.blocks->y[i] = point[1];
    }
}

/* Up to 128 rays to their points of the stop; receives their places, and renames the points. */
static bool aim_points(const struct whole_pupil_points *placing, size_t done,
                       struct pupil_point *points, size_t count)
{
    enum { STEPS = 12 };
    const struct clearances *margins = placing->margins;
    const struct system *system = margins->system;
    const double radius = margins->beam->radius, enough = 1e-12 * radius;
    const struct rays rays = {margins->work.blocks, count};
    struct aim_block block;
    size_t open = count;
    start_block(margins->beam, points, count, &block);
    for (int step = 0; step < STEPS && open > 0; step++) {
        beam_start(margins->beam->beam, block.next_a, block.next_b, count, rays.blocks);
        rays_trace_part(system, 0, system_place(system, system->stop) + 1, &rays, NULL);
        keep_clipped(rays.blocks, count);
        quadrature_whole_to_own(margins, count);
        KERNEL_FOR(SET_BEST, kernel_aim)(rays.blocks, enough * enough, enough * enough, &block);
        open = aim_block_open(&block);
    }
    bool found = open == 0;
    for (size_t i = 0; i < count; i++) {
        found = found && block.state[i] == AIM_DONE;
        placing->a[done + i] = block.a[i];
        placing->b[done + i] = block.b[i];
        points[i].x = (block.goal_x[i] - block.miss_x[i]) / radius;
        points[i].y = (block.goal_y[i] - block.miss_y[i]) / radius;
    }
    return found;
}

/* All of them, in blocks. */
static bool quadrature_whole_aim_all(const struct whole_pupil_points *placing,
                                     struct pupil_point *points, size_t count)
{
    bool found = true;
    for (size_t done = 0; done < count && found; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        found = aim_points(placing, done, points + done, here);
    }
    return found;
}

/* The arms on one side; the others mirror them: arm k is arm `arms` - k, and arm 0 its own. */
static bool aim_half(const struct whole_pupil_points *placing, struct pupil_point *points,
                     size_t arms, size_t rings, struct arena *arena)
{
    const size_t half = (arms + 1) / 2, count = rings * half;
    const struct whole_pupil_points part = {placing->margins, ARENA_ARRAY(arena, count, double),
                                            ARENA_ARRAY(arena, count, double)};
    struct pupil_point *own = ARENA_ARRAY(arena, count, struct pupil_point);
    for (size_t i = 0; i < count; i++) {
        own[i] = points[i / half * arms + i % half];
    }
    if (!quadrature_whole_aim_all(&part, own, count)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t k = i % half, here = i / half * arms + k;
        const size_t there = k > 0 ? here - k + arms - k : here;
        points[there] = own[i];
        points[there].x = -own[i].x;
        placing->a[there] = -part.a[i];
        placing->b[there] = part.b[i];
        points[here] = own[i];
        placing->a[here] = part.a[i];
        placing->b[here] = part.b[i];
    }
    return true;
}

/* Does the outermost ring go around once, the way the points do, and arrive? */
static bool quadrature_whole_is_sound(const struct whole_pupil_points *placing, double turn,
                                      size_t first, size_t count)
{
    const struct clearances *margins = placing->margins;
    const struct stop_beam *beam = margins->beam;
    struct ray_block *block = margins->work.blocks;
    const double *a = placing->a + first, *b = placing->b + first;
    double centre[2];
    stop_beam_place(beam, 0, 0, centre);
    bool sound = true;
    for (size_t done = 0; done < count && sound; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        const struct rays rays = {block, here};
        beam_start(beam->beam, a + done, b + done, here, block);
        rays_trace(margins->system, &rays, NULL);
        for (size_t i = 0; i < here; i++) {
            const size_t k = done + i, next = (k + 1) % count;
            /* angles count from v towards u */
            double cross = (b[k] - centre[1]) * (a[next] - centre[0]) -
                           (a[k] - centre[0]) * (b[next] - centre[1]);
            sound = sound && turn * cross > 0 && ray_block_status(block, i) == RAY_OK;
        }
    }
    return sound;
}

/* Points of a disc: no ray has to be aimed. */
static void quadrature_whole_place_points(const struct whole_pupil_points *placing,
                                          struct pupil_point *points, size_t count)
{
    const struct stop_beam *beam = placing->margins->beam;
    for (size_t i = 0; i < count; i++) {
        double at[2];
        stop_beam_place(beam, points[i].x, points[i].y, at);
        placing->a[i] = at[0];
        placing->b[i] = at[1];
        points[i].weight *=
            beam->weight == WEIGHT_BEAM ? stop_beam_density(beam, points[i].x, points[i].y) : 1;
    }
}

/* Which way around in the beam's plane a disc goes: +1 as in u and v. */
static double quadrature_whole_turn_of(const struct stop_beam *beam)
{
    double at[3][2];
    stop_beam_place(beam, 0, 0, at[0]);
    stop_beam_place(beam, 1, 0, at[1]);
    stop_beam_place(beam, 0, 1, at[2]);
    return (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
           (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]);
}

bool quadrature_whole(const struct clearances *margins, size_t rays, struct arena *arena,
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
    const struct whole_pupil_points placing = {margins, ARENA_ARRAY(arena, count, double),
                                               ARENA_ARRAY(arena, count, double)};
    size_t arms = 1;
    while (arms * (arms - 1) / 2 < count) {
        arms += 2;
    }
    bool found = true;
    if (is_disc) {
        quadrature_whole_place_points(&placing, all->sample.points, count);
    } else if (stop_beam_is_mirrored(beam)) {
        found = aim_half(&placing, all->sample.points, arms, count / arms, arena);
    } else {
        found = quadrature_whole_aim_all(&placing, all->sample.points, count);
    }
    if (!found ||
        !quadrature_whole_is_sound(&placing, quadrature_whole_turn_of(beam), count - arms, arms)) {
        return false;
    }
    all->arms = arms;
    all->rings = count / arms;
    all->rays = rays_room(arena, count);
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        beam_start(beam->beam, placing.a + done, placing.b + done, here,
                   &all->rays.blocks[done / RAYS_BLOCK]);
    }
    return true;
}
