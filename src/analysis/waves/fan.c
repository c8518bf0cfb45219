/* analysis/waves/fan.c - ray fans: aberrations along two sections of the pupil. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/fan.h"

#include "analysis/waves/wave_reference.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

/* Rays at the edge of the stop are aimed so far within it that rounding does not clip them. */
static const double edge = 1 - 4e-13;
/* An end is found when the lost ray beside it is as near, in radii of the pupil. */
static const double narrow = 1e-9;

/* -------- the rays -------- */

/* A place in a section, from -1 to 1. */
struct fan_place {
    size_t section;
    double h;
};

/* Traces the rays of one wavelength. */
struct tracer {
    const struct fan *fan;
    const struct wave_reference *origin;
    const struct wave_light *light;
    struct arena *arena;
    double zero; /* path of the chief ray, mm */
};

static struct pupil_point fan_point_of(const struct fan *fan, const struct fan_place *place,
                                       double scale)
{
    double h = scale * place->h;
    double x = h * fan->along[0] + 0.0, y = h * fan->along[1] + 0.0;
    return place->section == FAN_TANGENTIAL ? (struct pupil_point){x, y, 0}
                                            : (struct pupil_point){y, 0.0 - x, 0};
}

static void fan_trace_places(const struct tracer *tracer, const struct fan_place *places,
                             size_t count, struct fan_ray *list)
{
    const struct arena_mark mark = arena_mark(tracer->arena);
    const struct fan *fan = tracer->fan;
    const struct wave_light *light = tracer->light;
    struct pupil_point *points = ARENA_ARRAY(tracer->arena, count, struct pupil_point);
    struct rays rays = rays_room(tracer->arena, count);
    for (size_t i = 0; i < count; i++) {
        points[i] = fan_point_of(fan, &places[i], light->question.clip ? edge : 1);
    }
    bundle_aim(&light->source, points, count, &rays);
    rays_trace(light->system, &rays, NULL);
    for (size_t i = 0; i < count; i++) {
        const struct ray ray = rays_get(&rays, i, light->system->index_last);
        const struct pupil_point point = fan_point_of(fan, &places[i], 1);
        list[i] = (struct fan_ray){.pupil = {point.x, point.y},
                                   .off = {NAN, NAN},
                                   .opd = NAN,
                                   .cosine = {NAN, NAN, NAN},
                                   .status = ray.status,
                                   .surface = ray.surface};
        if (ray.status == RAY_OK) {
            memcpy(list[i].cosine, ray.cosine, sizeof ray.cosine);
            /* from the reference to where a ray arrives, in the plane through it */
            const struct wave_reference *origin = tracer->origin;
            double *off = list[i].off;
            for (int k = 0; k < 2 && fan->is_angular; k++) {
                const double *axis = origin->across[k];
                off[k] = ray.cosine[0] * axis[0] + ray.cosine[1] * axis[1] +
                         ray.cosine[2] * axis[2] - origin->at[k];
            }
            double way = (fan->reference[2] - ray.point[2]) / ray.cosine[2];
            for (int k = 0; k < 2 && !fan->is_angular; k++) {
                off[k] = ray.point[k] - fan->reference[k] + way * ray.cosine[k];
            }
            list[i].opd = tracer->origin->no_opd == NULL
                              ? tracer->zero - opd_path(&tracer->origin->opd, &ray)
                              : (double)NAN;
        }
    }
    arena_reset(tracer->arena, mark);
}

static struct fan_place fan_place_of(const struct fan *fan, size_t i)
{
    const double last = (double)(fan->points - 1);
    return (struct fan_place){i / fan->points, (2 * (double)(i % fan->points) - last) / last};
}

/* -------- edges -------- */

/* Where a line across a stop leaves what is clear of it. */
struct fan_edge {
    double along[2]; /* the line through the centre of the stop: a unit vector */
    double h;        /* the place on it, in radii of the stop: about; receives it */
    bool is_found;
};

enum { FAN_EDGES_MOST = RAYS_BLOCK / 3 };

/* Rays for a step: one, and one beside it along u and v. */
enum { EACH = 3, STEPS = 10 };

/* Steps of differences, in u and v; what counts as there, of the excess and in radii. */
static const double beside = 1e-6, enough = 1e-12;

/* What rays of a step say. */
struct fan_edge_found {
    double excess, h, aside; /* h: along the line; aside: beside it */
};

