/* design/fit/ray_data.c - exact rays through a lens: fields, pupil, wavelengths. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/ray_data.h"

#include "analysis/pupil/quadrature.h"
#include "base/constants.h"
#include "trace/aim/aim.h"
#include "trace/dispatch.h"
#include "trace/system.h"

#include <math.h>
#include <string.h>

/* The lens at one wavelength: with its clear apertures, if they count, and without for aiming. */
struct ways {
    const struct system *clipped, *open;
};

/* So many rays are kept rather than traced again. */
enum { MOST_KEPT = 32768 };

/* Points of the pupil, of the stop where there is one; and whence rays to them start. */
struct ray_tracing {
    struct ray_data_request request;
    struct arena *arena;
    struct arena scratch; /* of the present field and wavelength: large, and given back */
    struct sample sample; /* of the whole stop */
    bool has_stop;
    double radius;    /* of the beam at the first vertex of a lens without a stop, mm */
    struct ways *all; /* one a wavelength */
    /* of the present field and wavelength */
    const struct ways *ways;
    struct beam beam;
    struct aim aim;          /* where there is a stop */
    struct quadrature pupil; /* its rays */
    size_t place;            /* of these are done */
    size_t bundle;           /* which it is */
    struct error last;       /* why a field has no chief ray */
    bool is_open;            /* they are those of `bundle` */
    struct ray_part part;    /* of them, now handed out */
    struct ray_part shared;  /* room for those that are not kept */
    struct rays rays;        /* room to trace them */
    /* of all */
    size_t bundles;
    struct ray_part *kept; /* all parts so far, unless there are too many rays */
    size_t kept_count, kept_room, kept_rays, next_kept;
    bool keeps, is_counted; /* all were there once */
};

static double ray_data_field_of(const struct setup *setup, size_t i)
{
    return setup->fields[i].point.value[setup_axis(setup)];
}

/* Each colour by its own rays: what one leaves dark of the stop another may fill. */
static bool ray_data_open_field(struct ray_tracing *tracing, size_t field, size_t group,
                                struct error *error)
{
    const struct setup *setup = tracing->request.setup;
    const double at = ray_data_field_of(setup, field);
    tracing->ways = &tracing->all[group];
    const double n = tracing->ways->open->index_first;
    if (setup->lens->object_is_infinite) {
        tracing->beam = beam_from_infinity((const double[2]){0, at}, n);
    } else if (!beam_from_point((const double[3]){0, at, -setup->lens->object.value.hi}, n,
                                &tracing->beam, error)) {
        return false;
    }
    return !tracing->has_stop ||
           aim_open(tracing->ways->open, &tracing->beam, &tracing->scratch, &tracing->aim, error);
}

static struct ray_part part_new(struct arena *arena, size_t most, size_t fields)
{
    struct ray_part part = {.groups = ARENA_ARRAY(arena, most, size_t),
                            .fields = ARENA_ARRAY(arena, most, size_t),
                            .lost = ARENA_ARRAY(arena, most, struct ray_data_loss)};
    for (size_t i = 0; i < 11; i++) {
        part.columns[i] = ARENA_ARRAY(arena, most, double);
    }
    double *const *all = part.columns;
    part.rays = (struct thick_rays){.x = all[0],
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
                                    .group = part.groups,
                                    .field = part.fields,
                                    .field_count = fields};
    return part;
}

/* A ray that came through, from the plane it is in to the plane of the vertex. */
static void ray_data_store(double *const *to, size_t i, const struct ray *ray)
{
    double p = ray->cosine[0] / ray->cosine[2], q = ray->cosine[1] / ray->cosine[2];
    to[0][i] = ray->point[0] - ray->point[2] * p;
    to[1][i] = ray->point[1] - ray->point[2] * q;
    to[2][i] = p;
    to[3][i] = q;
}

