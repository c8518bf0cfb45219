/* analysis/quadrature.c - rays that integrate over what is clear of a stop. */
/* SPDX-License-Identifier: MIT */
#include "analysis/quadrature.h"

#include "base/constants.h"
#include "trace/dispatch.h"
#include "trace/probe.h"
#include "trace/spans.h"

#include <math.h>

enum { DIRECTIONS = 32, GRID = 24, CORNERS = 8, CORNER_ROUNDS = 5, CORNER_STEPS = 4, STRIDES = 8 };

/* Where apertures are listed. */
enum { MORE_DIRECTIONS = 256, MORE_CORNERS = 64 };

/* Shares of the stop's radius: how far off an edge may be, and the step of differences. */
static const double roughly = 1e-6, finely = 1e-11, step = 1e-5;

/* How far out the stop's edge usually and at most lies in u and v, for its aberrations. */
static const double usual_reach = 1.125, farthest = 64;

/* The last clear point in a direction, and what limits it. */
struct edge {
    double radius;
    size_t limit;
};

enum { NOTHING = 0, STOP = 1 }; /* else by surface and status */

/* What is clear, as a star about `centre`. Angles count from v towards u. */
struct star {
    double centre[2];
    double corners[MORE_CORNERS]; /* rad, ascending */
    size_t corner_count;
};

/* One block of rays. */
struct trial {
    const struct stop_beam *beam;
    const struct system *system; /* of the edge: unobstructed */
    size_t stop;                 /* the place behind the stop; 0 = there is none */
    struct rays work;
    struct probe probe; /* for what cuts within */
    bool is_listed;     /* some surface has apertures beside its diameter */
};

static struct trial trial_open(const struct stop_beam *beam, struct arena *arena)
{
    bool has_stop = !isnan(beam->radius);
    return (struct trial){.beam = beam,
                          .system = system_outer(beam->system),
                          .stop = has_stop ? system_place(beam->system, beam->system->stop) + 1 : 0,
                          .work = rays_new(arena, RAYS_BLOCK),
                          .probe = probe_open(beam->system, beam->beam, arena),
                          .is_listed = beam->system->clips != NULL};
}

static struct ray start_of(const struct stop_beam *beam, double u, double v)
{
    double at[2];
    stop_beam_place(beam, u, v, at);
    return beam_ray(beam->beam, at[0], at[1]);
}

/* Up to 128 rays to the stop; there they stand in the block. */
static void go_to_stop(const struct trial *trial, const struct pupil_point *points, size_t count)
{
    const struct stop_beam *beam = trial->beam;
    for (size_t i = 0; i < count; i++) {
        struct ray ray = start_of(beam, points[i].x, points[i].y);
        rays_set(&trial->work, i, beam->system->index_first, &ray);
    }
    rays_trace_part(trial->system, 0, trial->stop, &trial->work, NULL);
}

/* Where rays that stand there cross the stop, in its own frame and in units of its radius. */
static void in_stop(const struct trial *trial, size_t i, double at[2])
{
    const struct system *system = trial->system;
    const struct ray_block *block = trial->work.blocks;
    double point[3] = {block->x[i], block->y[i], block->z[i]};
    if (system->lens->surfaces[system->stop].decentre != NULL) {
        system_to_own(system, system->stop, point);
    }
    at[0] = point[0] / trial->beam->radius;
    at[1] = point[1] / trial->beam->radius;
}

/* What stops up to 128 rays. */
static void try_points(const struct trial *trial, const struct pupil_point *points, size_t count,
                       size_t *limits)
{
    const struct ray_block *block = trial->work.blocks;
    go_to_stop(trial, points, count);
    for (size_t i = 0; i < count; i++) {
        double at[2] = {points[i].x, points[i].y};
        if (trial->stop > 0) {
            in_stop(trial, i, at);
        }
        limits[i] = at[0] * at[0] + at[1] * at[1] > 1 ? STOP : NOTHING;
    }
    rays_trace_part(trial->system, trial->stop, trial->system->places, &trial->work, NULL);
    for (size_t i = 0; i < count; i++) {
        enum ray_status status = ray_block_status(block, i);
        if (limits[i] == NOTHING && status != RAY_OK) {
            limits[i] = 8 * ray_block_surface(block, i) + (size_t)status;
        }
    }
}

