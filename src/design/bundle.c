/* design/bundle.c - exact rays through a lens: fields, pupil, wavelengths. */
/* SPDX-License-Identifier: MIT */
#include "design/bundle.h"

#include "trace/dispatch.h"
#include "trace/system.h"

#include <math.h>

enum { MOST_RINGS = 32, MOST_STEPS = 30 };

/* A point of the stop (share of its radius), and where the ray to it crosses the paraxial entrance
   pupil. */
struct aim {
    double stop_x, stop_y, weight;
    double x, y; /* mm */
    bool reached;
};

/* The pupil points of one field; [0] is its centre, which only leads the others. */
struct pupil {
    struct aim *aims;
    size_t count;
};

struct tracing {
    const struct bundle_request *request;
    struct arena *arena;
    struct system system; /* at the first wavelength, without clipping */
    bool has_stop;
    double place, radius; /* of the paraxial entrance pupil, mm */
};

/* Nodes and weights of Gauss-Legendre quadrature on 0 .. 1, by Newton's method on P_n. */
static void gauss(size_t n, double *nodes, double *weights)
{
    for (size_t i = 0; i < n; i++) {
        double x = cos(3.141592653589793 * ((double)i + 0.75) / ((double)n + 0.5)), slope = 1;
        for (int step = 0; step < 100; step++) {
            double p = 1, before = 0;
            for (size_t k = 1; k <= n; k++) {
                double next = ((2 * (double)k - 1) * x * p - ((double)k - 1) * before) / (double)k;
                before = p;
                p = next;
            }
            slope = (double)n * (x * p - before) / (x * x - 1);
            x -= p / slope;
            if (fabs(p / slope) < 1e-15) {
                break;
            }
        }
        nodes[n - 1 - i] = (1 + x) / 2;
        weights[n - 1 - i] = 1 / ((1 - x * x) * slope * slope);
    }
}

static struct pupil make_pupil(const struct tracing *tracing)
{
    const struct bundle_request *request = tracing->request;
    size_t rings = request->rings, arms = request->arms;
    struct pupil pupil = {ARENA_ARRAY(tracing->arena, rings * arms + 1, struct aim),
                          rings * arms + 1};
    double nodes[MOST_RINGS], weights[MOST_RINGS];
    gauss(rings, nodes, weights);
    for (size_t i = 0; i < rings; i++) {
        for (size_t j = 0; j < arms; j++) {
            /* half a step off the meridional plane, so that both sides of it are alike */
            double angle = 6.283185307179586 * ((double)j + 0.5) / (double)arms;
            double r = sqrt(nodes[i]);
            pupil.aims[1 + i * arms + j] = (struct aim){.stop_x = r * cos(angle),
                                                        .stop_y = r * sin(angle),
                                                        .weight = weights[i] / (double)arms};
        }
    }
    return pupil;
}

/* The ray of a field that crosses the entrance pupil plane at x, y. */
static struct ray start_ray(const struct tracing *tracing, const struct system *system,
                            double field, double x, double y)
{
    const struct lens *lens = tracing->request->lens;
    if (lens->object_is_infinite) {
        const double cosine[3] = {0, sin(field), cos(field)};
        const double target[2] = {x, y - tracing->place * tan(field)};
        return ray_from_infinity(cosine, target, system->index_first);
    }
    double distance = lens->object.value.hi, share = distance / (distance + tracing->place);
    const double object[3] = {0, field, -distance};
    const double target[2] = {x * share, field + (y - field) * share};
    return ray_from_point(object, target, system->index_first);
}

/* Where three rays an aim (itself, a bit to x, a bit to y) meet the stop, in its radii. */
static void trace_to_stop(const struct tracing *tracing, const struct pupil *pupil, double field,
                          double step, double (*at)[2])
{
    const struct system *system = &tracing->system;
    struct arena_mark mark = arena_mark(tracing->arena);
    struct rays rays = rays_new(tracing->arena, 3 * pupil->count);
    for (size_t i = 0; i < 3 * pupil->count; i++) {
        const struct aim *aim = &pupil->aims[i / 3];
        struct ray ray = start_ray(tracing, system, field, aim->x + (i % 3 == 1 ? step : 0),
                                   aim->y + (i % 3 == 2 ? step : 0));
        rays_set(&rays, i, system->index_first, &ray);
    }
    size_t place = system_place(system, system->stop);
    rays_trace_part(system, 0, place + 1, &rays, NULL);
    for (size_t i = 0; i < 3 * pupil->count; i++) {
        struct ray ray = rays_get(&rays, i, system_index_after(system, place));
        at[i][0] = ray.point[0] / system->stop_radius;
        at[i][1] = ray.point[1] / system->stop_radius;
    }
    arena_reset(tracing->arena, mark);
}