static void fan_edge_look(const struct clearances *margins, const struct fan_edge *edges,
                          const double (*points)[2], size_t count, struct fan_edge_found *found)
{
    const struct system *system = margins->system;
    clearances_look(margins, points, count);
    for (size_t i = 0; i < count; i++) {
        found[i].excess = margins->excess[i];
    }
    clearances_go(margins, points, count, system_place(system, system->stop) + 1);
    for (size_t i = 0; i < count; i++) {
        const double *along = edges[i / EACH].along;
        double at[3];
        clearances_cross(margins, system->stop, i, at);
        found[i].h = (at[0] * along[0] + at[1] * along[1]) / margins->beam->radius;
        found[i].aside = (at[1] * along[0] - at[0] * along[1]) / margins->beam->radius;
    }
}

/*
 * Places of rays aimed at the stop, without aiming each that is looked at.
 *
 * Given     source  of rays that are aimed at a stop; else none is found
 *           edges   up to FAN_EDGES_MOST
 * Formula   Newton's method in the beam, its slopes by differences: the worst excess of all rims
 *           (trace/pupil/clearances.h) is 0, and so is the distance from the line where the ray
 *           crosses the stop
 * Limits    what is found is an edge, but perhaps another one: rays beside it tell
 */
static void fan_edges_find(const struct bundle_source *source, struct fan_edge *edges, size_t count,
                           struct arena *arena)
{
    double at[FAN_EDGES_MOST][2], points[RAYS_BLOCK][2];
    struct fan_edge_found found[RAYS_BLOCK];
    for (size_t k = 0; k < count; k++) {
        edges[k].is_found = false;
        at[k][0] = edges[k].h * edges[k].along[0];
        at[k][1] = edges[k].h * edges[k].along[1];
    }
    if (source->pupil.has_disc || isnan(source->pupil.radius) || count == 0) {
        return;
    }
    const struct arena_mark mark = arena_mark(arena);
    const struct clearances margins = clearances_open(&source->pupil, arena);
    bool busy = true;
    for (int turn = 0; turn < STEPS && busy; turn++) {
        for (size_t i = 0; i < EACH * count; i++) {
            points[i][0] = at[i / EACH][0] + (i % EACH == 1 ? beside : 0);
            points[i][1] = at[i / EACH][1] + (i % EACH == 2 ? beside : 0);
        }
        fan_edge_look(&margins, edges, (const double(*)[2])points, EACH * count, found);
        busy = false;
        for (size_t k = 0; k < count; k++) {
            const struct fan_edge_found *here = &found[EACH * k];
            edges[k].h = here->h;
            edges[k].is_found = fabs(here->excess) <= enough && fabs(here->aside) <= enough;
            if (!edges[k].is_found) {
                /* Newton's step of one edge from its three rays */
                const double excess[2] = {here[1].excess - here[0].excess,
                                          here[2].excess - here[0].excess};
                const double aside[2] = {here[1].aside - here[0].aside,
                                         here[2].aside - here[0].aside};
                const double scale = beside / (excess[0] * aside[1] - excess[1] * aside[0]);
                at[k][0] -= (aside[1] * here[0].excess - excess[1] * here[0].aside) * scale;
                at[k][1] -= (excess[0] * here[0].aside - aside[0] * here[0].excess) * scale;
            }
            busy = busy || (!edges[k].is_found && isfinite(at[k][0] + at[k][1]));
        }
    }
    arena_reset(arena, mark);
}

/* -------- the ends -------- */

/* Between a place whose ray arrives and one whose ray is lost. */
struct fan_gap {
    struct fan_place clear, dark;
    struct fan_ray *last; /* that arrives */
    size_t surface;       /* where the one behind it is lost */
};