static struct pupil_point point_at(const double centre[2], double angle, double radius)
{
    return (struct pupil_point){centre[0] + radius * sin(angle), centre[1] + radius * cos(angle),
                                0};
}

/* Between what is clear and what is dark in a direction. */
struct bracket {
    double clear, dark;
};

/* Outwards step by step, so that a narrow gap is not passed over: brackets in up to 128 ways. */
static void bracket_edges(const struct trial *trial, const double centre[2], const double *angles,
                          size_t count, struct bracket *brackets, struct edge *edges)
{
    struct pupil_point points[RAYS_BLOCK];
    size_t limits[RAYS_BLOCK], which[RAYS_BLOCK], open = count;
    double far = 0, stride = usual_reach / STRIDES;
    for (size_t i = 0; i < count; i++) {
        which[i] = i;
        brackets[i] = (struct bracket){0, 0};
        edges[i] = (struct edge){0, NOTHING};
    }
    while (open > 0 && far < farthest) {
        size_t left = 0;
        far += stride;
        stride = far < usual_reach ? stride : far;
        for (size_t k = 0; k < open; k++) {
            points[k] = point_at(centre, angles[which[k]], far);
        }
        try_points(trial, points, open, limits);
        for (size_t k = 0; k < open; k++) {
            size_t i = which[k];
            brackets[i].dark = far;
            edges[i].limit = limits[k];
            if (limits[k] == NOTHING) {
                brackets[i].clear = far;
                which[left++] = i;
            }
        }
        open = left;
    }
}

/* Edges in up to 128 directions, bisected together. */
static void bisect(const struct trial *trial, const double centre[2], const double *angles,
                   size_t count, double tolerance, struct edge *edges)
{
    struct pupil_point points[RAYS_BLOCK];
    struct bracket brackets[RAYS_BLOCK];
    size_t limits[RAYS_BLOCK];
    bracket_edges(trial, centre, angles, count, brackets, edges);
    for (bool wide = true; wide;) {
        wide = false;
        for (size_t i = 0; i < count; i++) {
            double middle = (brackets[i].clear + brackets[i].dark) / 2;
            points[i] = point_at(centre, angles[i], middle);
            wide = wide || brackets[i].dark - brackets[i].clear > tolerance;
        }
        try_points(trial, points, count, limits);
        for (size_t i = 0; i < count; i++) {
            double middle = (brackets[i].clear + brackets[i].dark) / 2;
            if (limits[i] == NOTHING) {
                brackets[i].clear = middle;
            } else {
                brackets[i].dark = middle;
                edges[i].limit = limits[i];
            }
        }
    }
    for (size_t i = 0; i < count; i++) {
        edges[i].radius = brackets[i].clear;
    }
}

static void find_edges(const struct trial *trial, const double centre[2], const double *angles,
                       size_t count, double tolerance, struct edge *edges)
{
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        bisect(trial, centre, angles + done, here, tolerance, edges + done);
    }
}

/* What is clear of lines to edges. */
static void find_spans(const struct trial *trial, const double centre[2], const double *angles,
                       const struct edge *edges, size_t count, struct spans *spans)
{
    double from[2], ends[RAYS_BLOCK][2];
    stop_beam_place(trial->beam, centre[0], centre[1], from);
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        for (size_t i = 0; i < here; i++) {
            struct pupil_point point = point_at(centre, angles[done + i], edges[done + i].radius);
            stop_beam_place(trial->beam, point.x, point.y, ends[i]);
            spans[done + i] = spans_whole;
        }
        if (trial->probe.full != NULL) {
            spans_find(&trial->probe, from, (const double(*)[2])ends, here, spans + done);
        }
        for (size_t i = 0; i < here; i++) {
            struct spans *clear = &spans[done + i];
            struct pupil_point point = point_at(centre, angles[done + i], edges[done + i].radius);
            const double to[2] = {point.x, point.y};
            for (size_t k = 0; k < clear->count; k++) {
                clear->low[k] = stop_beam_share(trial->beam, centre, to, clear->low[k]);
                clear->high[k] = stop_beam_share(trial->beam, centre, to, clear->high[k]);
            }
        }
    }
}