/* One step of Newton's method; how far the ray still was from its point. */
static double improve(struct aim *aim, double (*at)[2], double step, double most,
                      const struct aim *centre)
{
    double ex = aim->stop_x - at[0][0], ey = aim->stop_y - at[0][1];
    double xx = (at[1][0] - at[0][0]) / step, yx = (at[1][1] - at[0][1]) / step;
    double xy = (at[2][0] - at[0][0]) / step, yy = (at[2][1] - at[0][1]) / step;
    double determinant = xx * yy - xy * yx;
    double dx = (yy * ex - xy * ey) / determinant, dy = (xx * ey - yx * ex) / determinant;
    double length = hypot(dx, dy);
    if (!(length < INFINITY)) {
        /* no way to the stop from there: nearer to the ray that leads */
        aim->x = centre->x + 0.6 * (aim->x - centre->x);
        aim->y = centre->y + 0.6 * (aim->y - centre->y);
        return INFINITY;
    }
    double share = length > most ? most / length : 1;
    aim->x += share * dx;
    aim->y += share * dy;
    return hypot(ex, ey);
}

static void aim_pupil(const struct tracing *tracing, const struct pupil *pupil, double field)
{
    double step = 1e-6 * fabs(tracing->radius);
    double(*at)[2] = (double(*)[2])(void *)ARENA_ARRAY(tracing->arena, 6 * pupil->count, double);
    for (int i = 0; i < MOST_STEPS; i++) {
        bool all = true;
        trace_to_stop(tracing, pupil, field, step, at);
        for (size_t k = 0; k < pupil->count; k++) {
            double miss =
                improve(&pupil->aims[k], at + 3 * k, step, fabs(tracing->radius), &pupil->aims[0]);
            pupil->aims[k].reached = miss < 1e-9;
            all = all && miss < 1e-12;
        }
        if (all) {
            break;
        }
    }
}

/* The centre first, outwards in small steps of the field; then the others around it. */
static void aim_field(const struct tracing *tracing, const struct pupil *pupil, double field)
{
    struct aim *centre = &pupil->aims[0];
    const struct pupil alone = {centre, 1};
    double reach = tracing->request->lens->object_is_infinite ? 0.05 : fabs(tracing->radius) + 1e-3;
    int steps = (int)fmin(200, ceil(fabs(field) / reach));
    centre->x = centre->y = 0;
    for (int i = 1; i <= steps && tracing->has_stop; i++) {
        aim_pupil(tracing, &alone, field * i / steps);
    }
    for (size_t k = 1; k < pupil->count; k++) {
        struct aim *aim = &pupil->aims[k];
        aim->x = centre->x + aim->stop_x * tracing->radius;
        aim->y = centre->y + aim->stop_y * tracing->radius;
        aim->reached = true;
    }
    if (tracing->has_stop) {
        aim_pupil(tracing, pupil, field);
    }
}

static bool open_tracing(struct tracing *tracing, struct error *error)
{
    const struct bundle_request *request = tracing->request;
    const struct first_order *first = request->first;
    struct system_options options = system_options_default();
    options.stop_radius = first->stop_radius;
    if (!system_compile(request->lens, request->wavelengths[0], &options, tracing->arena,
                        &tracing->system, error)) {
        return false;
    }
    tracing->has_stop = tracing->system.stop != LENS_NONE && first->stop_radius > 0 &&
                        isfinite(first->entrance_pupil);
    tracing->place = tracing->has_stop ? first->entrance_pupil : 0;
    tracing->radius = tracing->has_stop ? first->stop_radius * first->entrance_scale
                                        : first->entrance_diameter / 2;
    if (!(fabs(tracing->radius) > 0 && isfinite(tracing->radius))) {
        return fail(error, ERROR_DOMAIN,
                    "the lens has neither a stop with a diameter nor an aperture: give --aperture");
    }
    for (size_t i = 0; i < request->field_count; i++) {
        if (request->lens->object_is_infinite && !(fabs(request->fields[i]) < 1.57)) {
            return fail(error, ERROR_DOMAIN,
                        "the field of %.6g degrees: the rays of a thick lens stay below 90",
                        request->fields[i] * 57.29577951308232);
        }
    }
    return true;
}

static void open_bundle(const struct bundle_request *request, struct arena *arena,
                        struct bundle *bundle)
{
    size_t most = request->field_count * request->wavelength_count * request->rings * request->arms;
    for (size_t i = 0; i < 11; i++) {
        bundle->columns[i] = ARENA_ARRAY(arena, most, double);
    }
    bundle->groups = ARENA_ARRAY(arena, most, size_t);
    bundle->field = ARENA_ARRAY(arena, most, size_t);
    bundle->index_object = ARENA_ARRAY(arena, request->wavelength_count, double);
    bundle->index_image = ARENA_ARRAY(arena, request->wavelength_count, double);
    bundle->wanted = most;
    double *const *all = bundle->columns;
    bundle->rays = (struct thick_rays){.x = all[0],
                                       .y = all[1],
                                       .p = all[2],
                                       .q = all[3],
                                       .x_out = all[4],
                                       .y_out = all[5],
                                       .p_out = all[6],
                                       .q_out = all[7],
                                       .weight = all[8],
                                       .stop_x = all[9],
                                       .stop_y = all[10],
                                       .group = bundle->groups};
}

