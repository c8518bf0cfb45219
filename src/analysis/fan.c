/* analysis/fan.c - ray fans: aberrations along two sections of the pupil. */
/* SPDX-License-Identifier: MIT */
#include "analysis/fan.h"

#include "analysis/fan_sphere.h"
#include "analysis/opd.h"
#include "analysis/spot.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

static const double centroid_error = 1e-6;
/* Rays at the edge of the stop are aimed so far within it that rounding does not clip them. */
static const double edge = 1 - 4e-13;
/* An end is found when the lost ray beside it is as near, in radii of the pupil. */
static const double narrow = 1e-9;

/* What aberrations are counted from. */
struct origin {
    double at[2];        /* on the image plane, mm; or sines from the chief ray */
    double across[2][3]; /* of angles */
    struct opd_reference opd;
    bool has_opd;
};

/* The direction from the axis to the field point, as the pupil has it. */
static void find_section(const struct field_point *field, double along[2])
{
    double x = field->value[0], y = field->value[1];
    if (field->kind == FIELD_ANGLE && x != 0 && y != 0) {
        x = tan(x);
        y = tan(y);
    }
    double size = hypot(x, y);
    bool axis = field->kind == FIELD_NONE || !(size > 0);
    double sign = y < 0 || (!(y > 0) && x < 0) ? -1 : 1;
    along[0] = axis ? 0 : sign * x / size;
    along[1] = axis ? 1 : sign * y / size;
}

/* -------- the reference -------- */

static bool open_lights(const struct fan_question *question, struct arena *arena,
                        struct fan_lights *lights, struct error *error)
{
    const struct setup *setup = question->bundle.setup;
    *lights = (struct fan_lights){.count = setup->wavelength_count};
    lights->list = ARENA_ARRAY(arena, lights->count, struct fan_light);
    for (size_t g = 0; g < lights->count; g++) {
        struct fan_light *light = &lights->list[g];
        const unsigned which = SETUP_PATH | SETUP_IMAGE;
        *light = (struct fan_light){.question = question->bundle};
        light->question.wavelength = g;
        light->question.pattern = PATTERN_FAN;
        light->weight = setup->wavelengths[g].weight;
        light->wavelength = setup->wavelengths[g].wavelength;
        if (!bundle_open(&light->question, arena, &light->source, error)) {
            return false;
        }
        light->open = setup_system(setup, g, which, error);
        light->system = question->bundle.clip ? setup_system(setup, g, which | SETUP_CLIPPED, error)
                                              : light->open;
        if (light->open == NULL || light->system == NULL) {
            return false;
        }
        light->chief = fan_light_trace(light->open, &light->source.chief, arena);
        if (light->chief.status != RAY_OK) {
            return fail(error, ERROR_DOMAIN, "the chief ray is lost at surface %zu (%s)",
                        light->chief.surface, ray_status_name(light->chief.status));
        }
    }
    return true;
}

/* From the chief ray to the centroid, mm or sines. */
static bool find_centroid(const struct fan_question *question, const struct fan_lights *lights,
                          struct arena *arena, double off[2], struct error *error)
{
    struct spot_question asked = {
        .bundle = question->bundle, .error = centroid_error, .energy = NAN};
    struct spot spot;
    asked.bundle.pattern = PATTERN_GAUSS;
    if (!spot_find(&asked, arena, &spot, error)) {
        return false;
    }
    for (int i = 0; i < 2; i++) {
        off[i] = spot.centroid[i] - (spot.is_angular ? 0 : lights->list[0].chief.point[i]);
    }
    return true;
}