/* Edges to compare with each other: their limits say which piece of an aperture ends them too. */
static void find_limits(const struct trial *trial, const double centre[2], const double *angles,
                        size_t count, struct edge *edges)
{
    find_edges(trial, centre, angles, count, roughly, edges);
    for (size_t done = 0; done < count && trial->is_listed; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        double at[RAYS_BLOCK][2];
        struct clear_edge ends[RAYS_BLOCK];
        struct spans spans[RAYS_BLOCK];
        for (size_t i = 0; i < here; i++) {
            const struct edge *edge = &edges[done + i];
            struct pupil_point point = point_at(centre, angles[done + i], edge->radius);
            stop_beam_place(trial->beam, point.x, point.y, at[i]);
            ends[i] = (struct clear_edge){.status = (enum ray_status)(edge->limit % 8),
                                          .surface = edge->limit / 8};
        }
        probe_parts(&trial->probe, (const double(*)[2])at, here, ends);
        find_spans(trial, centre, angles + done, edges + done, here, spans);
        for (size_t i = 0; i < here; i++) {
            size_t *limit = &edges[done + i].limit;
            *limit = (*limit * 1000003 + ends[i].part) * 1000003 + spans[i].part;
        }
    }
}

/* The points of a grid that are clear: their centroid, and which is nearest to it. */
static bool search_grid(const struct trial *trial, double centre[2])
{
    struct pupil_point points[GRID * GRID];
    size_t limits[GRID * GRID], count = 0;
    for (size_t i = 0; i < GRID * GRID; i++) {
        double x = (2 * (double)(i % GRID) + 1) / GRID - 1;
        double y = (2 * (double)(i / GRID) + 1) / GRID - 1;
        points[count++] = (struct pupil_point){1.5 * x, 1.5 * y, 0};
    }
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        try_points(trial, points + done, here, limits + done);
    }
    double sum[2] = {0, 0}, best = INFINITY;
    size_t clear = 0;
    for (size_t i = 0; i < count; i++) {
        if (limits[i] == NOTHING) {
            sum[0] += points[i].x;
            sum[1] += points[i].y;
            clear++;
        }
    }
    for (size_t i = 0; i < count && clear > 0; i++) {
        double away =
            hypot(points[i].x - sum[0] / (double)clear, points[i].y - sum[1] / (double)clear);
        if (limits[i] == NOTHING && away < best) {
            best = away;
            centre[0] = points[i].x;
            centre[1] = points[i].y;
        }
    }
    return clear > 0;
}

static bool find_centre(const struct trial *trial, double centre[2])
{
    const struct pupil_point middle = {0, 0, 0};
    size_t limit;
    centre[0] = centre[1] = 0;
    try_points(trial, &middle, 1, &limit);
    return limit == NOTHING || search_grid(trial, centre);
}

/* Narrow all brackets that hold a corner, each where the clear aperture it begins with ends. */
static void narrow(const struct trial *trial, const double centre[2], const size_t *begins,
                   size_t count, double *low, double *high)
{
    double angles[MORE_CORNERS * CORNER_STEPS];
    struct edge edges[MORE_CORNERS * CORNER_STEPS];
    for (size_t i = 0; i < count * CORNER_STEPS; i++) {
        size_t k = i / CORNER_STEPS;
        double share = (double)(i % CORNER_STEPS + 1) / (CORNER_STEPS + 1);
        angles[i] = low[k] + share * (high[k] - low[k]);
    }
    find_limits(trial, centre, angles, count * CORNER_STEPS, edges);
    for (size_t k = 0; k < count; k++) {
        for (size_t j = 0; j < CORNER_STEPS; j++) {
            size_t i = k * CORNER_STEPS + j;
            if (edges[i].limit != begins[k]) {
                high[k] = angles[i];
                break;
            }
            low[k] = angles[i];
        }
    }
}

