/* trace/pupil/clearances.c - rays looked at wherever something may end them. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/clearances.h"

#include "trace/dispatch.h"

#include <math.h>

static const struct clip *margin_clip_at(const struct system *system, size_t surface)
{
    return system->clips != NULL ? system->clips[surface] : NULL;
}

static bool are_plain(const struct system *system, const struct clearance *all, size_t count)
{
    bool plain = true;
    for (size_t k = 0; k < count; k++) {
        plain = plain && all[k].surface != LENS_NONE && all[k].clip == NULL &&
                system->lens->surfaces[all[k].surface].decentre == NULL;
    }
    return plain;
}

struct clearances clearances_open(const struct stop_beam *beam, struct arena *arena)
{
    const struct system *system = system_outer(beam->system);
    const size_t surfaces = system->lens->surface_count;
    const bool has_stop = !isnan(beam->radius);
    struct clearance *all = ARENA_ARRAY(arena, surfaces + 2, struct clearance);
    size_t count = 0;
    if (!has_stop) {
        all[count++] = (struct clearance){0, LENS_NONE, 1, NULL};
    }
    for (size_t place = 0; place < system->places; place++) {
        const size_t surface = system_surface(system, place);
        if (surface >= surfaces) {
            continue;
        }
        double clear = system_clear_radius(system, surface);
        if (has_stop && surface == system->stop) {
            clear = fmin(clear, beam->radius);
        }
        const struct clip *clip = margin_clip_at(system, surface);
        if (isfinite(clear) || clip != NULL) {
            all[count++] = (struct clearance){place + 1, surface, clear * clear, clip};
        }
    }
    double *rows = arena_buffer_array(arena, count + 2, RAYS_BLOCK * sizeof *rows);
    bool *counts = ARENA_ARRAY(arena, count + 1, bool);
    for (size_t k = 0; k < count; k++) {
        counts[k] = true;
    }
    return (struct clearances){.counts = counts,
                               .beam = beam,
                               .system = system,
                               .full = beam->system->outer != NULL ? beam->system : NULL,
                               .all = all,
                               .count = count,
                               .is_listed = beam->system->clips != NULL,
                               .work = rays_new(arena, RAYS_BLOCK),
                               .rows = rows,
                               .excess = rows + count * RAYS_BLOCK,
                               .limit = arena_buffer(arena, RAYS_BLOCK * sizeof(size_t)),
                               .numbers = rows + (count + 1) * RAYS_BLOCK,
                               .watches = ARENA_ARRAY(arena, count, struct rim_watch),
                               .is_mirrored = stop_beam_is_mirrored(beam),
                               .is_plain = are_plain(system, all, count)};
}

void clearances_narrow(const struct clearances *margins, size_t rays)
{
    const double near = -0.3;
    for (size_t k = 0; k < margins->count; k++) {
        double *row = margins->rows + k * RAYS_BLOCK;
        bool counts = false;
        for (size_t i = 0; i < rays; i++) {
            counts = counts || !(row[i] < near);
        }
        margins->counts[k] = counts;
        for (size_t i = 0; i < RAYS_BLOCK && !counts; i++) {
            row[i] = -1;
        }
    }
}

void clearances_widen(const struct clearances *margins)
{
    for (size_t k = 0; k < margins->count; k++) {
        margins->counts[k] = true;
    }
}

static void clearances_start_rays(const struct clearances *margins, const double (*points)[2],
                                  size_t count, struct ray_block *block)
{
    const struct stop_beam *beam = margins->beam;
    double a[RAYS_BLOCK], b[RAYS_BLOCK];
    for (size_t i = 0; i < count; i++) {
        double at[2];
        stop_beam_place(beam, points[i][0], points[i][1], at);
        a[i] = at[0];
        b[i] = at[1];
    }
    beam_start(beam->beam, a, b, count, block);
}

void clearances_start(const struct clearances *margins, const double (*points)[2],
                      const struct rays *rays)
{
    for (size_t done = 0; done < rays->count; done += RAYS_BLOCK) {
        size_t here = rays->count - done < RAYS_BLOCK ? rays->count - done : RAYS_BLOCK;
        clearances_start_rays(margins, points + done, here, &rays->blocks[done / RAYS_BLOCK]);
    }
}

void clearances_go(const struct clearances *margins, const double (*points)[2], size_t count,
                   size_t to)
{
    const struct rays rays = {margins->work.blocks, count};
    clearances_start_rays(margins, points, count, margins->work.blocks);
    if (to > 0) {
        rays_trace_part(margins->system, 0, to, &rays, NULL);
    }
}

/* Where ray i of a block meets a surface, in its own frame. */
static void ray_at_surface(const struct system *system, const struct ray_block *block,
                           size_t surface, size_t i, double point[3])
{
    point[0] = block->x[i];
    point[1] = block->y[i];
    point[2] = block->z[i];
    if (system->lens->surfaces[surface].decentre != NULL) {
        system_to_own(system, surface, point);
    }
}