/* The plane wave across the direction that is `off` from the chief ray. */
static bool set_plane(const struct fan_light *light, double pupil, struct origin *origin,
                      struct error *error)
{
    struct ray towards = light->chief;
    const double *off = origin->at;
    double rest = sqrt(1 - off[0] * off[0] - off[1] * off[1]);
    spot_axes(light->chief.cosine, origin->across);
    for (int i = 0; i < 3; i++) {
        towards.cosine[i] = rest * light->chief.cosine[i] + off[0] * origin->across[0][i] +
                            off[1] * origin->across[1][i];
    }
    return opd_plane(&towards, pupil, light->open->index_last, &origin->opd, error);
}

/* Where the exit pupil of the first wavelength lies, in the frame of the image plane. */
static bool find_pupil(const struct setup *setup, double *pupil, struct error *error)
{
    struct setup_light light;
    if (!setup_light(setup, 0, &light, error)) {
        return false;
    }
    *pupil = light.first.exit_pupil - (isnan(setup->image) ? 0 : setup->image);
    return true;
}

/* The sphere or plane; that there is none is no error, but said. */
static bool set_reference(const struct fan_question *question, const struct fan_lights *lights,
                          struct arena *arena, struct origin *origin, struct fan *fan,
                          struct error *error)
{
    const struct fan_light *first = &lights->list[0];
    double off[2] = {0, 0}, pupil, n = first->open->index_last;
    if (!find_pupil(question->bundle.setup, &pupil, error) ||
        (question->about == FAN_CENTROID && !find_centroid(question, lights, arena, off, error))) {
        return false;
    }
    memcpy(origin->at, off, sizeof off);
    double centre[3] = {first->chief.point[0] + off[0], first->chief.point[1] + off[1], 0};
    origin->has_opd = fan->is_angular
                          ? set_plane(first, pupil, origin, error)
                          : opd_sphere(&first->chief, pupil, n, centre, &origin->opd, error);
    if (origin->has_opd && question->about == FAN_BEST &&
        !fan_sphere_fit(lights, pupil, arena, &origin->opd, error)) {
        return false;
    }
    if (!origin->has_opd) {
        if (question->about == FAN_BEST) {
            return false;
        }
        fan->no_opd = arena_printf(arena, "%s", error->message);
        error->code = ERROR_NONE;
    }
    memcpy(fan->reference, question->about == FAN_BEST ? origin->opd.centre : centre,
           sizeof fan->reference);
    fan->radius = origin->opd.is_plane ? INFINITY : origin->opd.radius;
    return true;
}

/* -------- the rays -------- */

/* From the reference to where a ray arrives, in the plane through it. */
static void find_off(const struct fan *fan, const struct origin *origin, const struct ray *ray,
                     double off[2])
{
    for (int i = 0; i < 2 && fan->is_angular; i++) {
        const double *axis = origin->across[i];
        off[i] = ray->cosine[0] * axis[0] + ray->cosine[1] * axis[1] + ray->cosine[2] * axis[2] -
                 origin->at[i];
    }
    double way = (fan->reference[2] - ray->point[2]) / ray->cosine[2];
    for (int i = 0; i < 2 && !fan->is_angular; i++) {
        off[i] = ray->point[i] - fan->reference[i] + way * ray->cosine[i];
    }
}

/* A place in a section, from -1 to 1. */
struct place {
    size_t section;
    double h;
};

/* Traces the rays of one wavelength. */
struct tracer {
    const struct fan *fan;
    const struct origin *origin;
    const struct fan_light *light;
    struct arena *arena;
    double zero; /* path of the chief ray, mm */
};

static struct pupil_point point_of(const struct fan *fan, const struct place *place, double scale)
{
    double h = scale * place->h;
    double x = h * fan->along[0] + 0.0, y = h * fan->along[1] + 0.0;
    return place->section == FAN_TANGENTIAL ? (struct pupil_point){x, y, 0}
                                            : (struct pupil_point){y, 0.0 - x, 0};
}

