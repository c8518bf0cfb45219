/* design/fit/ray_data.c - exact rays through a lens: fields, pupil, wavelengths. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/ray_data.h"

#include "analysis/quadrature.h"
#include "base/constants.h"
#include "trace/aim.h"
#include "trace/dispatch.h"
#include "trace/system.h"

#include <math.h>

/* The lens at one wavelength: with its clear apertures, if they count, and without for aiming. */
struct ways {
    const struct system *clipped, *open;
};

/* Points of the pupil, of the stop where there is one; and whence rays to them start. */
struct tracing {
    const struct ray_data_request *request;
    struct arena *arena;
    struct sample sample; /* of the whole stop */
    bool has_stop;
    double radius;    /* of the beam at the first vertex of a lens without a stop, mm */
    struct ways *all; /* one a wavelength */
    /* of the present field and wavelength */
    const struct ways *ways;
    struct beam beam;
    struct aim aim;    /* where there is a stop */
    struct error last; /* why a field has no chief ray */
};

static double field_of(const struct setup *setup, size_t i)
{
    return setup->fields[i].point.value[setup_axis(setup)];
}

/* The systems of each wavelength, in the light's own order. */
static bool open_ways(struct tracing *tracing, struct ray_data *ray_data, struct error *error)
{
    const struct setup *setup = tracing->request->setup;
    unsigned which = tracing->request->no_clip ? SETUP_OPEN : SETUP_CLIPPED;
    tracing->all = ARENA_ARRAY(tracing->arena, setup->wavelength_count, struct ways);
    ray_data->index_object = ARENA_ARRAY(tracing->arena, setup->wavelength_count, double);
    ray_data->index_image = ARENA_ARRAY(tracing->arena, setup->wavelength_count, double);
    for (size_t g = 0; g < setup->wavelength_count; g++) {
        struct ways *ways = &tracing->all[g];
        ways->open = setup_system(setup, g, SETUP_OPEN, error);
        ways->clipped = ways->open != NULL ? setup_system(setup, g, which, error) : NULL;
        if (ways->clipped == NULL) {
            return false;
        }
        ray_data->index_object[g] = copysign(ways->open->index_first, setup->first.index_object);
        ray_data->index_image[g] = copysign(ways->open->index_last, setup->first.index_image);
    }
    return true;
}

