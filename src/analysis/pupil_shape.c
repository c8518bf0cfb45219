/* analysis/pupil_shape.c - edges of a beam taken to both sides of the lens. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil_shape.h"

#include "trace/aim.h"
#include "trace/clear.h"
#include "trace/dispatch.h"
#include "trace/sample.h"

#include <math.h>

static const double pi = 3.141592653589793;

/* Below this direction cosine a plane across the axis counts as not met: 89.9 degrees. */
static const double ALONG = 1.7e-3;

/* -------- the chief ray -------- */

/* Where a ray of the beam crosses the stop; false where it is lost. */
static bool in_stop(const struct system *system, const struct beam *beam, const struct rays *work,
                    const double at[2], double point[2])
{
    struct ray ray = beam_ray(beam, at[0], at[1]);
    rays_set(work, 0, beam->n, &ray);
    rays_trace_part(system, 0, system_place(system, system->stop) + 1, work, NULL);
    double own[3] = {work->blocks->x[0], work->blocks->y[0], work->blocks->z[0]};
    system_to_own(system, system->stop, own);
    point[0] = own[0];
    point[1] = own[1];
    return ray_block_status(work->blocks, 0) == RAY_OK;
}

/* One step of Newton's method towards the centre of the stop, by differences; halved as needed. */
static bool step_to_stop(const struct pupil_question *question, const struct rays *work,
                         double size, double at[2], double *miss)
{
    const struct system *system = question->open;
    const struct beam *beam = question->beam;
    double here[2], right[2], upper[2], h = 1e-5 * size;
    if (!in_stop(system, beam, work, at, here) ||
        !in_stop(system, beam, work, (double[2]){at[0] + h, at[1]}, right) ||
        !in_stop(system, beam, work, (double[2]){at[0], at[1] + h}, upper)) {
        return false;
    }
    *miss = hypot(here[0], here[1]);
    double m[4] = {(right[0] - here[0]) / h, (upper[0] - here[0]) / h, (right[1] - here[1]) / h,
                   (upper[1] - here[1]) / h};
    double det = m[0] * m[3] - m[1] * m[2];
    double move[2] = {(m[1] * here[1] - m[3] * here[0]) / det,
                      (m[2] * here[0] - m[0] * here[1]) / det};
    for (double scale = 1; scale > 1e-6; scale /= 2) {
        double next[2] = {at[0] + scale * move[0], at[1] + scale * move[1]}, there[2];
        if (in_stop(system, beam, work, next, there) && hypot(there[0], there[1]) < *miss) {
            at[0] = next[0];
            at[1] = next[1];
            *miss = hypot(there[0], there[1]);
            return true;
        }
    }
    return false;
}

/* From a film point: image sides are mild, so Newton's method from the paraxial pupil will do. */
static bool chief_from_film(const struct pupil_question *question, const struct clear_guess *guess,
                            struct arena *arena, double at[2])
{
    struct rays work = rays_new(arena, 1);
    double miss = INFINITY, size = guess->radius;
    at[0] = guess->centre[0];
    at[1] = guess->centre[1];
    for (int step = 0; step < 60; step++) {
        if (!step_to_stop(question, &work, size, at, &miss)) {
            break;
        }
    }
    return miss <= 1e-9 * question->open->stop_radius;
}

static bool find_chief(const struct pupil_question *question, const struct clear_guess *guess,
                       struct arena *arena, double at[2])
{
    struct aim aim;
    struct error ignored;
    if (question->open->options.reverse) {
        return chief_from_film(question, guess, arena, at);
    }
    if (!aim_open(question->open, question->beam, arena, &aim, &ignored)) {
        at[0] = guess->centre[0];
        at[1] = guess->centre[1];
        return false;
    }
    at[0] = aim.chief[0];
    at[1] = aim.chief[1];
    return true;
}

/* -------- outlines -------- */

/* Where a line crosses z = const; NaN where it runs along it, or the other way. */
static void cross(const struct ray *ray, double z, double heading, double point[2])
{
    double t = (z - ray->point[2]) / ray->cosine[2];
    bool meets = ray->cosine[2] * heading > ALONG;
    for (int i = 0; i < 2; i++) {
        point[i] = meets ? ray->point[i] + t * ray->cosine[i] : (double)NAN;
    }
}