static void trace_places(const struct tracer *tracer, const struct place *places, size_t count,
                         struct fan_ray *list)
{
    const struct arena_mark mark = arena_mark(tracer->arena);
    const struct fan *fan = tracer->fan;
    const struct fan_light *light = tracer->light;
    struct pupil_point *points = ARENA_ARRAY(tracer->arena, count, struct pupil_point);
    struct rays rays = rays_new(tracer->arena, count);
    for (size_t i = 0; i < count; i++) {
        points[i] = point_of(fan, &places[i], light->question.clip ? edge : 1);
    }
    bundle_aim(&light->source, points, count, &rays);
    rays_trace(light->system, &rays, NULL);
    for (size_t i = 0; i < count; i++) {
        const struct ray ray = rays_get(&rays, i, light->system->index_last);
        const struct pupil_point point = point_of(fan, &places[i], 1);
        list[i] = (struct fan_ray){.pupil = {point.x, point.y},
                                   .off = {NAN, NAN},
                                   .opd = NAN,
                                   .status = ray.status,
                                   .surface = ray.surface};
        if (ray.status == RAY_OK) {
            find_off(fan, tracer->origin, &ray, list[i].off);
            list[i].opd = tracer->origin->has_opd
                              ? tracer->zero - opd_path(&tracer->origin->opd, &ray)
                              : (double)NAN;
        }
    }
    arena_reset(tracer->arena, mark);
}

static struct place place_of(const struct fan *fan, size_t i)
{
    const double last = (double)(fan->points - 1);
    return (struct place){i / fan->points, (2 * (double)(i % fan->points) - last) / last};
}

/* -------- the ends -------- */

/* Between a place whose ray arrives and one whose ray is lost. */
struct gap {
    struct place clear, dark;
    struct fan_ray *last; /* that arrives */
    size_t surface;       /* where the one behind it is lost */
};

/* Cut gaps in four until they are as narrow as wanted: four of them trace as fast as one. */
static void close_gaps(const struct tracer *tracer, struct gap *gaps, size_t count)
{
    enum { PARTS = 4, MOST = FAN_SECTIONS * FAN_ENDS * (PARTS - 1) };
    struct place places[MOST];
    struct fan_ray rays[MOST];
    double width = 2 / (double)(tracer->fan->points - 1);
    for (; width > narrow && count > 0; width /= PARTS) {
        for (size_t i = 0; i < count * (PARTS - 1); i++) {
            const struct gap *gap = &gaps[i / (PARTS - 1)];
            double share = (double)(i % (PARTS - 1) + 1) / PARTS;
            places[i] = gap->clear;
            places[i].h += share * (gap->dark.h - gap->clear.h);
        }
        trace_places(tracer, places, count * (PARTS - 1), rays);
        for (size_t i = 0; i < count; i++) {
            const size_t first = i * (PARTS - 1);
            size_t k = first;
            for (; k < first + PARTS - 1 && rays[k].status == RAY_OK; k++) {
                gaps[i].clear = places[k];
                *gaps[i].last = rays[k];
            }
            if (k < first + PARTS - 1) {
                gaps[i].dark = places[k];
                gaps[i].surface = rays[k].surface;
            }
        }
    }
}

static void find_ends(const struct tracer *tracer, const struct fan_ray *list,
                      struct fan_ends *ends)
{
    const struct fan *fan = tracer->fan;
    struct gap gaps[FAN_SECTIONS * FAN_ENDS];
    size_t count = 0;
    for (size_t i = 0; i < FAN_SECTIONS * fan->points; i++) {
        struct fan_ends *here = &ends[i / fan->points];
        bool arrives = list[i].status == RAY_OK;
        if ((i + 1) % fan->points == 0 || arrives == (list[i + 1].status == RAY_OK) ||
            here->count == FAN_ENDS) {
            continue;
        }
        if (list[arrives ? i + 1 : i].status == RAY_NOT_CONVERGED) {
            continue; /* aiming fails there, after a long search each time: no edge of the pupil */
        }
        here->rays[here->count] = list[arrives ? i : i + 1];
        here->behind[here->count] = i % fan->points;
        gaps[count++] =
            (struct gap){place_of(fan, arrives ? i : i + 1), place_of(fan, arrives ? i + 1 : i),
                         &here->rays[here->count], list[arrives ? i + 1 : i].surface};
        here->count++;
    }
    close_gaps(tracer, gaps, count);
    for (size_t i = 0; i < count; i++) {
        gaps[i].last->surface = gaps[i].surface;
    }
}

