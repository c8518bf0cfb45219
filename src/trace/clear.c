/* trace/clear.c - edges by bisection, a block of rays at a time. */
/* SPDX-License-Identifier: MIT */
#include "trace/clear.h"

#include "trace/dispatch.h"

#include <math.h>

static const double pi = 3.141592653589793;

/* The search: one block of rays, and what is looked at. */
struct probe {
    const struct system *system;
    const struct beam *beam;
    struct rays work;
};

/* Which of up to 128 rays arrive; their fate stays in the block. */
static void try_rays(const struct probe *probe, const double (*at)[2], size_t count)
{
    for (size_t i = 0; i < count; i++) {
        struct ray ray = beam_ray(probe->beam, at[i][0], at[i][1]);
        rays_set(&probe->work, i, probe->beam->n, &ray);
    }
    rays_trace(probe->system, &probe->work, NULL);
}

static bool passes(const struct probe *probe, size_t lane)
{
    return ray_block_status(probe->work.blocks, lane) == RAY_OK;
}

static bool passes_one(const struct probe *probe, const double at[2])
{
    try_rays(probe, (const double(*)[2])at, 1);
    return passes(probe, 0);
}

struct clear_guess clear_guess_of(const struct system *system, const struct beam *beam,
                                  const struct first_order *first)
{
    bool reverse = system->options.reverse;
    double z = reverse ? first->exit_pupil : first->entrance_pupil;
    double scale = reverse ? first->exit_scale : first->entrance_scale;
    double radius = fabs(scale) * system->stop_radius, edge[2];
    bool far = !(fabs(z) <= 1e9);
    struct clear_guess guess = {.radius = radius};
    if (far) {
        /* telecentric: any far plane will do, and the stop's own size */
        z = isnan(z) ? 0 : copysign(1e9, z);
        radius = isfinite(radius) ? radius : system->stop_radius;
    }
    beam_place(beam, (double[3]){0, 0, z}, guess.centre);
    beam_place(beam, (double[3]){radius, 0, z}, edge);
    guess.radius = hypot(edge[0] - guess.centre[0], edge[1] - guess.centre[1]);
    if (!(guess.radius > 0 && guess.radius < 1e100)) {
        guess.radius = 1;
    }
    for (int i = 0; i < 2; i++) {
        guess.centre[i] = isfinite(guess.centre[i]) ? guess.centre[i] : 0;
    }
    return guess;
}

/*
 * A point inside, by a grid of side^2 over `reach` radii: the centroid of those that arrive, which
 * keeps what symmetry there is, or the one nearest to it.
 */
static bool find_inside(const struct probe *probe, const struct clear_guess *guess, double reach,
                        size_t side, double inside[2])
{
    double sum[2] = {0, 0}, best = INFINITY, at[RAYS_BLOCK][2];
    size_t count = 0;
    for (int turn = 0; turn < 2; turn++) {
        for (size_t done = 0; done < side * side; done += RAYS_BLOCK) {
            for (size_t i = 0; i < RAYS_BLOCK; i++) {
                size_t cell[2] = {(done + i) % side, (done + i) / side};
                for (int k = 0; k < 2; k++) {
                    double part = (2 * (double)cell[k] + 1) / (double)side - 1;
                    at[i][k] = guess->centre[k] + part * reach * guess->radius;
                }
            }
            try_rays(probe, (const double(*)[2])at, RAYS_BLOCK);
            for (size_t i = 0; i < RAYS_BLOCK; i++) {
                if (!passes(probe, i)) {
                    continue;
                }
                if (turn == 0) {
                    sum[0] += at[i][0];
                    sum[1] += at[i][1];
                    count++;
                    continue;
                }
                double away =
                    hypot(at[i][0] - sum[0] / (double)count, at[i][1] - sum[1] / (double)count);
                if (away < best) {
                    best = away;
                    inside[0] = at[i][0];
                    inside[1] = at[i][1];
                }
            }
        }
        if (count == 0) {
            return false;
        }
        if (turn == 0) {
            inside[0] = sum[0] / (double)count;
            inside[1] = sum[1] / (double)count;
            if (passes_one(probe, inside)) {
                return true;
            }
        }
    }
    return true;
}

static bool find_centre(const struct probe *probe, const struct clear_guess *guess,
                        double inside[2])
{
    inside[0] = guess->centre[0];
    inside[1] = guess->centre[1];
    if (passes_one(probe, inside)) {
        return true;
    }
    for (size_t side = 32; side <= 512; side *= 4) {
        for (double reach = 1.5; reach < 100; reach *= 4) {
            if (find_inside(probe, guess, reach, side, inside)) {
                return true;
            }
        }
    }
    return false;
}

/* Edges in up to 128 directions from a point inside. */
static void bisect(const struct probe *probe, const double centre[2], double radius,
                   const double *angles, size_t count, struct clear_edge *edges)
{
    double low[RAYS_BLOCK], high[RAYS_BLOCK], at[RAYS_BLOCK][2], way[RAYS_BLOCK][2];
    for (size_t i = 0; i < count; i++) {
        low[i] = 0;
        high[i] = INFINITY;
        way[i][0] = cos(angles[i]);
        way[i][1] = sin(angles[i]);
    }
    for (int step = 0; step < 140; step++) {
        bool busy = false;
        for (size_t i = 0; i < count; i++) {
            /* outwards by doubling, then halves */
            double t = isfinite(high[i]) ? (low[i] + high[i]) / 2
                                         : (low[i] > 0 ? 2 * low[i] : radius / 64);
            busy = busy || high[i] - low[i] > 2e-16 * high[i] || !isfinite(high[i]);
            at[i][0] = centre[0] + t * way[i][0];
            at[i][1] = centre[1] + t * way[i][1];
        }
        if (!busy) {
            break;
        }
        try_rays(probe, (const double(*)[2])at, count);
        for (size_t i = 0; i < count; i++) {
            double t = isfinite(high[i]) ? (low[i] + high[i]) / 2
                                         : (low[i] > 0 ? 2 * low[i] : radius / 64);
            if (passes(probe, i)) {
                low[i] = t;
            } else {
                high[i] = t;
                edges[i].status = ray_block_status(probe->work.blocks, i);
                edges[i].surface = ray_block_surface(probe->work.blocks, i);
            }
        }
    }
    for (size_t i = 0; i < count; i++) {
        edges[i].at[0] = centre[0] + low[i] * way[i][0];
        edges[i].at[1] = centre[1] + low[i] * way[i][1];
    }
}

