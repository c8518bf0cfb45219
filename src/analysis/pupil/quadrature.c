/* analysis/pupil/quadrature.c - rays that integrate over what is clear of a stop. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/quadrature.h"

#include "base/constants.h"
#include "trace/dispatch.h"
#include "trace/pupil/pupil_boundary.h"
#include "trace/tangent.h"

#include <math.h>

/* A step of differences, in u and v. */
static const double step = 1e-5;

/* The sine of an angle at which an arm is its own mirror image, but for rounding. */
static const double on_axis = 1e-12;

/* c of the arcs, rad. */
static const double rounder = 8;

/* Lines from the centre to the edge that points are put on. */
struct arms {
    double *angles, *shares; /* rad; of the circle */
    double (*ways)[2];       /* sine and cosine of the angles */
    struct edge *edges;
    struct clear_intervals *intervals;
    size_t count;
    size_t *arcs; /* how many are in each arc from corner to corner */
    size_t arc_count;
};

/* -------- arms -------- */

static double arc_length(const struct pupil_boundary *boundary, size_t i)
{
    double next =
        i + 1 < boundary->corner_count ? boundary->corners[i + 1] : boundary->corners[0] + 2 * PI;
    return next - boundary->corners[i];
}

/*
 * Directions, and their shares of the circle. What n points of Gauss leave of an arc of the length
 * L falls about as (L/c)^2n: alike in all arcs where n is in proportion to 1/log(c/L).
 */
static void quadrature_spread(const struct pupil_boundary *boundary, size_t wanted,
                              struct arena *arena, struct arms *arms)
{
    size_t arcs = boundary->corner_count, most = wanted + 2 * arcs;
    arms->angles = ARENA_ARRAY(arena, most, double);
    arms->shares = ARENA_ARRAY(arena, most, double);
    arms->arcs = ARENA_ARRAY(arena, arcs, size_t);
    arms->arc_count = arcs;
    arms->count = 0;
    for (size_t k = 0; k < wanted && arcs == 0; k++) {
        arms->angles[k] = 2 * PI * (double)k / (double)wanted;
        arms->shares[k] = 1 / (double)wanted;
        arms->count++;
    }
    double sum = 0;
    for (size_t i = 0; i < arcs; i++) {
        sum += 1 / log(rounder / arc_length(boundary, i));
    }
    for (size_t i = 0; i < arcs; i++) {
        double length = arc_length(boundary, i), share = length / (2 * PI);
        double part = 1 / (log(rounder / length) * sum);
        size_t points = (size_t)ceil((double)wanted * part) + 1;
        arms->arcs[i] = points;
        gauss_rule(points, arms->angles + arms->count, arms->shares + arms->count);
        for (size_t end = arms->count + points; arms->count < end; arms->count++) {
            double *angle = &arms->angles[arms->count];
            *angle = boundary->corners[i] + length * *angle;
            arms->shares[arms->count] *= share;
        }
    }
}

/* Arms that show corners which the boundary has missed are made anew. */
static void make_arms(const struct quadrature_region *region, size_t wanted, struct arena *arena,
                      struct arms *arms)
{
    enum { LESSONS = 3 };
    const struct clearances *margins = &region->margins;
    struct pupil_boundary *boundary = region->boundary;
    bool learns = true;
    for (int lesson = 0; lesson <= LESSONS && learns; lesson++) {
        quadrature_spread(boundary, wanted, arena, arms);
        if (region->in_half && margins->is_mirrored && boundary->frame.centre[0] == 0) {
            /* Of arms that mirror each other about u = 0 one counts twice. */
            size_t kept = 0;
            for (size_t j = 0; j < arms->count; j++) {
                const double side = sin(arms->angles[j]);
                if (side > -on_axis) {
                    arms->angles[kept] = arms->angles[j];
                    arms->shares[kept++] = arms->shares[j] * (side > on_axis ? 2 : 1);
                }
            }
            arms->count = kept;
        }
        arms->edges = ARENA_ARRAY(arena, arms->count, struct edge);
        pupil_boundary_edges(margins, boundary, arms->angles, arms->count, arena, arms->edges);
        learns = lesson < LESSONS &&
                 pupil_boundary_learn(margins, arms->angles, arms->count, arms->edges, boundary);
    }
    arms->ways = arena_array(arena, arms->count, sizeof *arms->ways);
    for (size_t i = 0; i < arms->count; i++) {
        arms->ways[i][0] = sin(arms->angles[i]);
        arms->ways[i][1] = cos(arms->angles[i]);
    }
    arms->intervals = ARENA_ARRAY(arena, arms->count, struct clear_intervals);
    pupil_boundary_intervals(margins, &boundary->frame, arms->angles, arms->count, arms->edges,
                             arms->intervals);
}