/*
 * The largest of sign * coordinate: a parabola through the extreme point and its neighbours, or one
 * of the extreme edges behind them, which find corners.
 */
static double extreme(const double (*points)[2], size_t count, int axis, double sign, size_t *which)
{
    size_t best = 0;
    for (size_t i = 1; i < count; i++) {
        best = sign * points[i][axis] > sign * points[best][axis] ? i : best;
    }
    double before = points[(best + count - 1) % count][axis], here = points[best][axis];
    double after = points[(best + 1) % count][axis], bend = before - 2 * here + after;
    double slope = (after - before) / 2, more = -slope * slope / (2 * bend);
    *which = best;
    /* at a corner the neighbours say nothing of the peak */
    bool smooth = isfinite(more) && fabs(slope) <= 0.5000001 * fabs(bend) && sign * more > 0;
    here = smooth ? here + more : here;
    for (size_t i = count; i < count + PUPIL_ENDS; i++) {
        here = sign * points[i][axis] > sign * here ? points[i][axis] : here;
    }
    return here;
}

/* Bounds, area and centroid of an outline. */
static void measure(const double (*points)[2], size_t count, struct pupil_extent *extent,
                    size_t limit[PUPIL_ENDS])
{
    double twice = 0, moment[2] = {0, 0};
    const double *o = points[0];
    for (size_t i = 0; i < count; i++) {
        const double *p = points[i], *q = points[(i + 1) % count];
        double px = p[0] - o[0], py = p[1] - o[1], qx = q[0] - o[0], qy = q[1] - o[1];
        double twist = px * qy - qx * py;
        twice += twist;
        moment[0] += twist * (px + qx);
        moment[1] += twist * (py + qy);
    }
    double turn = 2 * pi / (double)count;
    extent->area = fabs(twice) / 2 * (turn / sin(turn));
    for (int k = 0; k < 2; k++) {
        extent->centre[k] = o[k] + moment[k] / (3 * twice);
        extent->high[k] = extreme(points, count, k, 1, &limit[k]);
        extent->low[k] = extreme(points, count, k, -1, &limit[k + 2]);
        /* what symmetry makes 0 */
        double small = 1e-12 * (extent->high[k] - extent->low[k]);
        extent->centre[k] = fabs(extent->centre[k]) < small ? 0 : extent->centre[k];
    }
    extent->outline = points;
}

/* The outline of rays in a plane, with its limits as numbers of edges. */
static void look_at(const struct ray *rays, size_t count, double z, double heading,
                    struct arena *arena, struct pupil_extent *extent, size_t limit[PUPIL_ENDS])
{
    double(*points)[2] = arena_array(arena, count + PUPIL_ENDS, sizeof *points);
    bool met = isfinite(z);
    *extent = (struct pupil_extent){.z = z};
    for (size_t i = 0; i < count + PUPIL_ENDS; i++) {
        cross(&rays[i], met ? z : 0, heading, points[i]);
        met = met && isfinite(points[i][0]) && isfinite(points[i][1]);
    }
    for (size_t i = 0; i < PUPIL_ENDS; i++) {
        limit[i] = count;
    }
    if (met) {
        measure((const double(*)[2])points, count, extent, limit);
        return;
    }
    extent->area = extent->low[0] = extent->low[1] = extent->high[0] = extent->high[1] = NAN;
    extent->centre[0] = extent->centre[1] = NAN;
}

/* -------- integrals over the beam -------- */

/* Area in the plane of the beam, in a plane across the axis, or of direction cosines. */
enum measure { ACROSS, IN_PLANE, COSINES };

/* What a bit of the beam's plane counts; see the header. */
static double weight(const struct beam *beam, const double at[2], enum measure what, double z)
{
    struct ray ray = beam_ray(beam, at[0], at[1]);
    double cosine = fabs(ray.cosine[2]), d = fabs(beam->distance);
    if (what == ACROSS) {
        return 1;
    }
    if (isinf(d)) {
        return what == IN_PLANE ? 1 / cosine : (double)NAN;
    }
    double rho = sqrt(d * d + at[0] * at[0] + at[1] * at[1]);
    double facing = d / (rho * rho * rho), way = z + beam->axis[2] * beam->distance;
    return what == COSINES ? facing * cosine : facing * way * way / (cosine * cosine * cosine);
}

