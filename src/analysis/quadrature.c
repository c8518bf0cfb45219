/* analysis/quadrature.c - rays that integrate over what is clear of a stop. */
/* SPDX-License-Identifier: MIT */
#include "analysis/quadrature.h"

#include "base/constants.h"
#include "trace/dispatch.h"

#include <math.h>

enum { DIRECTIONS = 32, GRID = 24, CORNERS = 8, CORNER_ROUNDS = 5, CORNER_STEPS = 4, STRIDES = 8 };

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
    double corners[CORNERS]; /* rad, ascending */
    size_t corner_count;
};

/* One block of rays. */
struct probe {
    const struct stop_beam *beam;
    size_t stop; /* the place behind the stop; 0 = there is none */
    struct rays work;
};

static struct probe probe_open(const struct stop_beam *beam, struct arena *arena)
{
    bool has_stop = !isnan(beam->radius);
    return (struct probe){beam, has_stop ? system_place(beam->system, beam->system->stop) + 1 : 0,
                          rays_new(arena, RAYS_BLOCK)};
}

static struct ray start_of(const struct stop_beam *beam, double u, double v)
{
    return beam_ray(beam->beam, beam->origin[0] + u * beam->axes[0] + v * beam->axes[1],
                    beam->origin[1] + u * beam->axes[2] + v * beam->axes[3]);
}

/* Up to 128 rays to the stop; there they stand in the block. */
static void go_to_stop(const struct probe *probe, const struct pupil_point *points, size_t count)
{
    const struct stop_beam *beam = probe->beam;
    for (size_t i = 0; i < count; i++) {
        struct ray ray = start_of(beam, points[i].x, points[i].y);
        rays_set(&probe->work, i, beam->system->index_first, &ray);
    }
    rays_trace_part(beam->system, 0, probe->stop, &probe->work, NULL);
}