/* -------- points -------- */

/* Gauss's points on all clear parts of the arms, one ring of the arms after the other. */
static void quadrature_put_points(const struct quadrature_region *region, const struct arms *arms,
                                  size_t rings, struct arena *arena, struct quadrature *all)
{
    const struct pupil_boundary *boundary = region->boundary;
    const bool in_r = region->in_r;
    const double area = boundary->frame.stretch[0] * boundary->frame.stretch[1];
    double *x = ARENA_ARRAY(arena, rings, double), *w = ARENA_ARRAY(arena, rings, double);
    size_t count = 0;
    size_t most = 0; /* intervals of an arm */
    for (size_t k = 0; k < arms->count; k++) {
        count += rings * arms->intervals[k].count;
        most = arms->intervals[k].count > most ? arms->intervals[k].count : most;
    }
    all->sample.points = ARENA_ARRAY(arena, count, struct pupil_point);
    gauss_rule(rings, x, w);
    for (size_t i = 0; i < rings * most * arms->count; i++) {
        size_t k = i % arms->count, ring = i / arms->count % rings;
        size_t span = i / arms->count / rings;
        const struct clear_intervals *intervals = &arms->intervals[k];
        if (span >= intervals->count) {
            continue;
        }
        const double radius = arms->edges[k].radius;
        double low = intervals->low[span], high = intervals->high[span];
        double width2 = (high - low) * (high + low), t = sqrt(low * low + width2 * x[ring]);
        if (in_r) {
            t = low + (high - low) * x[ring];
            width2 = 2 * t * (high - low);
        }
        const double u = boundary->frame.stretch[0] * (radius * t) * arms->ways[k][0];
        const double v = boundary->frame.stretch[1] * (radius * t) * arms->ways[k][1];
        all->sample.points[all->sample.count++] =
            (struct pupil_point){boundary->frame.centre[0] + u, boundary->frame.centre[1] + v,
                                 w[ring] * arms->shares[k] * radius * radius * area * width2};
    }
    bool orderly = count == rings * most * arms->count;
    all->arms = orderly ? arms->count : 0;
    all->rings = orderly ? rings : 0;
    all->arcs = (struct quadrature_arcs){arms->arcs, arms->arc_count};
}

/* The rays of points named by u and v, and what areas there are of the beam. */
static void quadrature_put_rays(const struct clearances *margins, struct arena *arena,
                                struct quadrature *all)
{
    const struct stop_beam *beam = margins->beam;
    all->rays = rays_room(arena, all->sample.count);
    double(*at)[2] = arena_array(arena, all->sample.count, sizeof *at);
    for (size_t i = 0; i < all->sample.count; i++) {
        struct pupil_point *point = &all->sample.points[i];
        at[i][0] = point->x;
        at[i][1] = point->y;
        point->weight *=
            beam->weight == WEIGHT_BEAM ? stop_beam_density(beam, point->x, point->y) : 1;
    }
    clearances_start(margins, (const double(*)[2])at, &all->rays);
}

/* -------- a stop or a disc that nothing clips -------- */