/* Over the star of the edges: equal angles, Gauss's points along each. */
static double integrate(const struct beam *beam, const struct clear_pupil *clear, enum measure what,
                        double z)
{
    enum { POINTS = 8 };
    double x[POINTS], w[POINTS], sum = 0;
    gauss_rule(POINTS, x, w);
    for (size_t i = 0; i < clear->edge_count; i++) {
        const double *edge = clear->edges[i].at, *c = clear->centre;
        double arm[2] = {edge[0] - c[0], edge[1] - c[1]}, along = 0;
        for (size_t k = 0; k < POINTS; k++) {
            const double at[2] = {c[0] + x[k] * arm[0], c[1] + x[k] * arm[1]};
            along += w[k] * x[k] * weight(beam, at, what, z);
        }
        sum += along * (arm[0] * arm[0] + arm[1] * arm[1]);
    }
    return sum * 2 * pi / (double)clear->edge_count;
}

/* -------- both sides -------- */

/* Behind the edges come the extreme ones, found in finer steps, and last the chief ray. */
static size_t ray_count(const struct clear_pupil *clear)
{
    return clear->edge_count + PUPIL_ENDS + 1;
}

static const double *place_of(const struct clear_pupil *clear, const double chief[2], size_t i)
{
    size_t count = clear->edge_count;
    return i < count                ? clear->edges[i].at
           : i < count + PUPIL_ENDS ? clear->ends[i - count].at
                                    : chief;
}

/* All edges and the chief ray, through to the stop or to the other side. */
static struct ray *trace_edges(const struct pupil_question *question,
                               const struct clear_pupil *clear, const double chief[2], size_t to,
                               struct arena *arena)
{
    const struct system *system = question->open;
    size_t count = ray_count(clear);
    struct rays rays = rays_new(arena, count);
    struct ray *out = ARENA_ARRAY(arena, count, struct ray);
    double n = to == 0 ? question->beam->n : system_index_after(system, to - 1);
    for (size_t i = 0; i < count; i++) {
        const double *at = place_of(clear, chief, i);
        struct ray ray = beam_ray(question->beam, at[0], at[1]);
        rays_set(&rays, i, question->beam->n, &ray);
    }
    if (to > 0) {
        rays_trace_part(system, 0, to, &rays, NULL);
    }
    for (size_t i = 0; i < count; i++) {
        out[i] = rays_get(&rays, i, n);
    }
    return out;
}

/* What the rays do on one side; the last of them is the chief ray. */
static void fill_side(const struct clear_pupil *clear, const struct ray *rays, bool has_chief,
                      double z, double heading, struct arena *arena, struct pupil_side *side)
{
    size_t count = clear->edge_count, ends[PUPIL_ENDS], vertex[PUPIL_ENDS];
    look_at(rays, count, z, heading, arena, &side->pupil, ends);
    look_at(rays, count, 0, heading, arena, &side->vertex, vertex);
    for (size_t i = 0; i < PUPIL_ENDS; i++) {
        size_t edge = ends[i] < count ? ends[i] : vertex[i];
        side->limit[i] = edge < count ? clear->edges[edge].surface : 0;
    }
    side->chief = rays[count + PUPIL_ENDS];
    if (!has_chief || side->chief.status == RAY_MISS) {
        side->chief = (struct ray){.point = {NAN, NAN, NAN}, .cosine = {NAN, NAN, NAN}};
    } else if (side->chief.cosine[2] * heading > ALONG) {
        cross(&rays[count + PUPIL_ENDS], 0, heading, side->chief.point);
        side->chief.point[2] = 0;
    }
}

/* The limits of a side that the beam does not cross: by the beam's own directions. */
static void limit_by_beam(const struct clear_pupil *clear, struct pupil_side *side)
{
    static const size_t quarter[PUPIL_ENDS] = {1, 2, 3, 0}; /* edges begin below */
    for (size_t i = 0; i < PUPIL_ENDS; i++) {
        if (side->limit[i] == 0) {
            side->limit[i] = clear->edges[quarter[i] * clear->edge_count / 4].surface;
        }
    }
}