/* Cut gaps in four until they are as narrow as wanted: four of them trace as fast as one. */
static void fan_close_gaps(const struct tracer *tracer, struct fan_gap *gaps, size_t count)
{
    enum { PARTS = 4, MOST = FAN_SECTIONS * FAN_ENDS * (PARTS - 1) };
    struct fan_place places[MOST];
    struct fan_ray rays[MOST];
    double width = 2 / (double)(tracer->fan->points - 1);
    for (; width > narrow && count > 0; width /= PARTS) {
        for (size_t i = 0; i < count * (PARTS - 1); i++) {
            const struct fan_gap *gap = &gaps[i / (PARTS - 1)];
            double share = (double)(i % (PARTS - 1) + 1) / PARTS;
            places[i] = gap->clear;
            places[i].h += share * (gap->dark.h - gap->clear.h);
        }
        fan_trace_places(tracer, places, count * (PARTS - 1), rays);
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

/* Gaps about edges that are known already become as narrow as wanted. */
static size_t jump_to_edges(const struct tracer *tracer, struct fan_gap *gaps, size_t count)
{
    enum { MOST = FAN_SECTIONS * FAN_ENDS };
    struct fan_edge edges[MOST];
    struct fan_place places[2 * MOST];
    struct fan_ray rays[2 * MOST];
    size_t left = 0;
    for (size_t i = 0; i < count; i++) {
        const struct pupil_point unit =
            fan_point_of(tracer->fan, &(struct fan_place){gaps[i].clear.section, 1}, 1);
        edges[i] =
            (struct fan_edge){{unit.x, unit.y}, (gaps[i].clear.h + gaps[i].dark.h) / 2, false};
    }
    fan_edges_find(&tracer->light->source, edges, count, tracer->arena);
    for (size_t i = 0; i < count; i++) {
        const struct fan_gap *gap = &gaps[i];
        const double side = gap->dark.h > gap->clear.h ? narrow / 2 : -narrow / 2;
        const double low = edges[i].h - side, high = edges[i].h + side;
        edges[i].is_found =
            edges[i].is_found && (low - gap->clear.h) * side > 0 && (gap->dark.h - high) * side > 0;
        places[2 * i] =
            edges[i].is_found ? (struct fan_place){gap->clear.section, low} : gap->clear;
        places[2 * i + 1] =
            edges[i].is_found ? (struct fan_place){gap->clear.section, high} : gap->dark;
    }
    fan_trace_places(tracer, places, 2 * count, rays);
    for (size_t i = 0; i < count; i++) {
        const struct fan_ray *last = &rays[2 * i], *lost = last + 1;
        if (edges[i].is_found && last->status == RAY_OK && lost->status != RAY_OK) {
            *gaps[i].last = *last;
            gaps[i].last->surface = lost->surface;
        } else {
            gaps[left++] = gaps[i];
        }
    }
    return left;
}

static void fan_find_ends(const struct tracer *tracer, const struct fan_ray *list,
                          struct fan_ends *ends)
{
    const struct fan *fan = tracer->fan;
    struct fan_gap gaps[FAN_SECTIONS * FAN_ENDS];
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
        gaps[count++] = (struct fan_gap){
            fan_place_of(fan, arrives ? i : i + 1), fan_place_of(fan, arrives ? i + 1 : i),
            &here->rays[here->count], list[arrives ? i + 1 : i].surface};
        here->count++;
    }
    count = jump_to_edges(tracer, gaps, count);
    fan_close_gaps(tracer, gaps, count);
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

bool fan_trace(const struct fan_question *question, struct arena *arena, struct fan *fan,
               struct error *error)
{
    const struct setup *setup = question->bundle.setup;
    struct wave_lights lights;
    struct wave_reference origin;
    struct bundle_question bundle = question->bundle;
    *fan = (struct fan){.is_angular = isnan(setup->image), .points = question->points};
    wave_section(bundle.field, fan->along);
    bundle.pattern = PATTERN_FAN;
    if (!wave_open(&bundle, arena, &lights, error) ||
        !wave_reference_find(&lights, question->about, arena, &origin, error)) {
        return false;
    }
    memcpy(fan->reference, origin.centre, sizeof fan->reference);
    fan->radius = origin.opd.is_plane ? INFINITY : origin.opd.radius;
    fan->no_opd = origin.no_opd;
    memcpy(fan->chief, lights.list[0].chief.cosine, sizeof fan->chief);
    const size_t each = FAN_SECTIONS * fan->points, count = lights.count * each;
    struct fan_place *places = ARENA_ARRAY(arena, each, struct fan_place);
    for (size_t i = 0; i < each; i++) {
        places[i] = fan_place_of(fan, i);
    }
    struct fan_ray *rays = ARENA_ARRAY(arena, count, struct fan_ray);
    struct fan_ends *ends = ARENA_ARRAY(arena, lights.count * FAN_SECTIONS, struct fan_ends);
    for (size_t g = 0; g < lights.count; g++) {
        const struct wave_light *light = &lights.list[g];
        double zero = origin.no_opd == NULL ? opd_path(&origin.opd, &light->chief) : (double)NAN;
        const struct tracer tracer = {fan, &origin, light, arena, zero};
        for (size_t s = 0; s < FAN_SECTIONS; s++) {
            ends[g * FAN_SECTIONS + s].count = 0;
        }
        fan_trace_places(&tracer, places, each, rays + g * each);
        fan_find_ends(&tracer, rays + g * each, ends + g * FAN_SECTIONS);
    }
    fan->rays = rays;
    fan->ends = ends;
    fan->islands = bundle_islands(&lights.list[0].source, arena);
    /* does one ray arrive? Else the error says where the chief ray ends */
    const struct wave_light *first = &lights.list[0];
    for (size_t i = 0; i < count; i++) {
        if (rays[i].status == RAY_OK) {
            return true;
        }
    }
    const struct ray chief = wave_light_trace(first->system, &first->source.chief, arena);
    return fail(error, ERROR_DOMAIN,
                "no ray of the fans arrives: the chief ray ends at surface %zu (%s)", chief.surface,
                ray_status_name(chief.status));
}