static void find_corners(const struct trial *trial, struct star *star)
{
    const size_t directions = trial->is_listed ? MORE_DIRECTIONS : DIRECTIONS;
    const size_t most = trial->is_listed ? MORE_CORNERS : CORNERS;
    double angles[MORE_DIRECTIONS], low[MORE_CORNERS], high[MORE_CORNERS];
    struct edge edges[MORE_DIRECTIONS];
    size_t begins[MORE_CORNERS], count = 0;
    for (size_t i = 0; i < directions; i++) {
        angles[i] = 2 * PI * ((double)i + 0.5) / (double)directions;
    }
    find_limits(trial, star->centre, angles, directions, edges);
    for (size_t i = 0; i < directions; i++) {
        if (edges[i].limit == edges[(i + 1) % directions].limit) {
            continue;
        }
        if (count == most) {
            return;
        }
        begins[count] = edges[i].limit;
        low[count] = angles[i];
        high[count++] = angles[i] + 2 * PI / (double)directions;
    }
    for (int round = 0; round < CORNER_ROUNDS && count > 0; round++) {
        narrow(trial, star->centre, begins, count, low, high);
    }
    for (size_t k = 0; k < count; k++) {
        star->corners[k] = (low[k] + high[k]) / 2;
    }
    star->corner_count = count;
}

/* Directions, and their shares of the circle. Result: how many. */
static size_t spread(const struct star *star, size_t arms, struct arena *arena, double **angles,
                     double **shares)
{
    size_t arcs = star->corner_count, most = arms + 2 * arcs, count = 0;
    *angles = ARENA_ARRAY(arena, most, double);
    *shares = ARENA_ARRAY(arena, most, double);
    for (size_t k = 0; k < arms && arcs == 0; k++) {
        (*angles)[k] = 2 * PI * (double)k / (double)arms;
        (*shares)[k] = 1 / (double)arms;
        count++;
    }
    for (size_t i = 0; i < arcs; i++) {
        double next = i + 1 < arcs ? star->corners[i + 1] : star->corners[0] + 2 * PI;
        double length = next - star->corners[i], share = length / (2 * PI);
        size_t points = (size_t)ceil((double)arms * share) + 1;
        gauss_rule(points, *angles + count, *shares + count);
        for (size_t end = count + points; count < end; count++) {
            (*angles)[count] = star->corners[i] + length * (*angles)[count];
            (*shares)[count] *= share;
        }
    }
    return count;
}