/* A ray that came through, from the plane it is in to the plane of the vertex. */
static void store(double *const *to, size_t i, const struct ray *ray)
{
    double p = ray->cosine[0] / ray->cosine[2], q = ray->cosine[1] / ray->cosine[2];
    to[0][i] = ray->point[0] - ray->point[2] * p;
    to[1][i] = ray->point[1] - ray->point[2] * q;
    to[2][i] = p;
    to[3][i] = q;
}

/* All rays of one field at one wavelength. */
static void trace_pupil(const struct tracing *tracing, const struct system *system,
                        const struct pupil *pupil, size_t field, size_t group,
                        struct bundle *bundle)
{
    const struct bundle_request *request = tracing->request;
    struct arena_mark mark = arena_mark(tracing->arena);
    struct rays rays = rays_new(tracing->arena, pupil->count);
    struct ray *starts = ARENA_ARRAY(tracing->arena, pupil->count, struct ray);
    double *const *to = bundle->columns;
    double weight = (request->field_weights != NULL ? request->field_weights[field] : 1) *
                    (request->wavelength_weights != NULL ? request->wavelength_weights[group] : 1);
    for (size_t k = 0; k < pupil->count; k++) {
        starts[k] =
            start_ray(tracing, system, request->fields[field], pupil->aims[k].x, pupil->aims[k].y);
        rays_set(&rays, k, system->index_first, &starts[k]);
    }
    /* places behind a thick lens that comes last count from its H' */
    const struct surface *last = &request->lens->surfaces[request->lens->surface_count - 1];
    double behind = last->kind == SURFACE_THICK ? last->hiatus.value.hi : 0;
    rays_trace(system, &rays, NULL);
    for (size_t k = 1; k < pupil->count; k++) {
        struct ray ray = rays_get(&rays, k, system->index_last);
        if (!pupil->aims[k].reached) {
            bundle->unreachable++;
            continue;
        }
        if (ray.status != RAY_OK || !(fabs(ray.cosine[2]) > 1e-6)) {
            bundle->clipped++;
            continue;
        }
        size_t i = bundle->rays.count++;
        ray.point[2] -= behind;
        store(to, i, &starts[k]);
        store(to + 4, i, &ray);
        to[8][i] = weight * pupil->aims[k].weight;
        to[9][i] = pupil->aims[k].stop_x;
        to[10][i] = pupil->aims[k].stop_y;
        bundle->groups[i] = group;
        bundle->field[i] = field;
    }
    arena_reset(tracing->arena, mark);
}

bool bundle_trace(const struct bundle_request *request, struct arena *arena, struct bundle *bundle,
                  struct error *error)
{
    struct tracing tracing = {.request = request, .arena = arena};
    *bundle = (struct bundle){0};
    if (request->field_count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no field: give --field");
    }
    if (request->rings == 0 || request->rings > MOST_RINGS || request->arms == 0) {
        return fail(error, ERROR_DOMAIN, "the pupil has 1 to %d rings and at least one arm",
                    MOST_RINGS);
    }
    if (!open_tracing(&tracing, error)) {
        return false;
    }
    open_bundle(request, arena, bundle);
    struct system *systems = ARENA_ARRAY(arena, request->wavelength_count, struct system);
    for (size_t g = 0; g < request->wavelength_count; g++) {
        struct system_options options = system_options_default();
        options.clip = true;
        options.stop_radius = request->first->stop_radius;
        if (!system_compile(request->lens, request->wavelengths[g], &options, arena, &systems[g],
                            error)) {
            return false;
        }
        bundle->index_object[g] = copysign(systems[g].index_first, request->first->index_object);
        bundle->index_image[g] = copysign(systems[g].index_last, request->first->index_image);
    }
    const struct pupil pupil = make_pupil(&tracing);
    for (size_t f = 0; f < request->field_count; f++) {
        aim_field(&tracing, &pupil, request->fields[f]);
        for (size_t g = 0; g < request->wavelength_count; g++) {
            trace_pupil(&tracing, &systems[g], &pupil, f, g, bundle);
        }
    }
    return bundle->rays.count > 0 ||
           fail(error, ERROR_DOMAIN,
                "none of %zu rays came through: %zu were stopped by rims, %zu points of the stop "
                "cannot be reached",
                bundle->wanted, bundle->clipped, bundle->unreachable);
}
