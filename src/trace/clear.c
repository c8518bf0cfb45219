/* trace/clear.c - edges by bisection, a block of rays at a time. */
/* SPDX-License-Identifier: MIT */
#include "trace/clear.h"

#include "base/constants.h"
#include "trace/probe.h"
#include "trace/sample.h"
#include "trace/spans.h"

#include <math.h>

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

/* Between which radii the edge of one direction lies; the outer one infinite before it is known. */
struct span {
    double low, high;
};

/*
 * The k-th of `parts` radii to try: cuts of the span, or outwards: by eighths of the radius to
 * twice that, so that no gap is passed over with light behind it, then by doubling.
 */
static double part_of(const struct span *span, double radius, size_t k, size_t parts)
{
    if (isfinite(span->high)) {
        return span->low + (span->high - span->low) * ((double)(k + 1) / (double)(parts + 1));
    }
    double even = span->low + (double)(k + 1) * (radius / 8), far = 2 * radius;
    if (even <= far * (1 + 1e-9)) {
        return even;
    }
    /* how many have stayed below */
    double below = span->low < far ? floor((far - span->low) / (radius / 8) + 1e-9) : 0;
    return ldexp(span->low < far ? far : span->low, (int)(k + 1) - (int)below);
}

static bool is_open(const struct span *span)
{
    return !isfinite(span->high) || span->high - span->low > 2e-16 * span->high;
}

/* Keep the part in which the first ray is lost; `lanes` rays of this direction begin at `first`. */
static void narrow(const struct probe *probe, double radius, size_t first, size_t lanes,
                   struct span *span, struct clear_edge *edge)
{
    const struct span before = *span;
    for (size_t k = 0; k < lanes; k++) {
        double t = part_of(&before, radius, k, lanes);
        if (!(t > span->low && t < span->high)) {
            continue; /* nothing lies between */
        }
        if (!probe_passes(probe, first + k)) {
            span->high = t;
            edge->status = ray_block_status(probe->work.blocks, first + k);
            edge->surface = ray_block_surface(probe->work.blocks, first + k);
            return;
        }
        span->low = t;
    }
}

/* Edges in up to 128 directions from a point inside: the fewer, the more parts each step has. */
static void find_ends(const struct probe *probe, const double centre[2], double radius,
                      const double (*way)[2], size_t count, struct clear_edge *edges)
{
    double at[RAYS_BLOCK][2];
    struct span spans[RAYS_BLOCK];
    const size_t lanes = RAYS_BLOCK / count;
    for (size_t i = 0; i < count; i++) {
        spans[i] = (struct span){0, INFINITY};
    }
    bool busy = true;
    for (int step = 0; step < 140 && busy; step++) {
        for (size_t i = 0; i < count * lanes; i++) {
            double t = part_of(&spans[i / lanes], radius, i % lanes, lanes);
            at[i][0] = centre[0] + t * way[i / lanes][0];
            at[i][1] = centre[1] + t * way[i / lanes][1];
        }
        probe_try(probe, (const double(*)[2])at, count * lanes);
        busy = false;
        for (size_t i = 0; i < count; i++) {
            struct span before = spans[i];
            narrow(probe, radius, i * lanes, lanes, &spans[i], &edges[i]);
            bool moved = spans[i].low > before.low || spans[i].high < before.high;
            busy = busy || (moved && is_open(&spans[i]));
        }
    }
    for (size_t i = 0; i < count; i++) {
        edges[i].at[0] = centre[0] + spans[i].low * way[i][0];
        edges[i].at[1] = centre[1] + spans[i].low * way[i][1];
        edges[i].part = 0;
    }
}

/* What edges are looked for from: angles are those of a circle stretched to the shape. */
struct star {
    double centre[2], stretch[2]; /* mm; the larger stretch is 1 */
    double radius;                /* about its size, mm */
};

/* What ends the rays more closely than a surface does, and what they meet on their way. */
static void tell_parts(const struct probe *probe, const struct star *star, size_t count,
                       struct clear_edge *edges)
{
    double at[RAYS_BLOCK][2];
    struct spans spans[RAYS_BLOCK];
    if (probe->system->clips == NULL) {
        return;
    }
    for (size_t i = 0; i < count; i++) {
        at[i][0] = edges[i].at[0];
        at[i][1] = edges[i].at[1];
    }
    probe_parts(probe, (const double(*)[2])at, count, edges);
    if (probe->full != NULL) {
        spans_find(probe, star->centre, (const double(*)[2])at, count, spans);
        for (size_t i = 0; i < count; i++) {
            edges[i].part = edges[i].part * 1000003 + spans[i].part;
        }
    }
}