/* The area of the stop that an area of u, v fills, by the four rays about each point. */
static void weigh_in_stop(const struct trial *trial, struct pupil_point *points, size_t count)
{
    enum { EACH = 4, AT_ONCE = RAYS_BLOCK / EACH };
    static const double steps[EACH][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    struct pupil_point beside[RAYS_BLOCK];
    for (size_t done = 0; done < count; done += AT_ONCE) {
        size_t here = count - done < AT_ONCE ? count - done : AT_ONCE;
        for (size_t i = 0; i < here * EACH; i++) {
            const struct pupil_point *at = &points[done + i / EACH];
            beside[i].x = at->x + step * steps[i % EACH][0];
            beside[i].y = at->y + step * steps[i % EACH][1];
        }
        go_to_stop(trial, beside, here * EACH);
        for (size_t i = 0; i < here; i++) {
            double at[EACH][2];
            for (size_t k = 0; k < EACH; k++) {
                in_stop(trial, i * EACH + k, at[k]);
            }
            double xu = at[0][0] - at[1][0], yu = at[0][1] - at[1][1];
            double xv = at[2][0] - at[3][0], yv = at[2][1] - at[3][1];
            points[done + i].weight *= fabs(xu * yv - xv * yu) / (4 * step * step);
        }
    }
}

/* From u, v to the stop's own coordinates, and from areas of u, v to what is weighed. */
static void name_points(const struct trial *trial, struct sample *sample)
{
    const struct stop_beam *beam = trial->beam;
    for (size_t i = 0; i < sample->count && beam->weight == WEIGHT_BEAM; i++) {
        struct pupil_point *point = &sample->points[i];
        point->weight *= stop_beam_density(beam, point->x, point->y);
    }
    for (size_t done = 0; done < sample->count && trial->stop > 0; done += RAYS_BLOCK) {
        size_t here = sample->count - done < RAYS_BLOCK ? sample->count - done : RAYS_BLOCK;
        struct pupil_point *points = sample->points + done;
        if (beam->weight == WEIGHT_PUPIL) {
            weigh_in_stop(trial, points, here);
        }
        go_to_stop(trial, points, here);
        for (size_t i = 0; i < here; i++) {
            double at[2];
            in_stop(trial, i, at);
            points[i].x = at[0];
            points[i].y = at[1];
        }
    }
}

/* Lines from the centre to the edge that points are put on. */
struct arms {
    const double *centre, *angles, *shares;
    const struct edge *edges;
    const struct spans *spans;
    size_t count;
};

/* Gauss's points in r^2 of all clear parts of the arms, one ring of the arms after the other. */
static void put_points(const struct stop_beam *beam, const struct arms *arms, size_t rings,
                       struct arena *arena, struct quadrature *all)
{
    double *r2 = ARENA_ARRAY(arena, rings, double), *w = ARENA_ARRAY(arena, rings, double);
    size_t count = 0;
    size_t most = 0; /* spans of an arm */
    for (size_t k = 0; k < arms->count; k++) {
        count += rings * arms->spans[k].count;
        most = arms->spans[k].count > most ? arms->spans[k].count : most;
    }
    all->sample.points = ARENA_ARRAY(arena, count, struct pupil_point);
    all->rays = rays_new(arena, count);
    gauss_rule(rings, r2, w);
    for (size_t i = 0; i < rings * most * arms->count; i++) {
        size_t k = i % arms->count, ring = i / arms->count % rings;
        size_t span = i / arms->count / rings;
        const struct spans *spans = &arms->spans[k];
        if (span >= spans->count) {
            continue;
        }
        double radius = arms->edges[k].radius, low = spans->low[span], high = spans->high[span];
        double width2 = (high - low) * (high + low), t = sqrt(low * low + width2 * r2[ring]);
        struct pupil_point point = point_at(arms->centre, arms->angles[k], radius * t);
        struct ray ray = start_of(beam, point.x, point.y);
        point.weight = w[ring] * arms->shares[k] * radius * radius * width2;
        rays_set(&all->rays, all->sample.count, beam->system->index_first, &ray);
        all->sample.points[all->sample.count++] = point;
    }
}

struct quadrature quadrature_make(const struct stop_beam *beam, size_t rays, struct arena *arena)
{
    const struct trial trial = trial_open(beam, arena);
    struct star star = {.corner_count = 0};
    struct quadrature all = {.is_empty = !find_centre(&trial, star.centre)};
    if (all.is_empty) {
        return all;
    }
    find_corners(&trial, &star);
    size_t rings = 1;
    while (rings * (2 * rings + 1) < rays) {
        rings++;
    }
    double *angles, *shares;
    size_t arms = spread(&star, 2 * rings + 1, arena, &angles, &shares);
    struct edge *edges = ARENA_ARRAY(arena, arms, struct edge);
    struct spans *spans = ARENA_ARRAY(arena, arms, struct spans);
    find_edges(&trial, star.centre, angles, arms, finely, edges);
    find_spans(&trial, star.centre, angles, edges, arms, spans);
    const struct arms all_arms = {star.centre, angles, shares, edges, spans, arms};
    put_points(beam, &all_arms, rings, arena, &all);
    all.is_empty = all.sample.count == 0;
    name_points(&trial, &all.sample);
    return all;
}