static bool open_tracing(struct tracing *tracing, struct ray_data *ray_data, struct error *error)
{
    const struct ray_data_request *request = tracing->request;
    const struct setup *setup = request->setup;
    const struct first_order *first = &setup->first;
    if (!open_ways(tracing, ray_data, error) ||
        !sample_make(request->pattern, request->ray_count, request->seed, tracing->arena,
                     &tracing->sample, error)) {
        return false;
    }
    tracing->has_stop = tracing->all->open->stop != LENS_NONE && first->stop_radius > 0;
    tracing->radius = tracing->has_stop ? first->stop_radius : first->entrance_diameter / 2;
    if (!(fabs(tracing->radius) > 0 && isfinite(tracing->radius))) {
        fail(
            error, ERROR_DOMAIN,
            "the lens has neither a stop with a diameter nor an aperture: the size of its pupil is "
            "not known");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    for (size_t i = 0; i < setup->field_count; i++) {
        if (setup->object.is_infinite && !(fabs(field_of(setup, i)) < 1.57)) {
            return fail(error, ERROR_DOMAIN,
                        "the field of %.6g degrees: the rays of a thick lens stay below 90",
                        field_of(setup, i) * DEGREES_PER_RADIAN);
        }
    }
    return true;
}

static bool open_beam(const struct tracing *tracing, double field, struct beam *beam,
                      struct error *error)
{
    const struct lens *lens = tracing->request->setup->lens;
    double n = tracing->ways->open->index_first;
    if (lens->object_is_infinite) {
        const double angle[2] = {0, field};
        *beam = beam_from_infinity(angle, n);
        return true;
    }
    const double point[3] = {0, field, -lens->object.value.hi};
    return beam_from_point(point, n, beam, error);
}

/* Each colour by its own rays: what one leaves dark of the stop another may fill. */
static bool open_field(struct tracing *tracing, size_t field, size_t group, struct error *error)
{
    tracing->ways = &tracing->all[group];
    return open_beam(tracing, field_of(tracing->request->setup, field), &tracing->beam, error) &&
           (!tracing->has_stop ||
            aim_open(tracing->ways->open, &tracing->beam, tracing->arena, &tracing->aim, error));
}

/* Rays to the points of the sample; those that reach no point of the stop are lost. */
static void start_rays(const struct tracing *tracing, const struct rays *rays)
{
    const struct sample *sample = &tracing->sample;
    if (tracing->has_stop) {
        aim_rays(&tracing->aim, sample->points, sample->count, rays);
        return;
    }
    for (size_t i = 0; i < sample->count; i++) {
        const struct beam *beam = &tracing->beam;
        const double target[3] = {sample->points[i].x * tracing->radius,
                                  sample->points[i].y * tracing->radius, 0};
        double place[2];
        beam_place(beam, target, place);
        struct ray ray = beam_ray(beam, place[0], place[1]);
        rays_set(rays, i, beam->n, &ray);
    }
}

static void open_ray_data(const struct ray_data_request *request, size_t most, struct arena *arena,
                          struct ray_data *ray_data)
{
    ray_data->clear = ARENA_ARRAY(arena, request->setup->field_count, double);
    for (size_t i = 0; i < 11; i++) {
        ray_data->columns[i] = ARENA_ARRAY(arena, most, double);
    }
    ray_data->groups = ARENA_ARRAY(arena, most, size_t);
    ray_data->field = ARENA_ARRAY(arena, most, size_t);
    ray_data->lost = ARENA_ARRAY(arena, most, struct ray_data_loss);
    ray_data->wanted = 0;
    double *const *all = ray_data->columns;
    ray_data->rays = (struct thick_rays){.x = all[0],
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
                                         .group = ray_data->groups,
                                         .field = ray_data->field,
                                         .field_count = request->setup->field_count};
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

/* The points of the stop, or of a disc about the first vertex that takes its place. */
static bool open_pupil(const struct tracing *tracing, struct stop_beam *pupil)
{
    const struct system *clear = tracing->ways->clipped;
    struct first_order first = tracing->request->setup->first;
    struct error ignored;
    if (tracing->has_stop) {
        *pupil = stop_beam_of_stop(&tracing->aim, clear, WEIGHT_PUPIL);
        return true;
    }
    first.is_telecentric = false;
    first.entrance_pupil = 0;
    first.entrance_diameter = 2 * tracing->radius;
    return stop_beam_of_entrance(clear, &tracing->beam, &first, WEIGHT_PUPIL, pupil, &ignored);
}

/*
 * Rays of the present field and wavelength. Gauss's rule is that of what is clear of the stop:
 * without the rays that are lost it would integrate nothing. Equal points may lose some.
 */
static struct quadrature choose_rays(struct tracing *tracing)
{
    struct quadrature all = {.is_empty = true};
    struct stop_beam pupil;
    if (tracing->request->pattern == PATTERN_GAUSS && open_pupil(tracing, &pupil)) {
        all = quadrature_make(&pupil, tracing->request->ray_count, tracing->arena);
    }
    if (all.is_empty) {
        all.sample = tracing->sample;
        all.rays = rays_new(tracing->arena, all.sample.count);
        start_rays(tracing, &all.rays);
    }
    return all;
}

/* All rays of one field at one wavelength. */
static void trace_pupil(struct tracing *tracing, const struct quadrature *all, size_t field,
                        size_t group, struct ray_data *ray_data)
{
    const struct system *system = tracing->ways->clipped;
    const struct sample *sample = &all->sample;
    struct rays rays = rays_new(tracing->arena, sample->count);
    double *const *to = ray_data->columns;
    const struct setup *setup = tracing->request->setup;
    double weight = setup->fields[field].weight * setup->wavelengths[group].weight;
    ray_data->wanted += sample->count;
    for (size_t k = 0; k < sample->count; k++) {
        struct ray ray = rays_get(&all->rays, k, system->index_first);
        ray.status = RAY_OK;
        rays_set(&rays, k, system->index_first, &ray);
    }
    /* places behind a thick lens that comes last count from its H' */
    const struct surface *last = &system->lens->surfaces[system->lens->surface_count - 1];
    double behind = surface_hiatus(last).hi;
    rays_trace(system, &rays, NULL);
    for (size_t k = 0; k < sample->count; k++) {
        struct ray start = rays_get(&all->rays, k, system->index_first);
        struct ray ray = rays_get(&rays, k, system->index_last);
        bool reached = start.status == RAY_OK;
        if (!reached || ray.status != RAY_OK || !(fabs(ray.cosine[2]) > 1e-6)) {
            ray_data->unreachable += !reached;
            ray_data->clipped += reached;
            ray_data->lost[ray_data->lost_count++] =
                (struct ray_data_loss){sample->points[k].x, sample->points[k].y, field, group};
            continue;
        }
        size_t i = ray_data->rays.count++;
        ray.point[2] -= behind;
        store(to, i, &start);
        store(to + 4, i, &ray);
        to[8][i] = weight * sample->points[k].weight;
        to[9][i] = sample->points[k].x;
        to[10][i] = sample->points[k].y;
        ray_data->groups[i] = group;
        ray_data->field[i] = field;
        ray_data->clear[field] += sample->points[k].weight / (double)setup->wavelength_count;
    }
}

/* The rays of all fields at all wavelengths, one quadrature each; empty: no chief ray. */
static struct quadrature *choose_all(struct tracing *tracing, size_t *count)
{
    const struct setup *setup = tracing->request->setup;
    const size_t groups = setup->wavelength_count;
    struct quadrature *all =
        ARENA_ARRAY(tracing->arena, setup->field_count * groups, struct quadrature);
    *count = 0;
    for (size_t i = 0; i < setup->field_count * groups; i++) {
        bool found = open_field(tracing, i / groups, i % groups, &tracing->last);
        all[i] = found ? choose_rays(tracing) : (struct quadrature){.is_empty = true};
        *count += all[i].sample.count;
    }
    return all;
}

/* All rays of one field. */
static void trace_field(struct tracing *tracing, size_t field, const struct quadrature *all,
                        struct ray_data *ray_data)
{
    const size_t groups = tracing->request->setup->wavelength_count;
    for (size_t g = 0; g < groups; g++) {
        const struct quadrature *one = &all[field * groups + g];
        struct arena_mark mark = arena_mark(tracing->arena);
        tracing->ways = &tracing->all[g];
        if (one->sample.count > 0) {
            trace_pupil(tracing, one, field, g, ray_data);
        } else {
            ray_data->wanted += tracing->sample.count;
            ray_data->unreachable += tracing->sample.count;
        }
        arena_reset(tracing->arena, mark);
    }
}

static bool check_left(const struct tracing *tracing, const struct ray_data *ray_data,
                       struct error *error)
{
    if (ray_data->rays.count > 0) {
        return true;
    }
    if (ray_data->clipped == 0 && tracing->last.code != ERROR_NONE) {
        *error = tracing->last;
        return error_prefix(error, "none of %zu rays came through: ", ray_data->wanted);
    }
    return fail(error, ERROR_DOMAIN,
                "none of %zu rays came through: %zu were stopped by clear apertures, %zu points of "
                "the stop "
                "cannot be reached",
                ray_data->wanted, ray_data->clipped, ray_data->unreachable);
}

bool ray_data_trace(const struct ray_data_request *request, struct arena *arena,
                    struct ray_data *ray_data, struct error *error)
{
    struct tracing tracing = {.request = request, .arena = arena};
    *ray_data = (struct ray_data){0};
    if (request->setup->field_count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no field: give {field}");
    }
    if (!open_tracing(&tracing, ray_data, error)) {
        return false;
    }
    size_t most;
    const struct quadrature *all = choose_all(&tracing, &most);
    open_ray_data(request, most, arena, ray_data);
    for (size_t f = 0; f < request->setup->field_count; f++) {
        trace_field(&tracing, f, all, ray_data);
    }
    return check_left(&tracing, ray_data, error);
}