static void bisect(const struct probe *probe, const struct star *star, const double *angles,
                   size_t count, struct clear_edge *edges)
{
    double way[RAYS_BLOCK][2];
    for (size_t i = 0; i < count; i++) {
        way[i][0] = star->stretch[0] * cos(angles[i]);
        way[i][1] = star->stretch[1] * sin(angles[i]);
    }
    find_ends(probe, star->centre, star->radius, (const double(*)[2])way, count, edges);
}

static double angle_of(size_t i, size_t count)
{
    /* quarter turns exactly, so that axes stay axes */
    return 2 * PI * ((double)i / (double)count) - PI / 2;
}

static void find_edges(const struct probe *probe, const struct star *star, size_t count,
                       struct clear_edge *edges)
{
    double angles[RAYS_BLOCK];
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        for (size_t i = 0; i < here; i++) {
            angles[i] = angle_of(done + i, count);
        }
        bisect(probe, star, angles, here, edges + done);
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

/* The largest of sign * coordinate: the neighbourhood of the extreme edge, in 128 directions. */
static struct clear_edge extreme(const struct probe *probe, const struct star *star,
                                 const struct clear_pupil *pupil, int axis, double sign)
{
    size_t best = 0, count = pupil->edge_count;
    double angles[RAYS_BLOCK], step = 2 * PI / (double)count;
    struct clear_edge edges[RAYS_BLOCK];
    for (size_t i = 1; i < count; i++) {
        best = sign * pupil->edges[i].at[axis] > sign * pupil->edges[best].at[axis] ? i : best;
    }
    struct clear_edge found = pupil->edges[best];
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        angles[i] = angle_of(best, count) + step * (2 * (double)i / (RAYS_BLOCK - 1) - 1);
    }
    bisect(probe, star, angles, RAYS_BLOCK, edges);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        found = sign * edges[i].at[axis] > sign * found.at[axis] ? edges[i] : found;
    }
    return found;
}

/* -------- corners -------- */

/* Two angles with a corner between them, and the edges there. */
struct corner {
    double low, high;
    struct clear_edge before, after;
};

static bool is_same_edge(const struct clear_edge *a, const struct clear_edge *b)
{
    return a->surface == b->surface && a->status == b->status && a->part == b->part;
}

/* Where the limiting surface changes; returns most + 1 if that is more often. */
static size_t find_changes(const struct clear_edge *edges, size_t count, size_t most,
                           struct corner *corners)
{
    size_t found = 0;
    for (size_t i = 0; i < count && found <= most; i++) {
        const struct clear_edge *next = &edges[(i + 1) % count];
        if (is_same_edge(&edges[i], next)) {
            continue;
        }
        if (found < most) {
            corners[found] =
                (struct corner){angle_of(i, count), angle_of(i + 1, count), edges[i], *next};
        }
        found++;
    }
    return found;
}

/* Narrow all corners at once, to a few parts each a turn. */
static void close_corners(const struct probe *probe, const struct star *star,
                          struct corner *corners, size_t count)
{
    const size_t parts = RAYS_BLOCK / count;
    double angles[RAYS_BLOCK] = {0};
    struct clear_edge edges[RAYS_BLOCK];
    /* from 2 pi/64 to 1e-7 and less */
    int turns = (int)ceil(log(1e6) / log((double)parts + 1));
    for (int turn = 0; turn < turns; turn++) {
        for (size_t i = 0; i < count * parts; i++) {
            const struct corner *corner = &corners[i / parts];
            double share = (double)(i % parts + 1) / (double)(parts + 1);
            angles[i] = corner->low + share * (corner->high - corner->low);
        }
        bisect(probe, star, angles, count * parts, edges);
        tell_parts(probe, star, count * parts, edges);
        for (size_t i = 0; i < count * parts; i++) {
            struct corner *corner = &corners[i / parts];
            if (angles[i] < corner->low || angles[i] > corner->high) {
                continue; /* decided by one before it */
            }
            if (is_same_edge(&edges[i], &corner->before)) {
                corner->low = angles[i];
                corner->before = edges[i];
            } else {
                corner->high = angles[i];
                corner->after = edges[i];
            }
        }
    }
}

/*
 * Corners with another one behind them before the next direction that was looked in: those of the
 * arms of a spider lie close together. Returns how many corners there are then, in their order.
 */