/* The points of the stop, or of a disc about the first vertex that takes its place. */
static bool ray_data_open_pupil(const struct ray_tracing *tracing, struct stop_beam *pupil)
{
    const struct system *clear = tracing->ways->clipped;
    struct first_order first = tracing->request.setup->first;
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
static struct quadrature choose_rays(struct ray_tracing *tracing)
{
    struct quadrature all = {.is_empty = true};
    struct stop_beam pupil;
    if (tracing->request.pattern == PATTERN_GAUSS && ray_data_open_pupil(tracing, &pupil)) {
        all = quadrature_make(&pupil, tracing->request.ray_count, &tracing->scratch);
    }
    if (!all.is_empty) {
        return all;
    }
    /* to the points of the sample; those that reach no point of the stop are lost */
    const struct sample *sample = &tracing->sample;
    const struct beam *beam = &tracing->beam;
    all.sample = *sample;
    all.rays = rays_new(&tracing->scratch, sample->count);
    if (tracing->has_stop) {
        aim_rays(&tracing->aim, sample->points, sample->count, &all.rays);
    }
    for (size_t i = 0; i < sample->count && !tracing->has_stop; i++) {
        const double target[3] = {sample->points[i].x * tracing->radius,
                                  sample->points[i].y * tracing->radius, 0};
        double place[2];
        beam_place(beam, target, place);
        struct ray ray = beam_ray(beam, place[0], place[1]);
        rays_set(&all.rays, i, beam->n, &ray);
    }
    return all;
}

/* The next rays of the present field and wavelength; those that came through are put in. */
static void trace_part(struct ray_tracing *tracing, size_t count, struct ray_data *ray_data)
{
    const struct system *system = tracing->ways->clipped;
    const struct setup *setup = tracing->request.setup;
    const size_t groups = setup->wavelength_count;
    const size_t field = tracing->bundle / groups, group = tracing->bundle % groups;
    const struct pupil_point *points = tracing->pupil.sample.points + tracing->place;
    const double weight = setup->fields[field].weight * setup->wavelengths[group].weight;
    /* from where they start to where they end */
    const struct rays starts = {tracing->pupil.rays.blocks + tracing->place / RAYS_BLOCK, count};
    const struct rays rays = {tracing->rays.blocks, count};
    for (size_t b = 0; b < rays_blocks(&rays); b++) {
        rays.blocks[b] = starts.blocks[b];
        memset(rays.blocks[b].lost, 0, sizeof rays.blocks[b].lost);
    }
    rays_trace(system, &rays, NULL);
    struct ray_part *part = &tracing->part;
    double *const *to = part->columns;
    size_t unreachable = 0;
    /* places behind a thick lens that comes last count from its H' */
    const struct surface *last = &system->lens->surfaces[system->lens->surface_count - 1];
    double behind = surface_hiatus(last).hi, clear = 0;
    part->rays.count = part->lost_count = 0;
    for (size_t k = 0; k < count; k++) {
        struct ray start = rays_get(&starts, k, system->index_first);
        struct ray ray = rays_get(&tracing->rays, k, system->index_last);
        bool reached = start.status == RAY_OK;
        if (!reached || ray.status != RAY_OK || !(fabs(ray.cosine[2]) > 1e-6)) {
            unreachable += !reached;
            part->lost[part->lost_count++] =
                (struct ray_data_loss){points[k].x, points[k].y, field, group};
            continue;
        }
        size_t i = part->rays.count++;
        ray.point[2] -= behind;
        ray_data_store(to, i, &start);
        ray_data_store(to + 4, i, &ray);
        to[8][i] = weight * points[k].weight;
        to[9][i] = points[k].x;
        to[10][i] = points[k].y;
        part->groups[i] = group;
        part->fields[i] = field;
        clear += points[k].weight / (double)groups;
    }
    if (!tracing->is_counted) {
        ray_data->count += part->rays.count;
        ray_data->through[field] += part->rays.count;
        ray_data->clear[field] += clear;
        ray_data->wanted += count;
        ray_data->unreachable += unreachable;
        ray_data->clipped += part->lost_count - unreachable;
    }
}

void ray_data_rewind(struct ray_data *ray_data)
{
    struct ray_tracing *tracing = ray_data->tracing;
    tracing->bundle = tracing->place = tracing->next_kept = 0;
    tracing->pupil = (struct quadrature){.is_empty = true};
    tracing->is_open = false;
    arena_free(&tracing->scratch);
}

/* That was the last. */
static const struct ray_part *end_parts(struct ray_data *ray_data)
{
    ray_data_rewind(ray_data);
    ray_data->tracing->is_counted = true;
    return NULL;
}

const struct ray_part *ray_data_next(struct ray_data *ray_data)
{
    struct ray_tracing *tracing = ray_data->tracing;
    if (tracing->keeps && tracing->is_counted) {
        return tracing->next_kept < tracing->kept_count ? &tracing->kept[tracing->next_kept++]
                                                        : end_parts(ray_data);
    }
    while (tracing->place == tracing->pupil.sample.count) {
        tracing->bundle += tracing->is_open;
        tracing->is_open = true;
        if (tracing->bundle == tracing->bundles) {
            return end_parts(ray_data);
        }
        /* The rays of a field at a wavelength; none where it has no chief ray. */
        const size_t groups = tracing->request.setup->wavelength_count;
        arena_reset(&tracing->scratch, (struct arena_mark){0});
        tracing->place = 0;
        tracing->pupil = (struct quadrature){.is_empty = true};
        if (ray_data_open_field(tracing, tracing->bundle / groups, tracing->bundle % groups,
                                &tracing->last)) {
            tracing->pupil = choose_rays(tracing);
        } else if (!tracing->is_counted) {
            ray_data->wanted += tracing->sample.count;
            ray_data->unreachable += tracing->sample.count;
        }
    }
    size_t left = tracing->pupil.sample.count - tracing->place,
           count = left < RAY_PART ? left : RAY_PART;
    const size_t fields = tracing->request.setup->field_count;
    tracing->keeps = tracing->keeps && tracing->kept_rays + count <= MOST_KEPT;
    if (tracing->keeps) { /* in room of its own */
        tracing->part = part_new(tracing->arena, count, fields);
        tracing->kept_rays += count;
    } else {
        if (tracing->shared.columns[0] == NULL) {
            tracing->shared = part_new(tracing->arena, RAY_PART, fields);
        }
        tracing->part = tracing->shared;
    }
    trace_part(tracing, count, ray_data);
    tracing->place += count;
    if (tracing->keeps) {
        tracing->kept = arena_grow(tracing->arena, tracing->kept, tracing->kept_count,
                                   &tracing->kept_room, sizeof *tracing->kept);
        tracing->kept[tracing->kept_count++] = tracing->part;
    }
    return &tracing->part;
}

bool ray_data_check(const struct ray_data *ray_data, struct error *error)
{
    const struct ray_tracing *tracing = ray_data->tracing;
    if (ray_data->count > 0) {
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

bool ray_data_open(const struct ray_data_request *request, struct arena *arena,
                   struct ray_data *ray_data, struct error *error)
{
    const struct setup *setup = request->setup;
    const struct first_order *first = &setup->first;
    const size_t groups = setup->wavelength_count;
    struct ray_tracing *tracing = ARENA_NEW(arena, struct ray_tracing);
    *tracing = (struct ray_tracing){
        .request = *request, .arena = arena, .pupil = {.is_empty = true}, .keeps = true};
    if (setup->field_count == 0) {
        return fail(error, ERROR_DOMAIN, "there is no field: give {field}");
    }
    tracing->bundles = setup->field_count * groups;
    tracing->rays = rays_new(arena, RAY_PART);
    tracing->all = ARENA_ARRAY(arena, groups, struct ways);
    *ray_data = (struct ray_data){.tracing = tracing,
                                  .clear = ARENA_ARRAY(arena, setup->field_count, double),
                                  .through = ARENA_ARRAY(arena, setup->field_count, size_t),
                                  .index_object = ARENA_ARRAY(arena, groups, double),
                                  .index_image = ARENA_ARRAY(arena, groups, double)};
    for (size_t g = 0; g < groups; g++) {
        struct ways *ways = &tracing->all[g];
        const unsigned which = request->no_clip ? SETUP_OPEN : SETUP_CLIPPED;
        ways->open = setup_system(setup, g, SETUP_OPEN, error);
        ways->clipped = ways->open != NULL ? setup_system(setup, g, which, error) : NULL;
        if (ways->clipped == NULL) {
            return false;
        }
        ray_data->index_object[g] = copysign(ways->open->index_first, first->index_object);
        ray_data->index_image[g] = copysign(ways->open->index_last, first->index_image);
    }
    if (!sample_make(request->pattern, request->ray_count, request->seed, arena, &tracing->sample,
                     error)) {
        return false;
    }
    tracing->has_stop = tracing->all->open->stop != LENS_NONE && first->stop_radius > 0;
    tracing->radius = tracing->has_stop ? setup_stop_radius(setup) : first->entrance_diameter / 2;
    if (!(fabs(tracing->radius) > 0 && isfinite(tracing->radius))) {
        fail(
            error, ERROR_DOMAIN,
            "the lens has neither a stop with a diameter nor an aperture: the size of its pupil is "
            "not known");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    for (size_t i = 0; i < setup->field_count; i++) {
        const double field = ray_data_field_of(setup, i);
        if (setup->object.is_infinite && !(fabs(field) < 1.57)) {
            return fail(error, ERROR_DOMAIN,
                        "the field of %.6g degrees: the rays of a thick lens stay below 90",
                        field * DEGREES_PER_RADIAN);
        }
    }
    return true;
}
