/* trace/pupil/pupil_islands.c - patches that are dark for sure; where some are not, a grid. */
/* SPDX-License-Identifier: MIT */
#include "trace/pupil/pupil_islands.h"

#include "base/constants.h"
#include "trace/pupil/pupil_parts.h"

#include <math.h>

/* Rays of a patch; patches that are looked at together; sectors about it, but for corners. */
enum { SIDE = 3, EACH = SIDE * SIDE, AT_ONCE = RAYS_BLOCK / EACH, SECTORS = 12 };

/* At first: patches of a sector. */
enum { RINGS = 2 };

/* So many patches would cost half of what the grid does. */
enum { CELLS = PUPIL_PARTS_SIDE * PUPIL_PARTS_SIDE, MOST = CELLS / EACH / 2 };

/* A piece of what lies beyond the edge: angles, rad, and shares of the way from there outwards. */
struct island_patch {
    double low[2], high[2];
};

/* The patches that have to be looked at, those that have been in front. */
struct patches {
    const struct clearances *margins;
    const struct pupil_boundary *boundary;
    double low[2], high[2]; /* bounds in u and v */
    double farthest;        /* radius beyond which nothing is looked for */
    double finest[2];       /* in u and v: finer than this only the grid would not look either */
    struct island_patch list[MOST];
    size_t count;
};

static void patches_add(struct patches *all, double angle, double width, double low, double high)
{
    if (all->count < MOST) {
        all->list[all->count] = (struct island_patch){{angle, low}, {angle + width, high}};
    }
    all->count++;
}

/* Sectors between two angles. */
static void add_sectors(struct patches *all, double from, double to)
{
    const double widest = 2 * PI / SECTORS, nearby = 0.25;
    const size_t sectors = (size_t)ceil((to - from) / widest);
    const double width = (to - from) / (double)sectors;
    for (size_t k = 0; k < sectors; k++) {
        for (size_t ring = 0; ring < RINGS; ring++) {
            patches_add(all, from + (double)k * width, width, ring == 0 ? 0 : nearby,
                        ring == 0 ? nearby : 1);
        }
    }
}

static void place_rays(const struct patches *all, const struct island_patch *patch,
                       double (*points)[2])
{
    const struct edge_frame *frame = &all->boundary->frame;
    const double low = patch->low[1], high = patch->high[1];
    const double ways[SIDE] = {low, (low + high) / 2, high};
    for (size_t arm = 0; arm < SIDE; arm++, points += SIDE) {
        const double share = (double)arm / (SIDE - 1);
        const double angle = patch->low[0] + share * (patch->high[0] - patch->low[0]);
        const double edge = pupil_boundary_near(all->boundary, angle);
        double unit[2];
        edge_point(frame, angle, 1, unit);
        for (size_t i = 0; i < SIDE; i++) {
            const double radius = edge + ways[i] * (all->farthest - edge);
            for (int k = 0; k < 2; k++) {
                points[i][k] = frame->centre[k] + radius * (unit[k] - frame->centre[k]);
            }
        }
    }
}

/* A patch that was looked at, and which rays of the block are its own. */
struct traced_patch {
    const struct patches *all;
    struct island_patch patch;
    const double (*points)[2]; /* of the block */
    size_t first;              /* of its rays there */
};

/* Beyond the bounds on one side, all of it. */
static bool patch_is_beyond(const struct traced_patch *seen)
{
    const struct patches *all = seen->all;
    bool beyond[4] = {true, true, true, true};
    for (size_t i = 0; i < EACH; i++) {
        const double *point = seen->points[seen->first + i];
        for (int k = 0; k < 2; k++) {
            beyond[k] = beyond[k] && point[k] < all->low[k];
            beyond[2 + k] = beyond[2 + k] && point[k] > all->high[k];
        }
    }
    return beyond[0] || beyond[1] || beyond[2] || beyond[3];
}

/*
 * How low a smooth function is between three values of it: the least of the parabola through them,
 * less as much again as that is below them, and some more for what is no parabola.
 */
static double parabola_lowest(double before, double here, double after)
{
    const double bend = before - 2 * here + after, slope = (after - before) / 2;
    const double least = fmin(fmin(before, here), after);
    double valley = fabs(slope) < bend ? here - slope * slope / (2 * bend) : least;
    return 2 * valley - least - fmax(bend, 0) / 16;
}