static size_t part_corners(const struct probe *probe, const struct star *star,
                           const struct clear_edge *edges, size_t directions,
                           struct corner *corners, size_t count)
{
    enum { ROUNDS = 6 };
    size_t first = 0;
    for (int round = 0; round < ROUNDS && probe->system->clips != NULL; round++) {
        struct corner more[CLEAR_CUTS];
        size_t found = 0;
        for (size_t i = first; i < count && count + found < CLEAR_CUTS; i++) {
            size_t next = (size_t)ceil((corners[i].high + PI / 2) / (2 * PI) * (double)directions);
            const struct clear_edge *edge = &edges[next % directions];
            if (!is_same_edge(&corners[i].after, edge) &&
                angle_of(next, directions) > corners[i].high) {
                more[found++] = (struct corner){corners[i].high, angle_of(next, directions),
                                                corners[i].after, *edge};
            }
        }
        if (found == 0) {
            break;
        }
        close_corners(probe, star, more, found);
        for (size_t i = 0; i < found; i++) {
            corners[count + i] = more[i];
        }
        first = count;
        count += found;
    }
    for (size_t i = 1; i < count; i++) {
        struct corner corner = corners[i];
        size_t k = i;
        for (; k > 0 && corners[k - 1].low > corner.low; k--) {
            corners[k] = corners[k - 1];
        }
        corners[k] = corner;
    }
    return count;
}

/* Gauss's points between the corners. */
static void put_arcs(const struct probe *probe, const struct star *star,
                     const struct corner *corners, size_t count, struct arena *arena,
                     struct clear_pupil *pupil)
{
    double x[CLEAR_ARC], w[CLEAR_ARC], angles[RAYS_BLOCK];
    struct clear_edge edges[RAYS_BLOCK];
    struct clear_arm *arms = ARENA_ARRAY(arena, count * CLEAR_ARC, struct clear_arm);
    double *widths = ARENA_ARRAY(arena, count, double);
    gauss_rule(CLEAR_ARC, x, w);
    for (size_t done = 0; done < count * CLEAR_ARC; done += RAYS_BLOCK) {
        size_t left = count * CLEAR_ARC - done, here = left < RAYS_BLOCK ? left : RAYS_BLOCK;
        for (size_t i = 0; i < here; i++) {
            size_t arc = (done + i) / CLEAR_ARC, k = (done + i) % CLEAR_ARC;
            double from = (corners[arc].low + corners[arc].high) / 2;
            const struct corner *next = &corners[(arc + 1) % count];
            double to = (next->low + next->high) / 2 + (arc + 1 == count ? 2 * PI : 0);
            double share = x[k], slope = 1;
            if (pupil->is_cut) {
                share = (1 - cos(PI * x[k])) / 2;
                slope = PI / 2 * sin(PI * x[k]);
            }
            angles[i] = from + share * (to - from);
            widths[arc] = to - from;
            arms[done + i].area = w[k] * slope * (to - from);
        }
        bisect(probe, star, angles, here, edges);
        for (size_t i = 0; i < here; i++) {
            arms[done + i].edge = edges[i];
        }
    }
    pupil->arms = arms;
    pupil->arm_count = count * CLEAR_ARC;
    pupil->arcs = count;
    pupil->arc_angles = widths;
    struct clear_edge *tips = ARENA_ARRAY(arena, 2 * count, struct clear_edge);
    for (size_t i = 0; i < count; i++) {
        tips[2 * i] = corners[i].before;
        tips[2 * i + 1] = corners[i].after;
    }
    pupil->corners = tips;
}

/* All edges alike. */
static void put_circle(struct arena *arena, struct clear_pupil *pupil)
{
    struct clear_arm *arms = ARENA_ARRAY(arena, pupil->edge_count, struct clear_arm);
    for (size_t i = 0; i < pupil->edge_count; i++) {
        arms[i] = (struct clear_arm){pupil->edges[i], 2 * PI / (double)pupil->edge_count, NULL};
    }
    pupil->arms = arms;
    pupil->arm_count = pupil->edge_count;
}

/* What is clear of each arm. */
static void cut_arms(const struct probe *probe, const struct star *star, struct arena *arena,
                     struct clear_pupil *pupil)
{
    double(*at)[2] = arena_array(arena, pupil->arm_count, sizeof *at);
    struct spans *spans = ARENA_ARRAY(arena, pupil->arm_count, struct spans);
    for (size_t i = 0; i < pupil->arm_count; i++) {
        at[i][0] = pupil->arms[i].edge.at[0];
        at[i][1] = pupil->arms[i].edge.at[1];
        pupil->arms[i].spans = pupil->is_cut ? &spans[i] : &spans_whole;
    }
    if (pupil->is_cut) {
        spans_find(probe, star->centre, (const double(*)[2])at, pupil->arm_count, spans);
    }
}

/* The share of an arm's area that is clear. */
static double clear_share(const struct spans *spans)
{
    double share = 0;
    for (size_t i = 0; i < spans->count; i++) {
        double low = spans->low[i], high = spans->high[i];
        share += (high - low) * (high + low);
    }
    return share;
}