void clearances_cross(const struct clearances *margins, size_t surface, size_t i, double point[3])
{
    ray_at_surface(margins->system, margins->work.blocks, surface, i, point);
}

/* Row k; `from`: the place that the rays have come to. */
static void clearances_trace_row(const struct clearances *margins, const double (*points)[2],
                                 size_t count, size_t k, size_t *from)
{
    const struct rays rays = {margins->work.blocks, count};
    const struct clearance *margin = &margins->all[k];
    double *row = margins->rows + k * RAYS_BLOCK;
    if (margin->surface == LENS_NONE) {
        for (size_t i = 0; i < count; i++) {
            row[i] = points[i][0] * points[i][0] + points[i][1] * points[i][1] - 1;
        }
        return;
    }
    rays_trace_part(margins->system, *from, margin->place, &rays, NULL);
    *from = margin->place;
    /* one row, of rays that stand on the surface */
    const struct ray_block *block = margins->work.blocks;
    const double over = 1 / margin->clear2;
    if (margin->clip == NULL && margins->system->lens->surfaces[margin->surface].decentre == NULL) {
        for (size_t i = 0; i < count; i++) {
            row[i] = (block->x[i] * block->x[i] + block->y[i] * block->y[i]) * over - 1;
        }
        return;
    }
    for (size_t i = 0; i < count; i++) {
        double point[3];
        clearances_cross(margins, margin->surface, i, point);
        row[i] = (point[0] * point[0] + point[1] * point[1]) * over - 1;
        if (margin->clip != NULL) {
            double listed = clip_excess(margin->clip, point[0], point[1], NULL);
            row[i] = listed > row[i] ? listed : row[i];
        }
    }
}

/* Those that do not arrive: their excess, and where they are lost. */
static void clearances_mark_lost(const struct clearances *margins, size_t count)
{
    const struct ray_block *block = margins->work.blocks;
    for (size_t i = 0; i < count; i++) {
        enum ray_status status = ray_block_status(block, i);
        bool arrives = isfinite(block->x[i]) && isfinite(block->y[i]);
        if (!arrives || (status != RAY_OK && status != RAY_CLIPPED)) {
            margins->excess[i] = INFINITY;
            margins->limit[i] = ((size_t)1 << 32) + 8 * ray_block_surface(block, i) + status;
        }
    }
}

/* To the end, and the worst of all rows. */
static void clearances_finish(const struct clearances *margins, size_t count, size_t from)
{
    const struct system *system = margins->system;
    const struct rays rays = {margins->work.blocks, count};
    if (from < system->places) {
        rays_trace_part(system, from, system->places, &rays, NULL);
    }
    /* the worst of all rows */
    double *excess = margins->excess;
    size_t *limit = margins->limit;
    for (size_t i = 0; i < count; i++) {
        excess[i] = -1;
        limit[i] = 0;
    }
    for (size_t k = 0; k < margins->count; k++) {
        const double *row = margins->rows + k * RAYS_BLOCK;
        for (size_t i = 0; i < count; i++) {
            bool more = row[i] > excess[i];
            excess[i] = more ? row[i] : excess[i];
            limit[i] = more ? k : limit[i];
        }
    }
    clearances_mark_lost(margins, count);
}