/* Is a margin above 0 in all of a patch? At the boundary it begins at 0. */
static bool margin_blocks_patch(const double *values, bool at_edge)
{
    const double far = 0.3; /* beyond a rim by a seventh of its radius */
    const size_t first = at_edge ? 1 : 0;
    double least = INFINITY, low = INFINITY;
    bool rises = true, missed = false;
    for (size_t i = 0; i < SIDE; i++) {
        const double *arm = values + i * SIDE;
        const size_t k = i > first ? i : first;
        rises = rises && 4 * arm[1] - arm[2] - 3 * arm[0] > 0;
        low = fmin(low, at_edge ? INFINITY : parabola_lowest(arm[0], arm[1], arm[2]));
        low = fmin(low, parabola_lowest(values[k], values[SIDE + k], values[(size_t)2 * SIDE + k]));
        for (size_t j = first; j < SIDE; j++) {
            least = fmin(least, arm[j]);
            missed = missed || isinf(arm[j]);
        }
    }
    return missed ? !at_edge && least > far : least > 0 && low > 0 && (rises || !at_edge);
}

static bool pupil_islands_is_dark(const struct traced_patch *seen)
{
    const struct clearances *margins = seen->all->margins;
    const size_t limit = margins->limit[seen->first];
    double values[EACH];
    bool dark = clearances_lost(limit);
    for (size_t i = 0; i < EACH; i++) {
        dark = dark && margins->limit[seen->first + i] == limit;
    }
    for (size_t k = 0; k < margins->count && !dark; k++) {
        /* the margin at the rays; infinite where they miss its surface, beyond any rim */
        const double *row = margins->rows + k * RAYS_BLOCK;
        const struct clearance *margin = &margins->all[k];
        bool known = true;
        for (size_t i = 0; i < EACH; i++) {
            const size_t lane = seen->first + i;
            bool misses = margins->limit[lane] == clearances_missed(margin->surface);
            values[i] = misses ? (double)INFINITY : row[lane];
            known = known && !isnan(values[i]);
        }
        dark = known && margin_blocks_patch(values, !(seen->patch.low[1] > 0));
    }
    return dark;
}

/* Do its rays lie as closely as those of the grid? step: 1 on the way outwards, SIDE across it. */
static bool is_fine(const struct traced_patch *seen, size_t step)
{
    const double(*points)[2] = seen->points, *finest = seen->all->finest;
    bool fine = true;
    for (size_t i = 0; i < EACH; i++) {
        const bool is_first = step == 1 ? i % SIDE == 0 : i < SIDE;
        const double *here = points[seen->first + i];
        const double *before = is_first ? here : points[seen->first + i - step];
        fine = fine && fabs(here[0] - before[0]) <= finest[0] &&
               fabs(here[1] - before[1]) <= finest[1];
    }
    return fine;
}

/* Does what ends the rays change from one to the next? */
static bool patch_loss_changes(const struct traced_patch *seen, size_t step)
{
    const size_t *limit = seen->all->margins->limit + seen->first;
    bool changes = false;
    for (size_t i = 0; i < EACH; i++) {
        const bool is_first = step == 1 ? i % SIDE == 0 : i < SIDE;
        changes = changes || (!is_first && limit[i] != limit[i - step]);
    }
    return changes;
}

/* In four; in two where what ends the rays changes only on the way outwards. */
static void patch_cut(struct patches *all, const struct traced_patch *seen)
{
    const struct island_patch *patch = &seen->patch;
    const bool outwards =
        patch_loss_changes(seen, 1) && !patch_loss_changes(seen, SIDE) && !is_fine(seen, 1);
    const double width = (patch->high[0] - patch->low[0]) / 2;
    const double middle = (patch->low[1] + patch->high[1]) / 2;
    if (outwards) {
        patches_add(all, patch->low[0], 2 * width, patch->low[1], middle);
        patches_add(all, patch->low[0], 2 * width, middle, patch->high[1]);
        return;
    }
    for (int i = 0; i < 2; i++) {
        patches_add(all, patch->low[0] + i * width, width, patch->low[1], middle);
        patches_add(all, patch->low[0] + i * width, width, middle, patch->high[1]);
    }
}

/* False: it has light. What is not sure to be dark is cut, unless it is as fine as the grid. */
static bool patch_settle(struct patches *all, const struct traced_patch *seen)
{
    if (patch_is_beyond(seen) || pupil_islands_is_dark(seen)) {
        return true;
    }
    /* does a ray of it pass? Those at the boundary do not count */
    bool light = false;
    for (size_t i = 0; i < EACH; i++) {
        bool at_edge = i % SIDE == 0 && !(seen->patch.low[1] > 0);
        light = light || (!at_edge && seen->all->margins->excess[seen->first + i] <= 0);
    }
    if (light) {
        return false;
    }
    if (!is_fine(seen, 1) || !is_fine(seen, SIDE)) {
        patch_cut(all, seen);
    }
    return true;
}