/* From angles to areas: r^2/2 of each, in stretched coordinates. */
static void sum_area(const struct star *star, struct clear_pupil *pupil)
{
    struct clear_arm *arms = pupil->arms;
    pupil->area = pupil->within = 0;
    for (size_t i = 0; i < pupil->arm_count; i++) {
        double x = (arms[i].edge.at[0] - star->centre[0]) / star->stretch[0];
        double y = (arms[i].edge.at[1] - star->centre[1]) / star->stretch[1];
        arms[i].area *= star->stretch[0] * star->stretch[1] * (x * x + y * y) / 2;
        pupil->area += arms[i].area * clear_share(arms[i].spans);
        pupil->within += arms[i].area;
    }
}

/* Arms for integrals, the area by them, and the bounds. */
static void measure(const struct probe *probe, const struct star *star, struct arena *arena,
                    struct clear_pupil *pupil)
{
    struct corner corners[CLEAR_CUTS];
    size_t most = probe->system->clips != NULL ? CLEAR_CUTS : CLEAR_CORNERS;
    size_t count = find_changes(pupil->edges, pupil->edge_count, most, corners);
    /* a surface that is the last in no direction but one has no arc of its own */
    if (count >= 2 && count <= most) {
        close_corners(probe, star, corners, count);
        count = part_corners(probe, star, pupil->edges, pupil->edge_count, corners, count);
        put_arcs(probe, star, corners, count, arena, pupil);
    } else {
        put_circle(arena, pupil);
    }
    cut_arms(probe, star, arena, pupil);
    sum_area(star, pupil);
    pupil->is_empty = !(pupil->area > 0);
    for (int k = 0; k < 4; k++) {
        int axis = k % 2;
        double sign = k < 2 ? 1 : -1;
        pupil->ends[k] = extreme(probe, star, pupil, axis, sign);
        for (size_t i = 0; i < 2 * pupil->arcs; i++) {
            const struct clear_edge *edge = &pupil->corners[i];
            bool beyond = sign * edge->at[axis] > sign * pupil->ends[k].at[axis];
            pupil->ends[k] = beyond ? *edge : pupil->ends[k];
        }
        (k < 2 ? pupil->high : pupil->low)[axis] = pupil->ends[k].at[axis];
    }
}

/* Move the centre to the centroid, and stretch the circle as the edges are; is it as it was? */
static bool fit_star(const struct probe *probe, const struct clear_edge *edges, size_t count,
                     struct star *star)
{
    double centroid[2], size[2], before = star->stretch[0] / star->stretch[1];
    find_centroid(edges, count, star->centre, centroid);
    for (int k = 0; k < 2; k++) {
        double low = edges[0].at[k], high = low;
        for (size_t i = 1; i < count; i++) {
            low = fmin(low, edges[i].at[k]);
            high = fmax(high, edges[i].at[k]);
        }
        size[k] = high - low;
        /* what symmetry makes 0 */
        centroid[k] = fabs(centroid[k]) < 1e-12 * size[k] ? 0 : centroid[k];
    }
    if (!(size[0] > 0 && size[1] > 0)) {
        return true;
    }
    if (probe_passes_one(probe, centroid)) {
        star->centre[0] = centroid[0];
        star->centre[1] = centroid[1];
    }
    double largest = fmax(size[0], size[1]);
    star->radius = largest / 2;
    for (int k = 0; k < 2; k++) {
        star->stretch[k] = size[k] / largest;
    }
    double change = star->stretch[0] / star->stretch[1] / before;
    return change < 2 && change > 0.5;
}

void clear_find(const struct system *system, const struct beam *beam,
                const struct clear_guess *guess, size_t directions, struct arena *arena,
                struct clear_pupil *pupil)
{
    enum { FITS = 12 };
    const struct probe probe = probe_open(system, beam, arena);
    struct star star = {.stretch = {1, 1}, .radius = guess->radius};
    struct clear_edge *edges = ARENA_ARRAY(arena, directions, struct clear_edge);
    *pupil = (struct clear_pupil){
        .is_cut = probe.full != NULL, .edges = edges, .edge_count = directions};
    pupil->is_empty = !probe_inside(&probe, guess, star.centre);
    if (pupil->is_empty) {
        return;
    }
    /* a centre needs no more directions than one block has; a sliver is met from few at first */
    size_t few = directions < RAYS_BLOCK ? directions : RAYS_BLOCK;
    for (int fit = 0; fit < FITS; fit++) {
        find_edges(&probe, &star, few, edges);
        if (fit_star(&probe, edges, few, &star)) {
            break;
        }
    }
    find_edges(&probe, &star, directions, edges);
    for (size_t done = 0; done < directions; done += RAYS_BLOCK) {
        size_t here = directions - done < RAYS_BLOCK ? directions - done : RAYS_BLOCK;
        tell_parts(&probe, &star, here, edges + done);
    }
    for (int k = 0; k < 2; k++) {
        pupil->centre[k] = star.centre[k];
    }
    measure(&probe, &star, arena, pupil);
}