static double angle_of(size_t i, size_t count)
{
    /* quarter turns exactly, so that axes stay axes */
    return 2 * pi * ((double)i / (double)count) - pi / 2;
}

static void find_edges(const struct probe *probe, const double centre[2], double radius,
                       size_t count, struct clear_edge *edges)
{
    double angles[RAYS_BLOCK];
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        for (size_t i = 0; i < here; i++) {
            angles[i] = angle_of(done + i, count);
        }
        bisect(probe, centre, radius, angles, here, edges + done);
    }
}

/* Centroid of the polygon, about a point inside. */
static void find_centroid(const struct clear_edge *edges, size_t count, const double about[2],
                          double centroid[2])
{
    double twice = 0, moment[2] = {0, 0};
    for (size_t i = 0; i < count; i++) {
        const double *p = edges[i].at, *q = edges[(i + 1) % count].at;
        double px = p[0] - about[0], py = p[1] - about[1];
        double qx = q[0] - about[0], qy = q[1] - about[1];
        double cross = px * qy - qx * py;
        twice += cross;
        moment[0] += cross * (px + qx);
        moment[1] += cross * (py + qy);
    }
    for (int k = 0; k < 2; k++) {
        centroid[k] = about[k] + (twice > 0 ? moment[k] / (3 * twice) : 0);
    }
}

/* Sum of r^2/2 over equal angles: edges are a smooth periodic curve between their corners. */
static double star_area(const struct clear_edge *edges, size_t count, const double about[2])
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        double x = edges[i].at[0] - about[0], y = edges[i].at[1] - about[1];
        sum += x * x + y * y;
    }
    return pi * sum / (double)count;
}

/* The largest of sign * coordinate: the neighbourhood of the extreme edge, in 128 directions. */
static struct clear_edge extreme(const struct probe *probe, const struct clear_pupil *pupil,
                                 double radius, int axis, double sign)
{
    size_t best = 0, count = pupil->edge_count;
    double angles[RAYS_BLOCK], step = 2 * pi / (double)count;
    struct clear_edge edges[RAYS_BLOCK];
    for (size_t i = 1; i < count; i++) {
        best = sign * pupil->edges[i].at[axis] > sign * pupil->edges[best].at[axis] ? i : best;
    }
    struct clear_edge found = pupil->edges[best];
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        angles[i] = angle_of(best, count) + step * (2 * (double)i / (RAYS_BLOCK - 1) - 1);
    }
    bisect(probe, pupil->centre, radius, angles, RAYS_BLOCK, edges);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        found = sign * edges[i].at[axis] > sign * found.at[axis] ? edges[i] : found;
    }
    return found;
}

void clear_find(const struct system *system, const struct beam *beam,
                const struct clear_guess *guess, size_t directions, struct arena *arena,
                struct clear_pupil *pupil)
{
    const struct probe probe = {system, beam, rays_new(arena, RAYS_BLOCK)};
    struct clear_edge *edges = ARENA_ARRAY(arena, directions, struct clear_edge);
    double inside[2], centroid[2];
    *pupil = (struct clear_pupil){.edges = edges, .edge_count = directions};
    pupil->is_empty = !find_centre(&probe, guess, inside);
    if (pupil->is_empty) {
        return;
    }
    /* a centre needs no more directions than one block has */
    size_t few = directions < RAYS_BLOCK ? directions : RAYS_BLOCK;
    find_edges(&probe, inside, guess->radius, few, edges);
    find_centroid(edges, few, inside, centroid);
    if (passes_one(&probe, centroid)) {
        inside[0] = fabs(centroid[0]) < 1e-12 * guess->radius ? 0 : centroid[0];
        inside[1] = centroid[1];
    }
    find_edges(&probe, inside, guess->radius, directions, edges);
    pupil->area = star_area(edges, directions, inside);
    for (int k = 0; k < 2; k++) {
        pupil->centre[k] = inside[k];
    }
    for (int k = 0; k < 2; k++) {
        pupil->ends[k] = extreme(&probe, pupil, guess->radius, k, 1);
        pupil->ends[k + 2] = extreme(&probe, pupil, guess->radius, k, -1);
        pupil->low[k] = pupil->ends[k + 2].at[k];
        pupil->high[k] = pupil->ends[k].at[k];
    }
}

bool clear_on_plane(const struct beam *beam, const double at[2], double z, double point[2])
{
    struct ray ray = beam_ray(beam, at[0], at[1]);
    double t = (z - ray.point[2]) / ray.cosine[2];
    point[0] = ray.point[0] + t * ray.cosine[0];
    point[1] = ray.point[1] + t * ray.cosine[1];
    return isfinite(point[0]) && isfinite(point[1]);
}