size_t fan_line(const struct fan *fan, size_t wavelength, enum fan_section section,
                struct fan_ray *list)
{
    const size_t line = wavelength * FAN_SECTIONS + section;
    const struct fan_ends *ends = &fan->ends[line];
    size_t count = 0, end = 0;
    for (size_t i = 0; i < fan->points; i++) {
        list[count++] = fan->rays[line * fan->points + i];
        for (; end < ends->count && ends->behind[end] == i; end++) {
            list[count++] = ends->rays[end];
        }
    }
    return count;
}

static void trace_light(const struct tracer *tracer, struct fan_ray *list, struct fan_ends *ends)
{
    const size_t count = FAN_SECTIONS * tracer->fan->points;
    struct place *places = ARENA_ARRAY(tracer->arena, count, struct place);
    for (size_t i = 0; i < count; i++) {
        places[i] = place_of(tracer->fan, i);
    }
    trace_places(tracer, places, count, list);
    find_ends(tracer, list, ends);
}

/* Does one ray arrive? Else the error says where the chief ray ends. */
static bool check_light(const struct fan_lights *lights, const struct fan_ray *rays, size_t count,
                        struct arena *arena, struct error *error)
{
    const struct fan_light *first = &lights->list[0];
    for (size_t i = 0; i < count; i++) {
        if (rays[i].status == RAY_OK) {
            return true;
        }
    }
    const struct ray chief = fan_light_trace(first->system, &first->source.chief, arena);
    return fail(error, ERROR_DOMAIN,
                "no ray of the fans arrives: the chief ray ends at surface %zu (%s)", chief.surface,
                ray_status_name(chief.status));
}

bool fan_trace(const struct fan_question *question, struct arena *arena, struct fan *fan,
               struct error *error)
{
    const struct setup *setup = question->bundle.setup;
    struct fan_lights lights;
    struct origin origin = {.at = {0, 0}};
    *fan = (struct fan){.is_angular = isnan(setup->image), .points = question->points};
    if (fan->is_angular && question->about == FAN_BEST) {
        return fail(error, ERROR_DOMAIN,
                    "the image lies infinitely far away: no sphere fits its wave front, but the "
                    "chief ray and the centroid are references");
    }
    find_section(question->bundle.field, fan->along);
    if (!open_lights(question, arena, &lights, error) ||
        !set_reference(question, &lights, arena, &origin, fan, error)) {
        return false;
    }
    const size_t count = lights.count * FAN_SECTIONS * fan->points;
    struct fan_ray *rays = ARENA_ARRAY(arena, count, struct fan_ray);
    struct fan_ends *ends = ARENA_ARRAY(arena, lights.count * FAN_SECTIONS, struct fan_ends);
    for (size_t g = 0; g < lights.count; g++) {
        const struct fan_light *light = &lights.list[g];
        double zero = origin.has_opd ? opd_path(&origin.opd, &light->chief) : (double)NAN;
        const struct tracer tracer = {fan, &origin, light, arena, zero};
        for (size_t s = 0; s < FAN_SECTIONS; s++) {
            ends[g * FAN_SECTIONS + s].count = 0;
        }
        trace_light(&tracer, rays + g * FAN_SECTIONS * fan->points, ends + g * FAN_SECTIONS);
    }
    fan->rays = rays;
    fan->ends = ends;
    fan->islands = bundle_islands(&lights.list[0].source, arena);
    return check_light(&lights, rays, count, arena, error);
}