/* Arms on one side are aimed; others mirror them: arm k is arm `arms` - k, arm 0 its own. */
static bool whole_aim_half(const struct aim *aim, size_t arms, struct arena *arena,
                           struct quadrature *all)
{
    const size_t half = (arms + 1) / 2, count = all->sample.count / arms * half;
    const struct rays part = rays_room(arena, count);
    struct pupil_point *points = ARENA_ARRAY(arena, count, struct pupil_point);
    for (size_t i = 0; i < count; i++) {
        points[i] = all->sample.points[i / half * arms + i % half];
    }
    if (!aim_rays_straight(aim, points, count, &part)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        const size_t k = i % half, here = i / half * arms + k;
        struct ray ray = rays_get(&part, i, aim->beam.n);
        rays_set(&all->rays, here, aim->beam.n, &ray);
        if (k > 0) {
            ray.point[0] = -ray.point[0];
            ray.cosine[0] = -ray.cosine[0];
            rays_set(&all->rays, here - k + arms - k, aim->beam.n, &ray);
        }
    }
    return true;
}

/* Does the outermost ring go around once, the way the points do, and arrive? */
static bool whole_is_sound(const struct clearances *margins, const struct rays *all, size_t first)
{
    const struct stop_beam *beam = margins->beam;
    /* Which way around in the beam's plane a disc goes: +1 as in u and v. */
    double at[3][2];
    stop_beam_place(beam, 0, 0, at[0]);
    stop_beam_place(beam, 1, 0, at[1]);
    stop_beam_place(beam, 0, 1, at[2]);
    const double turn = (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                        (at[1][1] - at[0][1]) * (at[2][0] - at[0][0]),
                 n = margins->system->index_first;
    const size_t count = all->count - first;
    double centre[2];
    bool sound = true;
    stop_beam_place(beam, 0, 0, centre);
    for (size_t i = 0; i < count && sound; i++) {
        const struct rays rays = {margins->work.blocks, i % RAYS_BLOCK + 1};
        const struct ray ray = rays_get(all, first + i, n);
        const struct ray other = rays_get(all, first + (i + 1) % count, n);
        double here[2], next[2];
        beam_place(beam->beam, ray.point, here);
        beam_place(beam->beam, other.point, next);
        rays_set(&rays, i % RAYS_BLOCK, n, &ray);
        /* angles count from v towards u */
        sound = turn * ((here[1] - centre[1]) * (next[0] - centre[0]) -
                        (here[0] - centre[0]) * (next[1] - centre[1])) >
                0;
        if (rays.count == RAYS_BLOCK || i + 1 == count) {
            rays_trace(margins->system, &rays, NULL);
            for (size_t lane = 0; lane < rays.count; lane++) {
                sound = sound && ray_block_status(rays.blocks, lane) == RAY_OK;
            }
        }
    }
    return sound;
}

/*
 * Gauss's points of the whole disc, without a search for edges; of halves that mirror each other
 * the rays of one are aimed.
 *
 * Result    false: that would not do, for rims may end the rays, areas of the beam of a stop are
 *           asked for, whole steps of Broyden's method do not lead to all points, or rays of the
 *           outermost ring are lost behind it
 */
static bool quadrature_whole(const struct clearances *margins, size_t rays, struct arena *arena,
                             struct quadrature *all)
{
    const struct stop_beam *beam = margins->beam;
    const bool is_disc = margins->all[0].surface == LENS_NONE;
    struct error ignored;
    size_t arms = 1;
    *all = (struct quadrature){.is_empty = false};
    if (margins->count != 1 || margins->is_listed ||
        !(is_disc || (beam->weight == WEIGHT_PUPIL && beam->aim != NULL)) ||
        !sample_make(PATTERN_GAUSS, rays, 0, arena, &all->sample, &ignored)) {
        return false;
    }
    const size_t count = all->sample.count;
    while (arms * (arms - 1) / 2 < count) {
        arms += 2;
    }
    all->arms = arms;
    all->rings = count / arms;
    if (is_disc) {
        quadrature_put_rays(margins, arena, all);
        return whole_is_sound(margins, &all->rays, count - arms);
    }
    all->rays = rays_room(arena, count);
    const bool aimed = stop_beam_is_mirrored(beam)
                           ? whole_aim_half(beam->aim, arms, arena, all)
                           : aim_rays_straight(beam->aim, all->sample.points, count, &all->rays);
    return aimed && whole_is_sound(margins, &all->rays, count - arms);
}

/* -------- weights -------- */

/* What takes u, v to the stop, and areas with them. */
struct stop_map {
    const struct clearances *margins;
    struct system before;       /* to the stop */
    struct ray_block *rays;     /* two */
    struct ray_block *tangents; /* two */
};

static struct stop_map mapping_open(const struct clearances *margins, bool weighs,
                                    struct arena *arena)
{
    struct stop_map mapping = {.margins = margins, .before = *margins->system};
    mapping.before.places = system_place(margins->system, margins->system->stop) + 1;
    if (weighs) {
        mapping.rays = rays_room(arena, (size_t)2 * RAYS_BLOCK).blocks;
        mapping.tangents = rays_room(arena, (size_t)2 * RAYS_BLOCK).blocks;
    }
    return mapping;
}

/* |d(x, y in the stop)/d(u, v)| of up to 128 points; where they cross it stands in the block. */
static void find_areas(const struct stop_map *mapping, const double (*points)[2], size_t count,
                       double *areas)
{
    const struct clearances *margins = mapping->margins;
    const struct system *system = margins->system;
    struct ray_block *block = margins->work.blocks;
    const double unit = margins->beam->radius;
    const int lanes = kernel_lanes(count);
    clearances_go(margins, points, count, 0);
    for (int k = 0; k < 2; k++) {
        const double *axes = margins->beam->axes + k;
        beam_tangents(margins->beam->beam, (double[2]){axes[0], axes[2]}, block, (size_t)lanes,
                      &mapping->tangents[k]);
    }
    ray_block_copy(&mapping->rays[0], block, (size_t)lanes);
    tangent_follow(&mapping->before, lanes, 2, mapping->rays, mapping->tangents);
    ray_block_copy(block, &mapping->rays[0], (size_t)lanes);
    for (size_t i = 0; i < count; i++) {
        double from[3], along[2][3];
        clearances_cross(margins, system->stop, i, from);
        for (int k = 0; k < 2; k++) {
            const struct ray_block *tangent = &mapping->tangents[k];
            double *to = along[k];
            to[0] = block->x[i] + tangent->x[i];
            to[1] = block->y[i] + tangent->y[i];
            to[2] = block->z[i] + tangent->z[i];
            if (system->lens->surfaces[system->stop].decentre != NULL) {
                system_to_own(system, system->stop, to);
            }
        }
        areas[i] = fabs((along[0][0] - from[0]) * (along[1][1] - from[1]) -
                        (along[0][1] - from[1]) * (along[1][0] - from[0])) /
                   (unit * unit);
    }
}

/* The same by the four rays about each point: an ideal thick lens has no tangents. */
static void find_areas_beside(const struct stop_map *mapping, const double (*points)[2],
                              size_t count, double *areas)
{
    enum { EACH = 4, AT_ONCE = RAYS_BLOCK / EACH };
    static const double steps[EACH][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const struct clearances *margins = mapping->margins;
    const double unit = margins->beam->radius;
    for (size_t done = 0; done < count; done += AT_ONCE) {
        double beside[RAYS_BLOCK][2];
        size_t here = count - done < AT_ONCE ? count - done : AT_ONCE;
        for (size_t i = 0; i < here * EACH; i++) {
            for (int k = 0; k < 2; k++) {
                beside[i][k] = points[done + i / EACH][k] + step * steps[i % EACH][k];
            }
        }
        clearances_go(margins, (const double(*)[2])beside, here * EACH, mapping->before.places);
        for (size_t i = 0; i < here; i++) {
            double at[EACH][3];
            for (size_t k = 0; k < EACH; k++) {
                clearances_cross(margins, margins->system->stop, i * EACH + k, at[k]);
            }
            double xu = at[0][0] - at[1][0], yu = at[0][1] - at[1][1];
            double xv = at[2][0] - at[3][0], yv = at[2][1] - at[3][1];
            areas[done + i] = fabs(xu * yv - xv * yu) / (4 * step * step * unit * unit);
        }
    }
}

/* One way or the other; false: the rays do not stand where they cross the stop. */
static bool find_any_areas(const struct stop_map *mapping, const double (*from)[2], size_t count,
                           double *areas)
{
    bool known = true;
    find_areas(mapping, from, count, areas);
    for (size_t i = 0; i < count; i++) {
        known = known && isfinite(areas[i]);
    }
    if (!known) {
        find_areas_beside(mapping, from, count, areas);
    }
    return known;
}

/* From u, v to the stop's own coordinates, and to its areas where those are weighed. */
static void map_to_stop(const struct stop_map *mapping, struct sample *sample)
{
    const struct clearances *margins = mapping->margins;
    const double over = 1 / margins->beam->radius;
    for (size_t done = 0; done < sample->count; done += RAYS_BLOCK) {
        size_t here = sample->count - done < RAYS_BLOCK ? sample->count - done : RAYS_BLOCK;
        struct pupil_point *points = sample->points + done;
        double from[RAYS_BLOCK][2];
        for (size_t i = 0; i < here; i++) {
            from[i][0] = points[i].x;
            from[i][1] = points[i].y;
        }
        bool there = false;
        if (margins->beam->weight == WEIGHT_PUPIL) {
            double areas[RAYS_BLOCK];
            there = find_any_areas(mapping, (const double(*)[2])from, here, areas);
            for (size_t i = 0; i < here; i++) {
                points[i].weight *= areas[i];
            }
        }
        if (!there) {
            clearances_go(margins, (const double(*)[2])from, here, mapping->before.places);
        }
        for (size_t i = 0; i < here; i++) {
            double at[3];
            clearances_cross(margins, margins->system->stop, i, at);
            points[i].x = at[0] * over;
            points[i].y = at[1] * over;
        }
    }
}

/* Of a whole disc k rings with 2 k + 1 arms are exact up to the degree 2 k; others want more. */
static size_t arms_for(const struct pupil_boundary *boundary, size_t rings)
{
    return boundary->is_whole ? 2 * rings + 1 : 3 * rings + 2;
}

struct quadrature_region quadrature_open(const struct stop_beam *beam, struct arena *arena)
{
    struct pupil_boundary *boundary = arena_buffer(arena, sizeof *boundary);
    boundary->count = 0;
    return (struct quadrature_region){
        .beam = beam, .margins = clearances_open(beam, arena), .boundary = boundary};
}

static void quadrature_look(struct quadrature_region *region, struct arena *arena)
{
    if (!region->is_known) {
        region->is_known = true;
        if (region->near == NULL ||
            !pupil_boundary_follow(&region->margins, region->near, region->boundary)) {
            region->is_empty = !pupil_boundary_find(&region->margins, arena, region->boundary);
        }
    }
}

struct pupil_islands quadrature_islands(struct quadrature_region *region, struct arena *arena)
{
    quadrature_look(region, arena);
    return region->is_empty ? (struct pupil_islands){0}
                            : pupil_islands_find(&region->margins, region->boundary, arena);
}

const struct pupil_boundary *quadrature_boundary(struct quadrature_region *region,
                                                 struct arena *arena)
{
    quadrature_look(region, arena);
    return region->is_empty ? NULL : region->boundary;
}

struct quadrature_rim quadrature_edge(const struct quadrature_region *region, const double *angles,
                                      size_t count, const double *near, double slack,
                                      struct arena *arena)
{
    const struct pupil_boundary *boundary = region->boundary;
    double *radii = ARENA_ARRAY(arena, count, double);
    struct edge *edges = ARENA_ARRAY(arena, count, struct edge);
    double(*points)[2] = arena_array(arena, count, sizeof *points);
    if (near == NULL) {
        pupil_boundary_edges(&region->margins, boundary, angles, count, arena, edges);
    } else {
        edges_find(&region->margins, &boundary->frame, angles, near, count, slack,
                   PUPIL_BOUNDARY_ROUNDING, edges);
    }
    for (size_t i = 0; i < count; i++) {
        radii[i] = edges[i].radius;
        edge_point(&boundary->frame, angles[i], radii[i], points[i]);
    }
    return (struct quadrature_rim){(const double(*)[2])points, radii, count};
}

void quadrature_rays_within(const struct quadrature_region *region,
                            const struct quadrature_rim *rim, const double *shares, size_t rings,
                            const struct rays *rays)
{
    const double *centre = region->boundary->frame.centre;
    double at[RAYS_BLOCK][2];
    for (size_t i = 0; i < rings * rim->count; i++) {
        const double *point = rim->points[i % rim->count], share = shares[i / rim->count];
        const size_t lane = i % RAYS_BLOCK;
        for (int k = 0; k < 2; k++) {
            at[lane][k] = centre[k] + share * (point[k] - centre[k]);
        }
        if (lane + 1 == RAYS_BLOCK || i + 1 == rings * rim->count) {
            const struct rays block = {rays->blocks + i / RAYS_BLOCK, lane + 1};
            clearances_start(&region->margins, (const double(*)[2])at, &block);
        }
    }
}

struct quadrature quadrature_fill(struct quadrature_region *region, size_t rays,
                                  struct arena *arena)
{
    const struct clearances *margins = &region->margins;
    const struct stop_beam *beam = region->beam;
    struct quadrature all;
    struct arms arms;
    if (!region->in_beam && quadrature_whole(margins, rays, arena, &all)) {
        return all;
    }
    quadrature_look(region, arena);
    all = (struct quadrature){.is_empty = region->is_empty};
    if (all.is_empty) {
        return all;
    }
    const struct pupil_boundary *boundary = region->boundary;
    size_t rings = 1;
    while (rings * (arms_for(boundary, rings) + boundary->corner_count) < rays) {
        rings++;
    }
    make_arms(region, arms_for(boundary, rings), arena, &arms);
    quadrature_put_points(region, &arms, rings, arena, &all);
    all.is_empty = all.sample.count == 0;
    if (region->in_beam) {
        return all;
    }
    quadrature_put_rays(margins, arena, &all);
    if (!isnan(beam->radius)) {
        const struct stop_map mapping = mapping_open(margins, beam->weight == WEIGHT_PUPIL, arena);
        map_to_stop(&mapping, &all.sample);
    }
    return all;
}

void quadrature_weigh_beam(const struct stop_beam *beam, const struct rays *rays,
                           struct pupil_point *points, struct arena *arena)
{
    for (size_t i = 0; i < rays->count && isnan(beam->radius); i++) {
        points[i].weight *= stop_beam_density(beam, points[i].x, points[i].y);
    }
    if (isnan(beam->radius)) {
        return;
    }
    const struct clearances margins = clearances_open(beam, arena);
    const struct stop_map mapping = mapping_open(&margins, true, arena);
    for (size_t done = 0; done < rays->count; done += RAYS_BLOCK) {
        const size_t here = rays->count - done < RAYS_BLOCK ? rays->count - done : RAYS_BLOCK;
        double from[RAYS_BLOCK][2], areas[RAYS_BLOCK];
        /* u and v of the rays of a block, where they start. */
        const double *m = beam->axes, det = m[0] * m[3] - m[1] * m[2];
        for (size_t j = 0; j < here; j++) {
            const struct ray ray = rays_get(rays, done + j, beam->system->index_first);
            double at[2];
            beam_place(beam->beam, ray.point, at);
            const double a = at[0] - beam->origin[0], b = at[1] - beam->origin[1];
            from[j][0] = (m[3] * a - m[1] * b) / det;
            from[j][1] = (m[0] * b - m[2] * a) / det;
        }
        find_any_areas(&mapping, (const double(*)[2])from, here, areas);
        for (size_t i = 0; i < here; i++) {
            /* one that has none is lost on its way to the stop */
            points[done + i].weight /= areas[i] > 0 ? areas[i] : 1;
        }
    }
}

struct quadrature quadrature_make(const struct stop_beam *beam, size_t rays, struct arena *arena)
{
    struct quadrature_region region = quadrature_open(beam, arena);
    return quadrature_fill(&region, rays, arena);
}