void clearances_look(const struct clearances *margins, const double (*points)[2], size_t count)
{
    size_t from = 0;
    clearances_start_rays(margins, points, count, margins->work.blocks);
    if (margins->is_plain) {
        /* all rows on one way */
        const struct system *system = margins->system;
        const struct rays rays = {margins->work.blocks, count};
        struct rim_watch_request watching = {margins->watches, 0, margins->excess,
                                             margins->numbers};
        for (size_t k = 0; k < margins->count; k++) {
            const struct clearance *margin = &margins->all[k];
            if (margins->counts[k]) {
                margins->watches[watching.count++] =
                    (struct rim_watch){system->begin[margin->place] - 1, 1 / margin->clear2,
                                       (double)k, margins->rows + k * RAYS_BLOCK};
            }
        }
        rays_watch(system, &rays, &watching);
        for (size_t i = 0; i < count; i++) {
            margins->limit[i] = (size_t)margins->numbers[i];
        }
        /* what rays would have on surfaces behind one that they miss is no number */
        const struct ray_block *block = margins->work.blocks;
        for (size_t i = 0; i < count; i++) {
            if (block->lost[i] == 0 || ray_block_status(block, i) == RAY_CLIPPED) {
                continue;
            }
            const size_t place = RAY_LOST_PLACE(block->lost[i]);
            for (size_t k = 0; k < margins->count; k++) {
                if (margins->counts[k] && margins->all[k].place > place) {
                    margins->rows[k * RAYS_BLOCK + i] = NAN;
                }
            }
        }
        clearances_mark_lost(margins, count);
        return;
    }
    for (size_t k = 0; k < margins->count; k++) {
        if (margins->counts[k]) {
            clearances_trace_row(margins, points, count, k, &from);
        }
    }
    clearances_finish(margins, count, from);
}

void clearances_sift(const struct clearances *margins, const double (*points)[2], size_t count)
{
    bool dark[RAYS_BLOCK] = {false};
    size_t from = 0;
    clearances_start_rays(margins, points, count, margins->work.blocks);
    for (size_t k = 0; k < margins->count; k++) {
        clearances_trace_row(margins, points, count, k, &from);
        /* are there rays that this row lets pass, among those that came so far? */
        const double *row = margins->rows + k * RAYS_BLOCK;
        bool some = false;
        for (size_t i = 0; i < count; i++) {
            /* a lost ray has no number */
            dark[i] = dark[i] | !(row[i] <= 0);
            some = some | !dark[i];
        }
        if (!some) {
            for (size_t i = 0; i < count; i++) {
                margins->excess[i] = INFINITY;
            }
            return;
        }
    }
    clearances_finish(margins, count, from);
}

void clearances_parts(const struct clearances *margins, const double (*at)[2], size_t count,
                      const size_t *surfaces, size_t *parts)
{
    const struct rays rays = {margins->work.blocks, count};
    size_t from = 0;
    beam_fill(margins->beam->beam, at, count, rays.blocks);
    for (size_t i = 0; i < count; i++) {
        parts[i] = 0;
    }
    for (size_t k = 0; k < margins->count; k++) {
        const struct clearance *margin = &margins->all[k];
        if (margin->clip == NULL) {
            continue;
        }
        rays_trace_part(margins->system, from, margin->place, &rays, NULL);
        from = margin->place;
        for (size_t i = 0; i < count; i++) {
            double point[3];
            size_t part = 0;
            if (surfaces[i] != margin->surface) {
                continue;
            }
            clearances_cross(margins, margin->surface, i, point);
            const double square = point[0] * point[0] + point[1] * point[1];
            const double listed = clip_excess(margin->clip, point[0], point[1], &part);
            parts[i] = listed > square / margin->clear2 - 1 ? part : 0;
        }
    }
}

void clearances_depth(const struct clearances *margins, const double (*at)[2], size_t count,
                      double *depth, size_t *part)
{
    const struct system *system = margins->full;
    const struct ray_block *block = margins->work.blocks;
    const struct rays rays = {margins->work.blocks, count};
    beam_fill(margins->beam->beam, at, count, rays.blocks);
    for (size_t i = 0; i < count; i++) {
        depth[i] = -INFINITY;
        part[i] = 0;
    }
    for (size_t place = 0; place < system->places; place++) {
        const size_t surface = system_surface(system, place);
        const struct clip *clip =
            surface < system->lens->surface_count ? margin_clip_at(system, surface) : NULL;
        rays_trace_part(system, place, place + 1, &rays, NULL);
        for (size_t i = 0; i < count && clip != NULL && clip->inner_count > 0; i++) {
            double point[3];
            size_t piece = 0;
            ray_at_surface(system, block, surface, i, point);
            const double here = clip_depth(clip, point[0], point[1], &piece);
            if (here > depth[i]) {
                depth[i] = here;
                part[i] = (surface + 1) * 1048576 + piece;
            }
        }
    }
}