/* What stops up to 128 rays. */
static void try_points(const struct probe *probe, const struct pupil_point *points, size_t count,
                       size_t *limits)
{
    const struct stop_beam *beam = probe->beam;
    const struct ray_block *block = probe->work.blocks;
    go_to_stop(probe, points, count);
    for (size_t i = 0; i < count; i++) {
        double x = probe->stop > 0 ? block->x[i] / beam->radius : points[i].x;
        double y = probe->stop > 0 ? block->y[i] / beam->radius : points[i].y;
        limits[i] = x * x + y * y > 1 ? STOP : NOTHING;
    }
    rays_trace_part(beam->system, probe->stop, beam->system->places, &probe->work, NULL);
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
static void bracket_edges(const struct probe *probe, const double centre[2], const double *angles,
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
        try_points(probe, points, open, limits);
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
static void bisect(const struct probe *probe, const double centre[2], const double *angles,
                   size_t count, double tolerance, struct edge *edges)
{
    struct pupil_point points[RAYS_BLOCK];
    struct bracket brackets[RAYS_BLOCK];
    size_t limits[RAYS_BLOCK];
    bracket_edges(probe, centre, angles, count, brackets, edges);
    for (bool wide = true; wide;) {
        wide = false;
        for (size_t i = 0; i < count; i++) {
            double middle = (brackets[i].clear + brackets[i].dark) / 2;
            points[i] = point_at(centre, angles[i], middle);
            wide = wide || brackets[i].dark - brackets[i].clear > tolerance;
        }
        try_points(probe, points, count, limits);
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

static void find_edges(const struct probe *probe, const double centre[2], const double *angles,
                       size_t count, double tolerance, struct edge *edges)
{
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        bisect(probe, centre, angles + done, here, tolerance, edges + done);
    }
}

/* The points of a grid that are clear: their centroid, and which is nearest to it. */
static bool search_grid(const struct probe *probe, double centre[2])
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
        try_points(probe, points + done, here, limits + done);
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

static bool find_centre(const struct probe *probe, double centre[2])
{
    const struct pupil_point middle = {0, 0, 0};
    size_t limit;
    centre[0] = centre[1] = 0;
    try_points(probe, &middle, 1, &limit);
    return limit == NOTHING || search_grid(probe, centre);
}

/* Narrow all brackets that hold a corner, each where the clear aperture it begins with ends. */
static void narrow(const struct probe *probe, const double centre[2], const size_t *begins,
                   size_t count, double *low, double *high)
{
    double angles[RAYS_BLOCK];
    struct edge edges[RAYS_BLOCK];
    for (size_t i = 0; i < count * CORNER_STEPS; i++) {
        size_t k = i / CORNER_STEPS;
        double share = (double)(i % CORNER_STEPS + 1) / (CORNER_STEPS + 1);
        angles[i] = low[k] + share * (high[k] - low[k]);
    }
    find_edges(probe, centre, angles, count * CORNER_STEPS, roughly, edges);
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

static void find_corners(const struct probe *probe, struct star *star)
{
    double angles[DIRECTIONS], low[CORNERS], high[CORNERS];
    struct edge edges[DIRECTIONS];
    size_t begins[CORNERS], count = 0;
    for (size_t i = 0; i < DIRECTIONS; i++) {
        angles[i] = 2 * PI * ((double)i + 0.5) / DIRECTIONS;
    }
    find_edges(probe, star->centre, angles, DIRECTIONS, roughly, edges);
    for (size_t i = 0; i < DIRECTIONS; i++) {
        if (edges[i].limit == edges[(i + 1) % DIRECTIONS].limit) {
            continue;
        }
        if (count == CORNERS) {
            return;
        }
        begins[count] = edges[i].limit;
        low[count] = angles[i];
        high[count++] = angles[i] + 2 * PI / DIRECTIONS;
    }
    for (int round = 0; round < CORNER_ROUNDS && count > 0; round++) {
        narrow(probe, star->centre, begins, count, low, high);
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

/*
 * From u, v to the stop's own coordinates, with the area of the stop that an area of u, v fills:
 * four rays about each point.
 */
static void map_to_stop(const struct probe *probe, struct sample *sample)
{
    enum { EACH = 5, AT_ONCE = RAYS_BLOCK / EACH };
    static const double steps[EACH][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    struct pupil_point points[RAYS_BLOCK];
    const struct ray_block *block = probe->work.blocks;
    for (size_t done = 0; done < sample->count; done += AT_ONCE) {
        size_t here = sample->count - done < AT_ONCE ? sample->count - done : AT_ONCE;
        for (size_t i = 0; i < here * EACH; i++) {
            const struct pupil_point *at = &sample->points[done + i / EACH];
            points[i].x = at->x + step * steps[i % EACH][0];
            points[i].y = at->y + step * steps[i % EACH][1];
        }
        go_to_stop(probe, points, here * EACH);
        for (size_t i = 0; i < here; i++) {
            const double *x = block->x + i * EACH, *y = block->y + i * EACH;
            double unit = probe->beam->radius, slope = 1 / (2 * step * unit);
            double area =
                ((x[1] - x[2]) * (y[3] - y[4]) - (x[3] - x[4]) * (y[1] - y[2])) * slope * slope;
            sample->points[done + i] = (struct pupil_point){
                x[0] / unit, y[0] / unit, sample->points[done + i].weight * fabs(area)};
        }
    }
}

struct quadrature quadrature_make(const struct stop_beam *beam, size_t rays, struct arena *arena)
{
    const struct probe probe = probe_open(beam, arena);
    struct star star = {.corner_count = 0};
    struct quadrature all = {.is_empty = !find_centre(&probe, star.centre)};
    if (all.is_empty) {
        return all;
    }
    find_corners(&probe, &star);
    size_t rings = 1;
    while (rings * (2 * rings + 1) < rays) {
        rings++;
    }
    double *r2 = ARENA_ARRAY(arena, rings, double), *w = ARENA_ARRAY(arena, rings, double);
    double *angles, *shares;
    size_t arms = spread(&star, 2 * rings + 1, arena, &angles, &shares);
    struct edge *edges = ARENA_ARRAY(arena, arms, struct edge);
    all.sample.points = ARENA_ARRAY(arena, rings * arms, struct pupil_point);
    all.rays = rays_new(arena, rings * arms);
    gauss_rule(rings, r2, w);
    find_edges(&probe, star.centre, angles, arms, finely, edges);
    for (size_t i = 0; i < rings * arms; i++) {
        size_t ring = i / arms, k = i % arms;
        double radius = edges[k].radius;
        struct pupil_point point = point_at(star.centre, angles[k], radius * sqrt(r2[ring]));
        struct ray ray = start_of(beam, point.x, point.y);
        point.weight = w[ring] * shares[k] * radius * radius;
        rays_set(&all.rays, i, beam->system->index_first, &ray);
        all.sample.points[all.sample.count++] = point;
    }
    if (probe.stop > 0) {
        map_to_stop(&probe, &all.sample);
    }
    return all;
}