static void fill_stop(const struct pupil_question *question, const struct clear_pupil *clear,
                      const double chief[2], struct arena *arena, struct pupil_shape *shape)
{
    const struct system *system = question->open;
    size_t count = clear->edge_count, which, to = system_place(system, system->stop) + 1;
    const struct ray *rays = trace_edges(question, clear, chief, to, arena);
    double(*points)[2] = arena_array(arena, count + PUPIL_ENDS, sizeof *points);
    double(*across)[2] = arena_array(arena, count + PUPIL_ENDS, sizeof *across);
    for (size_t i = 0; i < count + PUPIL_ENDS; i++) {
        double own[3] = {rays[i].point[0], rays[i].point[1], rays[i].point[2]};
        system_to_own(system, system->stop, own);
        for (int k = 0; k < 2; k++) {
            points[i][k] = own[k] / system->stop_radius;
            across[i][k] = place_of(clear, chief, i)[k] - chief[k];
        }
    }
    shape->stop = (const double(*)[2])points;
    shape->across = (const double(*)[2])across;
    for (int k = 0; k < 2; k++) {
        double high = extreme(shape->stop, count, k, 1, &which);
        double low = extreme(shape->stop, count, k, -1, &which);
        shape->vignetting[k] = fabs(1 - high) < 1e-6 ? 0 : 1 - high;
        shape->vignetting[k + 2] = fabs(1 + low) < 1e-6 ? 0 : 1 + low;
    }
}

/* What stops the chief ray, or the middle of the beam where there is no chief ray. */
static void explain_loss(const struct pupil_question *question, const double at[2],
                         struct arena *arena, struct pupil_shape *shape)
{
    struct rays work = rays_new(arena, 1);
    struct ray ray = beam_ray(question->beam, at[0], at[1]);
    rays_set(&work, 0, question->beam->n, &ray);
    rays_trace(question->clipped, &work, NULL);
    shape->status = ray_block_status(work.blocks, 0);
    shape->surface = ray_block_surface(work.blocks, 0);
}

bool pupil_shape(const struct pupil_question *question, struct arena *arena,
                 struct pupil_shape *shape, struct error *error)
{
    const struct system *open = question->open;
    const struct beam *beam = question->beam;
    bool reverse = open->options.reverse;
    struct clear_pupil clear;
    double chief[2];
    if (open->stop == LENS_NONE) {
        return fail(error, ERROR_DOMAIN, "the lens has no stop, and so no pupil");
    }
    if (!(open->stop_radius > 0)) {
        fail(error, ERROR_DOMAIN, "the stop has no diameter: the size of the pupil is not known");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    struct clear_guess guess = clear_guess_of(question->clipped, beam, question->first);
    *shape = (struct pupil_shape){.count = question->directions};
    shape->has_chief = find_chief(question, &guess, arena, chief);
    explain_loss(question, chief, arena, shape);
    guess.centre[0] = chief[0];
    guess.centre[1] = chief[1];
    clear_find(question->clipped, beam, &guess, question->directions, arena, &clear);
    /* the centre, the edges and four bounds, by bisection in about 60 steps */
    shape->rays = 60 * (question->directions + 5 * RAYS_BLOCK);
    shape->is_empty = clear.is_empty;
    if (clear.is_empty) {
        return true;
    }
    const double *middle = shape->has_chief ? chief : clear.centre;
    const struct ray *in = trace_edges(question, &clear, middle, 0, arena);
    const struct ray *out = trace_edges(question, &clear, middle, open->places, arena);
    double heading[2] = {1, question->first->index_image < 0 ? -1 : 1};
    struct pupil_side *own = reverse ? &shape->exit : &shape->entrance;
    fill_side(&clear, reverse ? out : in, shape->has_chief, question->first->entrance_pupil,
              reverse ? -heading[0] : heading[0], arena, &shape->entrance);
    fill_side(&clear, reverse ? in : out, shape->has_chief, question->first->exit_pupil,
              reverse ? -heading[1] : heading[1], arena, &shape->exit);
    limit_by_beam(&clear, &shape->entrance);
    limit_by_beam(&clear, &shape->exit);
    fill_stop(question, &clear, middle, arena, shape);
    shape->projected = clear.area;
    shape->cosine_area = integrate(beam, &clear, COSINES, 0);
    if (!isnan(own->pupil.area)) {
        own->pupil.area = integrate(beam, &clear, IN_PLANE, own->pupil.z);
    }
    if (!isnan(own->vertex.area)) {
        own->vertex.area = integrate(beam, &clear, IN_PLANE, 0);
    }
    return true;
}
