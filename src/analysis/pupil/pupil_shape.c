/* analysis/pupil/pupil_shape.c - edges of a beam taken to both sides of the lens. */
/* SPDX-License-Identifier: MIT */
#include "analysis/pupil/pupil_shape.h"

#include "analysis/pupil/caustic.h"
#include "analysis/pupil/pupil_area.h"
#include "trace/aim/aim.h"
#include "trace/aim/chief.h"
#include "trace/aim/sample.h"
#include "trace/dispatch.h"
#include "trace/pupil/clear.h"
#include "trace/pupil/clear_intervals.h"

#include <math.h>

/* Below this direction cosine a plane across the axis counts as not met: 89.9 degrees. */
static const double ALONG = 1.7e-3;

/* -------- the chief ray -------- */

static bool shape_find_chief(const struct pupil_question *question, const struct clear_guess *guess,
                             struct arena *arena, double at[2])
{
    struct aim aim;
    struct error ignored;
    if (question->open->options.reverse) {
        /* image sides are mild, so Newton's method from the paraxial pupil will do */
        const double radius = question->open->stop_radius;
        aim = (struct aim){.system = question->open,
                           .beam = *question->beam,
                           .slope = {0, 0, 0, radius / guess->radius},
                           .stop_radius = radius,
                           .work = rays_new(arena, RAYS_BLOCK)};
        at[0] = guess->centre[0];
        at[1] = guess->centre[1];
        return chief_newton(&aim, at);
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

/* -------- the rays that are looked at -------- */

/* The edges, the corners, the arms; the chief ray comes last and is not counted. */
static size_t ray_count(const struct clear_pupil *clear)
{
    return clear->edge_count + clear->corner_count + clear->arm_count;
}

static const double *pupil_shape_place_of(const struct clear_pupil *clear, const double chief[2],
                                          size_t i)
{
    const size_t tips = clear->edge_count;
    if (i < tips) {
        return clear->edges[i].at;
    }
    if (i < ray_count(clear)) {
        return clear_edge_at(clear, i - tips)->at;
    }
    return chief;
}

/* -------- outlines -------- */

/* Where a line crosses z = const; NaN where it runs along it, or the other way. */
static void shape_cross(const struct ray *ray, double z, double light_direction, double point[2])
{
    double t = (z - ray->point[2]) / ray->cosine[2];
    bool meets = ray->cosine[2] * light_direction > ALONG;
    for (int i = 0; i < 2; i++) {
        point[i] = meets ? ray->point[i] + t * ray->cosine[i] : (double)NAN;
    }
}

/* What ends an outline that is not there. */
static const size_t nothing = (size_t)-1;

/* The outline of rays in a plane, with its limits. */
static void pupil_shape_look_at(const struct clear_pupil *clear, const struct ray *rays, double z,
                                double light_direction, struct arena *arena,
                                struct pupil_extent *extent, size_t limit[PUPIL_ENDS])
{
    const size_t count = ray_count(clear);
    double(*points)[2] = arena_array(arena, count, sizeof *points);
    bool met = isfinite(z);
    *extent = (struct pupil_extent){.z = z};
    for (size_t i = 0; i < count; i++) {
        shape_cross(&rays[i], met ? z : 0, light_direction, points[i]);
        met = met && isfinite(points[i][0]) && isfinite(points[i][1]);
    }
    for (size_t i = 0; i < PUPIL_ENDS; i++) {
        limit[i] = nothing;
    }
    if (met) {
        extent->area = contour_area(
            clear, (const double(*)[2])points + clear->edge_count + clear->corner_count,
            extent->centre);
        /* its bounds; limits: what clear_edge_at takes */
        const double(*curve)[2] = (const double(*)[2])points + clear->edge_count;
        for (int k = 0; k < 2; k++) {
            extent->high[k] = clear_extreme(clear, curve, k, 1, &limit[k]);
            extent->low[k] = clear_extreme(clear, curve, k, -1, &limit[k + 2]);
            /* what symmetry makes 0 */
            double small = 1e-12 * (extent->high[k] - extent->low[k]);
            extent->centre[k] = fabs(extent->centre[k]) < small ? 0 : extent->centre[k];
        }
        extent->outline = (const double(*)[2])points;
        return;
    }
    extent->area = extent->low[0] = extent->low[1] = extent->high[0] = extent->high[1] = NAN;
    extent->centre[0] = extent->centre[1] = NAN;
}

/* -------- integrals over the beam -------- */

/* Area in a plane across the axis, or of direction cosines. */
enum measure { IN_PLANE, COSINES };

/* What a bit of the beam's plane counts; see the header. */
static double shape_weight(const struct beam *beam, const double at[2], enum measure what, double z)
{
    struct ray ray = beam_ray(beam, at[0], at[1]);
    double cosine = fabs(ray.cosine[2]), d = fabs(beam->distance);
    if (isinf(d)) {
        return what == IN_PLANE ? 1 / cosine : (double)NAN;
    }
    double rho = sqrt(d * d + at[0] * at[0] + at[1] * at[1]);
    double facing = d / (rho * rho * rho), way = z + beam->axis[2] * beam->distance;
    return what == COSINES ? facing * cosine : facing * way * way / (cosine * cosine * cosine);
}

/* Within the edges: what each arm stands for, Gauss's points along it. */
static double integrate(const struct beam *beam, const struct clear_pupil *clear, enum measure what,
                        double z)
{
    enum { POINTS = 8 };
    double x[POINTS], w[POINTS], sum = 0;
    if (isinf(beam->distance)) {
        return shape_weight(beam, clear->centre, what, z) * clear->area; /* alike everywhere */
    }
    gauss_rule(POINTS, x, w);
    for (size_t i = 0; i < clear->arm_count; i++) {
        const double *edge = clear->arms[i].edge.at, *c = clear->centre;
        const struct clear_intervals *intervals = clear->arms[i].intervals;
        double arm[2] = {edge[0] - c[0], edge[1] - c[1]}, along = 0;
        for (size_t k = 0; k < POINTS * intervals->count; k++) {
            double low = intervals->low[k / POINTS], width = intervals->high[k / POINTS] - low;
            double t = low + width * x[k % POINTS];
            const double at[2] = {c[0] + t * arm[0], c[1] + t * arm[1]};
            along += width * w[k % POINTS] * t * shape_weight(beam, at, what, z);
        }
        sum += 2 * along * clear->arms[i].area;
    }
    return sum;
}

/* -------- both sides -------- */

/* Rays of the beam, taken through to the place `to`. */
static struct ray *shape_trace_places(const struct pupil_question *question, const double (*at)[2],
                                      size_t count, size_t to, struct arena *arena)
{
    const struct system *system = question->open;
    struct rays rays = rays_new(arena, count);
    struct ray *out = arena_buffer_array(arena, count, sizeof *out);
    double n = to == 0 ? question->beam->n : system_index_after(system, to - 1);
    for (size_t done = 0; done < count; done += RAYS_BLOCK) {
        size_t here = count - done < RAYS_BLOCK ? count - done : RAYS_BLOCK;
        beam_fill(question->beam, at + done, here, &rays.blocks[done / RAYS_BLOCK]);
    }
    if (to > 0) {
        rays_trace_part(system, 0, to, &rays, NULL);
    }
    for (size_t i = 0; i < count; i++) {
        out[i] = rays_get(&rays, i, n);
    }
    return out;
}

/* All edges and the chief ray, through to the stop or to the other side. */
static struct ray *trace_edges(const struct pupil_question *question,
                               const struct clear_pupil *clear, const double chief[2], size_t to,
                               struct arena *arena)
{
    size_t count = ray_count(clear) + 1;
    double(*at)[2] = arena_array(arena, count, sizeof *at);
    for (size_t i = 0; i < count; i++) {
        const double *place = pupil_shape_place_of(clear, chief, i);
        at[i][0] = place[0];
        at[i][1] = place[1];
    }
    return shape_trace_places(question, (const double(*)[2])at, count, to, arena);
}

/* A plane that a bundle may fold in, and how far its rays reach there. */
struct fold {
    struct pupil_extent *extent;
    double low[2], high[2];
    struct jacobian_extremes folding;
};

enum { PLANES = 2 };

/* Rays a few at a time: all at once are half a megabyte. */
static void look_for_folds(const struct pupil_question *question, const struct clear_pupil *clear,
                           enum caustic_grid grid, double light_direction, struct arena *arena,
                           struct fold folds[PLANES])
{
    enum { AT_ONCE = 3 * RAYS_BLOCK };
    size_t count;
    const double(*at)[2] = folding_places(clear, grid, arena, &count);
    for (size_t i = 0; i < PLANES; i++) {
        folds[i].folding = (struct jacobian_extremes){0, 0, 0};
        for (int k = 0; k < 2; k++) {
            folds[i].low[k] = INFINITY;
            folds[i].high[k] = -INFINITY;
        }
    }
    for (size_t done = 0; done < count; done += AT_ONCE) {
        const struct arena_mark mark = arena_mark(arena);
        const size_t here = count - done < AT_ONCE ? count - done : AT_ONCE;
        const struct ray *rays =
            shape_trace_places(question, at + done, here, question->open->places, arena);
        for (size_t i = 0; i < PLANES; i++) {
            if (folds[i].extent->outline != NULL) {
                /* Three rays at a time: one within the edge, and two beside it. */
                for (size_t m = 0; m + 2 < here; m += 3) {
                    double points[3][2];
                    for (size_t j = 0; j < 3; j++) {
                        shape_cross(&rays[m + j], folds[i].extent->z, light_direction, points[j]);
                    }
                    caustic_add(&folds[i].folding, (const double(*)[2])points, 3);
                    for (int j = 0; j < 2; j++) {
                        folds[i].low[j] = fmin(folds[i].low[j], points[0][j]);
                        folds[i].high[j] = fmax(folds[i].high[j], points[0][j]);
                    }
                }
            }
        }
        arena_reset(arena, mark);
    }
}

/* The side that the bundle leaves on. */
static void check_folds(const struct pupil_question *question, const struct clear_pupil *clear,
                        double light_direction, struct arena *arena, struct pupil_side *side)
{
    struct fold folds[PLANES] = {{.extent = &side->pupil}, {.extent = &side->vertex}};
    bool ruled_out = true;
    look_for_folds(question, clear, CAUSTIC_COARSE, light_direction, arena, folds);
    for (size_t i = 0; i < PLANES; i++) {
        ruled_out =
            ruled_out && (folds[i].extent->outline == NULL || caustic_ruled_out(&folds[i].folding));
    }
    if (ruled_out) {
        return;
    }
    look_for_folds(question, clear, CAUSTIC_FINE, light_direction, arena, folds);
    for (size_t i = 0; i < PLANES; i++) {
        const struct fold *fold = &folds[i];
        struct pupil_extent *extent = fold->extent;
        extent->folds = extent->outline != NULL && caustic_seen(&fold->folding);
        if (!extent->folds) {
            continue;
        }
        /* what covers a plane twice has edges that enclose nothing which has a meaning */
        extent->area = extent->centre[0] = extent->centre[1] = NAN;
        for (int k = 0; k < 2; k++) {
            const double slack = 1e-6 * (extent->high[k] - extent->low[k]);
            /* a fold reaches beyond the edges: where it ends is not known */
            if (fold->low[k] < extent->low[k] - slack) {
                extent->low[k] = NAN;
            }
            if (fold->high[k] > extent->high[k] + slack) {
                extent->high[k] = NAN;
            }
        }
    }
}

/* What the rays do on one side; the last of them is the chief ray. */
static void fill_side(const struct clear_pupil *clear, const struct ray *rays, bool has_chief,
                      double z, double light_direction, struct arena *arena,
                      struct pupil_side *side)
{
    const struct ray *chief = &rays[ray_count(clear)];
    size_t ends[PUPIL_ENDS], vertex[PUPIL_ENDS];
    pupil_shape_look_at(clear, rays, z, light_direction, arena, &side->pupil, ends);
    pupil_shape_look_at(clear, rays, 0, light_direction, arena, &side->vertex, vertex);
    for (size_t i = 0; i < PUPIL_ENDS; i++) {
        size_t end = ends[i] != nothing ? ends[i] : vertex[i];
        side->limit[i] = end != nothing ? clear_edge_at(clear, end)->surface : 0;
    }
    side->chief = *chief;
    if (!has_chief || side->chief.status == RAY_MISS) {
        side->chief = (struct ray){.point = {NAN, NAN, NAN}, .cosine = {NAN, NAN, NAN}};
    } else if (side->chief.cosine[2] * light_direction > ALONG) {
        shape_cross(chief, 0, light_direction, side->chief.point);
        side->chief.point[2] = 0;
    }
}

/* Areas and centroids of one side, less what is dark within the edges. */
static void cut_side(const struct pupil_question *question, const struct clear_pupil *clear,
                     size_t to, double light_direction, struct arena *arena,
                     struct pupil_side *side)
{
    struct pupil_extent *const extents[] = {&side->pupil, &side->vertex};
    for (size_t i = 0; i < 2; i++) {
        const struct cut_plane plane = {question->open, question->beam, to, extents[i]->z,
                                        light_direction};
        if (isnan(extents[i]->area)) {
            continue;
        }
        struct cut_extent cut = pupil_cut(&plane, clear, arena);
        double small = 1e-9 * (extents[i]->high[1] - extents[i]->low[1]);
        extents[i]->area = cut.area;
        for (int k = 0; k < 2; k++) {
            /* what symmetry makes 0 */
            extents[i]->centre[k] = fabs(cut.centre[k]) < small ? 0 : cut.centre[k];
        }
    }
}

/* The limits of a side that the beam does not cross: by the beam's own directions. */
static void limit_by_beam(const struct clear_pupil *clear, struct pupil_side *side)
{
    for (size_t i = 0; i < PUPIL_ENDS; i++) {
        if (side->limit[i] == 0) {
            side->limit[i] = clear_edge_at(clear, clear->ends[i])->surface;
        }
    }
}

static void fill_stop(const struct pupil_question *question, const struct clear_pupil *clear,
                      const double chief[2], struct arena *arena, struct pupil_shape *shape)
{
    const struct system *system = question->open;
    size_t count = ray_count(clear), which, to = system_place(system, system->stop) + 1;
    const struct ray *rays = trace_edges(question, clear, chief, to, arena);
    double(*points)[2] = arena_array(arena, count, sizeof *points);
    double(*across)[2] = arena_array(arena, count, sizeof *across);
    for (size_t i = 0; i < count; i++) {
        double own[3] = {rays[i].point[0], rays[i].point[1], rays[i].point[2]};
        system_to_own(system, system->stop, own);
        for (int k = 0; k < 2; k++) {
            points[i][k] = own[k] / system->stop_radius;
            across[i][k] = pupil_shape_place_of(clear, chief, i)[k] - chief[k];
        }
    }
    shape->stop = (const double(*)[2])points;
    shape->across = (const double(*)[2])across;
    for (int k = 0; k < 2; k++) {
        const double(*curve)[2] = shape->stop + clear->edge_count;
        double high = clear_extreme(clear, curve, k, 1, &which);
        double low = clear_extreme(clear, curve, k, -1, &which);
        shape->vignetting[k] = fabs(1 - high) < 1e-6 ? 0 : 1 - high;
        shape->vignetting[k + 2] = fabs(1 + low) < 1e-6 ? 0 : 1 + low;
    }
}

/* Areas by integrals over the beam: on its own side, on both where something is cut out. */
static void fill_areas(const struct pupil_question *question, const struct clear_pupil *clear,
                       const double light_direction[2], struct arena *arena,
                       struct pupil_shape *shape)
{
    const struct beam *beam = question->beam;
    const double side = question->open->options.reverse ? -1 : 1;
    struct pupil_side *own = side < 0 ? &shape->exit : &shape->entrance;
    shape->projected = clear->area;
    shape->obstruction = clear->is_cut ? 1 - clear->area / clear->within : (double)NAN;
    shape->cosine_area = integrate(beam, clear, COSINES, 0);
    if (clear->is_cut) {
        struct pupil_side *other = side < 0 ? &shape->entrance : &shape->exit;
        cut_side(question, clear, 0, side * light_direction[side < 0], arena, own);
        cut_side(question, clear, question->open->places, side * light_direction[side > 0], arena,
                 other);
        return;
    }
    if (!isnan(own->pupil.area)) {
        own->pupil.area = integrate(beam, clear, IN_PLANE, own->pupil.z);
    }
    if (!isnan(own->vertex.area)) {
        own->vertex.area = integrate(beam, clear, IN_PLANE, 0);
    }
}

static bool pupil_shape_look(const struct pupil_question *question, struct arena *arena,
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
    shape->has_chief = shape_find_chief(question, &guess, arena, chief);
    /* What stops the chief ray, or the middle of the beam where there is no chief ray. */
    struct rays work = rays_new(arena, 1);
    struct ray ray = beam_ray(question->beam, chief[0], chief[1]);
    rays_set(&work, 0, question->beam->n, &ray);
    rays_trace(question->clipped, &work, NULL);
    shape->status = ray_block_status(work.blocks, 0);
    shape->surface = ray_block_surface(work.blocks, 0);
    guess.centre[0] = chief[0];
    guess.centre[1] = chief[1];
    clear_find(question->clipped, beam, &guess, question->directions, arena, &clear);
    shape->is_empty = clear.is_empty;
    if (clear.is_empty) {
        return true;
    }
    shape->islands = clear.islands;
    /* the centre and the corners, then about eight rays an edge */
    shape->rays = 1000 + 8 * (question->directions + clear.arm_count);
    const double *middle = shape->has_chief ? chief : clear.centre;
    const struct ray *in = trace_edges(question, &clear, middle, 0, arena);
    const struct ray *out = trace_edges(question, &clear, middle, open->places, arena);
    double light_direction[2] = {1, question->first->index_image < 0 ? -1 : 1};
    fill_side(&clear, reverse ? out : in, shape->has_chief, question->first->entrance_pupil,
              reverse ? -light_direction[0] : light_direction[0], arena, &shape->entrance);
    fill_side(&clear, reverse ? in : out, shape->has_chief, question->first->exit_pupil,
              reverse ? -light_direction[1] : light_direction[1], arena, &shape->exit);
    check_folds(question, &clear, reverse ? -light_direction[0] : light_direction[1], arena,
                reverse ? &shape->entrance : &shape->exit);
    limit_by_beam(&clear, &shape->entrance);
    limit_by_beam(&clear, &shape->exit);
    fill_stop(question, &clear, middle, arena, shape);
    fill_areas(question, &clear, light_direction, arena, shape);
    return true;
}

bool pupil_shape(const struct pupil_question *question, struct arena *arena,
                 struct pupil_shape *shape, struct error *error)
{
    const struct arena_mark mark = arena_mark(arena);
    const bool found = pupil_shape_look(question, arena, shape, error);
    if (question->directions == 0) {
        struct pupil_side *const sides[] = {&shape->entrance, &shape->exit};
        for (size_t i = 0; i < 2 && found; i++) {
            sides[i]->pupil.outline = sides[i]->vertex.outline = NULL;
        }
        shape->stop = shape->across = NULL;
        arena_reset(arena, mark);
    }
    return found;
}
