/* design/merit/merit_reach.c - how far out light comes at each surface. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_reach.h"

#include "design/merit/merit_front.h"
#include "design/merit/merit_paraxial.h"

#include <math.h>

/* Of the axis, and the upper and the lower one of the edge of the field. */
enum { AXIS, UPPER, LOWER, EDGE_RAYS };

struct merit_edge_rays {
    struct field_point fields[EDGE_RAYS];
    double pupils[EDGE_RAYS][2];
    struct aim_near near[2]; /* chief rays of both fields */
    size_t count;
};

/* The plane of a field. */
static void merit_reach_direction_of(const struct field_point *field, double towards[2])
{
    const bool is_angle = field->kind == FIELD_ANGLE;
    const double x = is_angle ? tan(field->value[0]) : field->value[0];
    const double y = is_angle ? tan(field->value[1]) : field->value[1];
    const double size = hypot(x, y);
    towards[0] = size > 0 ? x / size : 0;
    towards[1] = size > 0 ? y / size : 1;
}

static struct merit_edge_rays *merit_reach_choose(const struct merit_place *place,
                                                  struct arena *arena)
{
    struct merit_edge_rays *edges = ARENA_NEW(arena, struct merit_edge_rays);
    const struct field_point axis = {.kind = FIELD_NONE}, *edge = &place->setup.edge;
    double towards[2];
    merit_reach_direction_of(edge, towards);
    edges->count = edge->kind == FIELD_NONE ? 1 : EDGE_RAYS;
    for (size_t i = 0; i < edges->count; i++) {
        const double side = i == LOWER ? -1 : 1;
        edges->fields[i] = i == AXIS ? axis : *edge;
        edges->pupils[i][0] = side * towards[0];
        edges->pupils[i][1] = side * towards[1];
    }
    return edges;
}

bool merit_reach_open(struct merit *merit, const struct merit_slot *slot, struct arena *arena,
                      struct error *error)
{
    struct merit_place *place = &merit->places[slot->place];
    const size_t columns = merit->variable_count > 0 ? merit->variable_count : 1;
    struct error ignored;
    if (place->reach != NULL) {
        return true;
    }
    if (!merit_needs_aperture(place, error)) {
        return error_prefix(error, "surfaces without a diameter are as large as the light: ");
    }
    place->reach = ARENA_ARRAY(arena, columns * place->lens->surface_count, struct dual);
    if (place->lens->stop != LENS_NONE && merit_ray_check(place, &place->setup.edge, &ignored)) {
        place->edges = merit_reach_choose(place, arena);
    }
    return true;
}

static struct merit_ray_question merit_reach_question_of(struct merit *merit,
                                                         const struct merit_slot *slot, size_t i)
{
    struct merit_edge_rays *edges = merit->places[slot->place].edges;
    return (struct merit_ray_question){.slot = slot,
                                       .light = merit_light(merit, slot, NAN),
                                       .field = &edges->fields[i],
                                       .pupil = {edges->pupils[i][0], edges->pupils[i][1]},
                                       .near = &edges->near[i == AXIS ? 0 : 1]};
}

/* The ray that is farthest out. */
static size_t merit_reach_farthest(const struct merit_front *front, double *height)
{
    size_t which = 0;
    *height = -1;
    for (size_t i = 0; i < front->count; i++) {
        const struct merit_ray ray = merit_front_ray(front, i);
        const double here = hypot(ray.at[0].value, ray.at[1].value);
        which = here > *height ? i : which;
        *height = fmax(here, *height);
    }
    return which;
}

/* Its height and the derivatives of that. */
static bool merit_reach_derive(struct merit *merit, const struct merit_ray_question *question,
                               size_t surface, const struct merit_ray *start, struct dual *reach)
{
    const size_t columns = merit_columns(merit);
    const size_t surfaces = merit->places[question->slot->place].lens->surface_count;
    struct merit_ray *end = ARENA_ARRAY(merit->arena, columns, struct merit_ray);
    if (!merit_ray_follow(merit, question, surface + 1, start, merit->arena, end)) {
        return false;
    }
    for (size_t j = 0; j < columns; j++) {
        const struct dual *at = end[j].at;
        const double height = hypot(at[0].value, at[1].value);
        /* on the axis the height has no slope: it is a corner */
        const double slope =
            height > 0 ? (at[0].value * at[0].slope + at[1].value * at[1].slope) / height : 0;
        reach[j * surfaces + surface] = (struct dual){height, slope};
    }
    return true;
}

static bool merit_reach_measure(struct merit *merit, const struct merit_slot *slot,
                                struct merit_ray *const *starts, struct merit_front *front)
{
    const struct merit_place *place = &merit->places[slot->place];
    for (size_t i = 0; i < place->lens->surface_count; i++) {
        double height;
        merit_front_pass(front, i);
        for (size_t k = 0; k < front->count; k++) {
            if (merit_front_lost(front, k)) {
                return fail(&merit->why, ERROR_DOMAIN, "a ray at the edge is lost at surface %zu",
                            i + 1);
            }
        }
        if (place->lens->surfaces[i].has_diameter) {
            continue;
        }
        const size_t which = merit_reach_farthest(front, &height);
        const struct merit_ray_question question = merit_reach_question_of(merit, slot, which);
        place->reach[i] = dual_of(height);
        if (merit->derives &&
            !merit_reach_derive(merit, &question, i, starts[which], place->reach)) {
            return false;
        }
    }
    return true;
}

static bool find_edges(struct merit *merit, const struct merit_slot *slot)
{
    const size_t count = merit->places[slot->place].edges->count;
    const struct merit_ray_question first = merit_reach_question_of(merit, slot, 0);
    struct merit_ray *starts[EDGE_RAYS];
    struct merit_front front;
    for (size_t i = 0; i < count; i++) {
        const struct merit_ray_question question = merit_reach_question_of(merit, slot, i);
        starts[i] = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
        if (!merit_ray_start(merit, &question, merit->arena, starts[i])) {
            return false;
        }
    }
    return merit_front_open(merit, &first, starts, count, &front) &&
           merit_reach_measure(merit, slot, starts, &front);
}

bool merit_reach(struct merit *merit, const struct merit_slot *slot)
{
    struct merit_place *place = &merit->places[slot->place];
    const struct arena_mark mark = arena_mark(merit->arena);
    if (place->reached == merit->evaluation) {
        return true;
    }
    const bool done =
        place->edges != NULL ? find_edges(merit, slot) : merit_reach_paraxial(merit, slot);
    place->reached = done ? merit->evaluation : 0;
    arena_reset(merit->arena, mark);
    return done;
}
