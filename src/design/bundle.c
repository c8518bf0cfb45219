/* design/bundle.c - exact rays through a lens: fields, pupil, wavelengths. */
/* SPDX-License-Identifier: MIT */
#include "design/bundle.h"

#include "trace/aim.h"
#include "trace/dispatch.h"
#include "trace/system.h"

#include <math.h>

/* Points of the pupil, of the stop where there is one; and whence rays to them start. */
struct tracing {
    const struct bundle_request *request;
    struct arena *arena;
    struct system system; /* at the first wavelength, without clipping */
    struct sample sample;
    bool has_stop;
    double radius;     /* of the beam at the first vertex of a lens without a stop, mm */
    struct error last; /* why a field has no chief ray */
};

static bool open_tracing(struct tracing *tracing, struct error *error)
{
    const struct bundle_request *request = tracing->request;
    const struct first_order *first = request->first;
    struct system_options options = system_options_default();
    options.stop_radius = first->stop_radius;
    if (!system_compile(request->lens, request->wavelengths[0], &options, tracing->arena,
                        &tracing->system, error) ||
        !sample_make(request->pattern, request->ray_count, request->seed, tracing->arena,
                     &tracing->sample, error)) {
        return false;
    }
    tracing->has_stop = tracing->system.stop != LENS_NONE && first->stop_radius > 0;
    tracing->radius = tracing->has_stop ? first->stop_radius : first->entrance_diameter / 2;
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

static bool open_beam(const struct tracing *tracing, double field, struct beam *beam,
                      struct error *error)
{
    const struct lens *lens = tracing->request->lens;
    double n = tracing->system.index_first;
    if (lens->object_is_infinite) {
        const double angle[2] = {0, field};
        *beam = beam_from_infinity(angle, n);
        return true;
    }
    const double point[3] = {0, field, -lens->object.value.hi};
    return beam_from_point(point, n, beam, error);
}

/* The rays of one field where they start; those that reach no point of the stop are lost. */
static bool aim_field(const struct tracing *tracing, double field, const struct rays *rays,
                      struct error *error)
{
    const struct sample *sample = &tracing->sample;
    struct beam beam;
    struct aim aim;
    if (!open_beam(tracing, field, &beam, error)) {
        return false;
    }
    if (tracing->has_stop) {
        if (!aim_open(&tracing->system, &beam, tracing->arena, &aim, error)) {
            return false;
        }
        aim_rays(&aim, sample->points, sample->count, rays);
        return true;
    }
    for (size_t i = 0; i < sample->count; i++) {
        const double target[3] = {sample->points[i].x * tracing->radius,
                                  sample->points[i].y * tracing->radius, 0};
        double place[2];
        beam_place(&beam, target, place);
        struct ray ray = beam_ray(&beam, place[0], place[1]);
        rays_set(rays, i, beam.n, &ray);
    }
    return true;
}

static void open_bundle(const struct bundle_request *request, size_t sample, struct arena *arena,
                        struct bundle *bundle)
{
    size_t most = request->field_count * request->wavelength_count * sample;
    for (size_t i = 0; i < 11; i++) {
        bundle->columns[i] = ARENA_ARRAY(arena, most, double);
    }
    bundle->groups = ARENA_ARRAY(arena, most, size_t);
    bundle->field = ARENA_ARRAY(arena, most, size_t);
    bundle->index_object = ARENA_ARRAY(arena, request->wavelength_count, double);
    bundle->index_image = ARENA_ARRAY(arena, request->wavelength_count, double);
    bundle->lost = ARENA_ARRAY(arena, most, struct bundle_loss);
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
                        const struct rays *aimed, size_t field, size_t group, struct bundle *bundle)
{
    const struct bundle_request *request = tracing->request;
    const struct sample *sample = &tracing->sample;
    struct arena_mark mark = arena_mark(tracing->arena);
    struct rays rays = rays_new(tracing->arena, sample->count);
    double *const *to = bundle->columns;
    double weight = (request->field_weights != NULL ? request->field_weights[field] : 1) *
                    (request->wavelength_weights != NULL ? request->wavelength_weights[group] : 1);
    for (size_t k = 0; k < sample->count; k++) {
        struct ray ray = rays_get(aimed, k, tracing->system.index_first);
        ray.status = RAY_OK;
        rays_set(&rays, k, system->index_first, &ray);
    }
    /* places behind a thick lens that comes last count from its H' */
    const struct surface *last = &request->lens->surfaces[request->lens->surface_count - 1];
    double behind = last->kind == SURFACE_THICK ? last->hiatus.value.hi : 0;
    rays_trace(system, &rays, NULL);
    for (size_t k = 0; k < sample->count; k++) {
        struct ray start = rays_get(aimed, k, tracing->system.index_first);
        struct ray ray = rays_get(&rays, k, system->index_last);
        bool reached = start.status == RAY_OK;
        if (!reached || ray.status != RAY_OK || !(fabs(ray.cosine[2]) > 1e-6)) {
            bundle->unreachable += !reached;
            bundle->clipped += reached;
            bundle->lost[bundle->lost_count++] =
                (struct bundle_loss){sample->points[k].x, sample->points[k].y, field, group};
            continue;
        }
        size_t i = bundle->rays.count++;
        ray.point[2] -= behind;
        store(to, i, &start);
        store(to + 4, i, &ray);
        to[8][i] = weight * sample->points[k].weight;
        to[9][i] = sample->points[k].x;
        to[10][i] = sample->points[k].y;
        bundle->groups[i] = group;
        bundle->field[i] = field;
    }
    arena_reset(tracing->arena, mark);
}

/* One system a wavelength, in the light's own order. */
static bool compile_all(const struct bundle_request *request, struct arena *arena,
                        struct system *systems, struct bundle *bundle, struct error *error)
{
    for (size_t g = 0; g < request->wavelength_count; g++) {
        struct system_options options = system_options_default();
        options.clip = !request->no_clip;
        options.stop_radius = request->first->stop_radius;
        if (!system_compile(request->lens, request->wavelengths[g], &options, arena, &systems[g],
                            error)) {
            return false;
        }
        bundle->index_object[g] = copysign(systems[g].index_first, request->first->index_object);
        bundle->index_image[g] = copysign(systems[g].index_last, request->first->index_image);
    }
    return true;
}

static bool check_left(const struct tracing *tracing, const struct bundle *bundle,
                       struct error *error)
{
    if (bundle->rays.count > 0) {
        return true;
    }
    if (bundle->clipped == 0 && tracing->last.code != ERROR_NONE) {
        *error = tracing->last;
        return error_prefix(error, "none of %zu rays came through: ", bundle->wanted);
    }
    return fail(error, ERROR_DOMAIN,
                "none of %zu rays came through: %zu were stopped by rims, %zu points of the stop "
                "cannot be reached",
                bundle->wanted, bundle->clipped, bundle->unreachable);
}

bool bundle_trace(const struct bundle_request *request, struct arena *arena, struct bundle *bundle,
                  struct error *error)
{
    struct tracing tracing = {.request = request, .arena = arena};
    *bundle = (struct bundle){0};
    if (request->field_count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no field: give --field");
    }
    if (!open_tracing(&tracing, error)) {
        return false;
    }
    open_bundle(request, tracing.sample.count, arena, bundle);
    struct system *systems = ARENA_ARRAY(arena, request->wavelength_count, struct system);
    if (!compile_all(request, arena, systems, bundle, error)) {
        return false;
    }
    struct rays aimed = rays_new(arena, tracing.sample.count);
    for (size_t f = 0; f < request->field_count; f++) {
        if (!aim_field(&tracing, request->fields[f], &aimed, &tracing.last)) {
            bundle->unreachable += tracing.sample.count * request->wavelength_count;
            continue;
        }
        for (size_t g = 0; g < request->wavelength_count; g++) {
            trace_pupil(&tracing, &systems[g], &aimed, f, g, bundle);
        }
    }
    return check_left(&tracing, bundle, error);
}