/* Patches by themselves, up to AT_ONCE. */
static bool settle_patches(struct patches *all, size_t first, size_t count)
{
    double points[AT_ONCE * EACH][2];
    bool dark = true;
    for (size_t i = 0; i < count; i++) {
        place_rays(all, &all->list[first + i], points + i * EACH);
    }
    clearances_look(all->margins, (const double(*)[2])points, count * EACH);
    for (size_t i = 0; i < count && dark; i++) {
        const struct traced_patch seen = {all, all->list[first + i], (const double(*)[2])points,
                                          i * EACH};
        dark = patch_settle(all, &seen);
    }
    return dark;
}

/* Does nothing pass beyond the boundary? False: perhaps. */
static bool is_alone(struct patches *all)
{
    /* all that lies beyond the edge, in sectors from corner to corner; of twin halves one */
    const struct pupil_boundary *boundary = all->boundary;
    const bool is_half = all->margins->is_mirrored && boundary->frame.centre[0] == 0;
    const double first = boundary->corner_count > 0 && !is_half ? boundary->corners[0] : 0;
    const double end = first + (is_half ? PI : 2 * PI);
    double from = first;
    for (size_t i = 0; i < boundary->corner_count; i++) {
        if (boundary->corners[i] > from && boundary->corners[i] < end) {
            add_sectors(all, from, boundary->corners[i]);
            from = boundary->corners[i];
        }
    }
    add_sectors(all, from, end);
    size_t done = 0;
    bool dark = true;
    while (dark && done < all->count && all->count <= MOST) {
        const size_t left = all->count - done, here = left < AT_ONCE ? left : AT_ONCE;
        dark = settle_patches(all, done, here);
        done += here;
    }
    return dark && done == all->count;
}

static struct pupil_islands find_on_grid(const struct clearances *margins,
                                         const struct pupil_boundary *boundary, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    struct pupil_parts *parts = ARENA_NEW(arena, struct pupil_parts);
    /* cells that pass and may lie beyond the boundary */
    double *angles = ARENA_ARRAY(arena, CELLS, double), *near = ARENA_ARRAY(arena, CELLS, double);
    double *radii = ARENA_ARRAY(arena, CELLS, double);
    const double surely = 0.97; /* within: more than pupil_boundary_near is off by */
    size_t all = 0, count = 0, outside = 0;
    pupil_parts_find(margins, NULL, NULL, parts);
    for (size_t i = 0; i < CELLS; i++) {
        double point[2];
        if (parts->part[i] == 0) {
            continue;
        }
        all++;
        pupil_parts_point(parts, i, point);
        edge_polar(&boundary->frame, point, PI, &angles[count], &radii[count]);
        near[count] = pupil_boundary_near(boundary, angles[count]);
        count += radii[count] > surely * near[count];
    }
    struct edge *edges = ARENA_ARRAY(arena, count + 1, struct edge);
    edges_find(margins, &boundary->frame, angles, near, count, 0, 1e-6, edges);
    for (size_t i = 0; i < count; i++) {
        outside += radii[i] > edges[i].radius;
    }
    arena_reset(arena, mark);
    return (struct pupil_islands){outside > 0 ? (double)outside / (double)all : 0};
}

struct pupil_islands pupil_islands_find(const struct clearances *margins,
                                        const struct pupil_boundary *boundary, struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    struct patches *all = arena_buffer(arena, sizeof *all);
    *all = (struct patches){.margins = margins, .boundary = boundary};
    clearances_widen(margins);
    pupil_parts_bound(margins, all->low, all->high);
    for (int k = 0; k < 2; k++) {
        all->finest[k] = (all->high[k] - all->low[k]) / PUPIL_PARTS_SIDE;
    }
    for (int i = 0; i < 4; i++) {
        double angle, radius;
        const double corner[2] = {i % 2 == 0 ? all->low[0] : all->high[0],
                                  i / 2 == 0 ? all->low[1] : all->high[1]};
        edge_polar(&boundary->frame, corner, 0, &angle, &radius);
        all->farthest = fmax(all->farthest, radius);
    }
    /* apertures of other shapes have corners and sides: no differences say what is between */
    const bool alone = !margins->is_listed && is_alone(all);
    arena_reset(arena, mark);
    return alone ? (struct pupil_islands){0} : find_on_grid(margins, boundary, arena);
}
