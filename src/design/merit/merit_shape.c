/* design/merit/merit_shape.c - operands of what can be made: thicknesses of glass and air. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_shape.h"

#include "analysis/waves/wave_reference.h"
#include "design/merit/merit_paraxial.h"
#include "design/merit/merit_ray.h"

#include <math.h>

/* -------- how far out light comes -------- */

/* Of the axis, and the upper and the lower one of the edge of the field. */
enum { AXIS, UPPER, LOWER, EDGE_RAYS };

struct merit_edge_rays {
    struct field_point fields[EDGE_RAYS];
    double pupils[EDGE_RAYS][2];
    struct aim_near near[2]; /* chief rays of both fields */
    size_t count;
};

static struct merit_edge_rays *merit_reach_choose(const struct merit_place *place,
                                                  struct arena *arena)
{
    struct merit_edge_rays *edges = ARENA_NEW(arena, struct merit_edge_rays);
    const struct field_point axis = {.kind = FIELD_NONE}, *edge = &place->setup.edge;
    double towards[2];
    wave_section(edge, towards);
    edges->count = edge->kind == FIELD_NONE ? 1 : EDGE_RAYS;
    for (size_t i = 0; i < edges->count; i++) {
        const double side = i == LOWER ? -1 : 1;
        edges->fields[i] = i == AXIS ? axis : *edge;
        edges->pupils[i][0] = side * towards[0];
        edges->pupils[i][1] = side * towards[1];
    }
    return edges;
}

/*
 * Make ready: how far out light comes at each surface of the slot's place that states no diameter.
 *
 * Errors    no aperture
 */
static bool merit_reach_open(struct merit *merit, const struct merit_slot *slot,
                             struct arena *arena, struct error *error)
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

/*
 * Those distances and their derivatives, into place->reach.
 *
 * Formula   the largest of real rays of the primary wavelength through the edge of the stop: of the
 *           axis, and of the field farthest from it the two in its plane. Where the lens has no
 *           such rays (no stop, an ideal lens, heights of the real image) |y| + |ybar| of the
 *           paraxial marginal and chief ray
 * Errors    merit->why: a ray is lost
 */
static bool merit_reach(struct merit *merit, const struct merit_slot *slot)
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

/* -------- spaces -------- */

/* Between two surfaces; what only is the stop does not end it. */
struct space {
    size_t left, right;
    double direction; /* of the light */
    bool is_air;
};

/* A place of it. */
enum space_place { SPACE_AXIS, SPACE_EDGE, SPACE_PLACES };

static bool is_only_stop(const struct surface *surface)
{
    return surface->kind == SURFACE_STOP;
}

/* The space behind a surface; false: there is none that counts. */
static bool space_behind(const struct lens *lens, size_t surface, struct space *space)
{
    double direction = 1;
    for (size_t i = 0; i <= surface; i++) {
        direction = surface_reflects(&lens->surfaces[i]) ? -direction : direction;
    }
    *space = (struct space){surface, surface + 1, direction,
                            medium_is_air(&lens->surfaces[surface].medium)};
    while (space->right + 1 < lens->surface_count && is_only_stop(&lens->surfaces[space->right])) {
        space->right++;
    }
    return space->right < lens->surface_count && !is_only_stop(&lens->surfaces[surface]) &&
           !is_only_stop(&lens->surfaces[space->right]);
}

/* Does the operand look at this place of the space? */
static bool merit_shape_is_wanted(enum operand_kind kind, const struct space *space,
                                  enum space_place place)
{
    return kind == OPERAND_AIR ? space->is_air
                               : !space->is_air && (kind == OPERAND_EDGE) == (place == SPACE_EDGE);
}

/* -------- the edge -------- */

/* z of a surface at r, and its derivatives by c, k and r. */
struct sag {
    double value, by_curvature, by_conic, by_radius;
};

/* z = c u/(1 + s), s^2 = 1 - (1+k) c^2 u, u = r^2; and the series. */
static struct sag sag_at(const struct surface *surface, double r)
{
    struct sag sag = {0};
    if (!surface_has(surface, SURFACE_HAS_CURVE)) {
        return sag;
    }
    const double c = surface_base_curvature(surface).hi, k1 = 1 + surface->conic.value.hi;
    const double u = r * r, s = sqrt(1 - k1 * c * c * u), share = u / (1 + s);
    sag.value = c * share;
    /* ds/dc = -k1 c u/s, ds/dk = -c^2 u/(2 s), ds/dr = -k1 c^2 r/s */
    sag.by_curvature = share + c * share * k1 * c * u / (s * (1 + s));
    sag.by_conic = c * share * c * c * u / (2 * s * (1 + s));
    sag.by_radius = c * r / s;
    for (int term = 0; term < LENS_COEFFICIENTS; term++) {
        const int order = surface_order(term);
        const double A = surface->coefficient[term].value.hi;
        if (A != 0) {
            sag.value += A * pow(r, order);
            sag.by_radius += A * order * pow(r, order - 1);
        }
    }
    return sag;
}

/* How a sag at r changes by a number of its surface. */
static double sag_slope(const struct sag *sag, double r, struct parameter basis)
{
    if (basis.kind == PARAMETER_CURVATURE) {
        return sag->by_curvature;
    }
    if (basis.kind == PARAMETER_CONIC) {
        return sag->by_conic;
    }
    if (basis.kind == PARAMETER_COEFFICIENT) {
        return pow(r, basis.order);
    }
    return 0;
}

/* The semi-diameter of a surface by a variable: half its diameter, or where light comes. */
static struct dual reach_of(const struct merit_place *place, size_t surface, size_t column)
{
    const struct surface *at = &place->lens->surfaces[surface];
    return at->has_diameter ? dual_of(at->diameter.value.hi / 2)
                            : place->reach[column * place->lens->surface_count + surface];
}

/* How far out the edge is. */
static struct dual merit_shape_edge_of(const struct merit_place *place, const struct space *space,
                                       size_t column)
{
    const struct dual left = reach_of(place, space->left, column);
    const struct dual right = reach_of(place, space->right, column);
    return (left.value < right.value) == space->is_air ? left : right;
}

/* -------- figures -------- */

/* The thickness in one place, by all columns, into merit->change. */
static void merit_shape_measure(struct merit *merit, const struct merit_place *place,
                                const struct space *space, enum space_place where)
{
    const struct lens *lens = place->lens;
    const struct merit_light *light = &place->lights[0];
    const bool at_edge = where == SPACE_EDGE;
    const double r = at_edge ? merit_shape_edge_of(place, space, 0).value : 0;
    const struct sag left = sag_at(&lens->surfaces[space->left], r);
    const struct sag right = sag_at(&lens->surfaces[space->right], r);
    double value = right.value - left.value;
    for (size_t i = space->left; i < space->right; i++) {
        value += lens->surfaces[i].thickness.value.hi;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        const double along = at_edge ? merit_shape_edge_of(place, space, j).slope : 0;
        merit->change[j].value = space->direction * value;
        merit->change[j].slope = space->direction * along * (right.by_radius - left.by_radius);
    }
    for (size_t i = 0; i < light->link_count && merit->derives; i++) {
        const struct variable_link *link = &light->links[i];
        const size_t surface = link->basis.surface;
        double slope = 0;
        if (link->basis.kind == PARAMETER_THICKNESS) {
            slope = surface >= space->left && surface < space->right ? 1 : 0;
        } else if (surface == space->right) {
            slope = at_edge ? sag_slope(&right, r, link->basis) : 0;
        } else if (surface == space->left) {
            slope = at_edge ? -sag_slope(&left, r, link->basis) : 0;
        }
        merit->change[link->variable].slope += space->direction * slope * link->slope;
    }
}

/* Is the light wanted for the edge of a space? */
static bool wants_reach(const struct lens *lens, enum operand_kind kind, const struct space *space)
{
    return merit_shape_is_wanted(kind, space, SPACE_EDGE) &&
           !(lens->surfaces[space->left].has_diameter && lens->surfaces[space->right].has_diameter);
}

size_t merit_prepare_shape(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    struct merit_place *place = &merit->places[slot->place];
    const struct lens *lens = place->lens;
    const enum operand_kind kind = slot->operand->kind;
    size_t count = 0, first, end;
    bool reaches = false;
    struct space space;
    merit_surfaces(slot->operand, lens, &first, &end);
    for (size_t i = first; i < end && i < lens->surface_count; i++) {
        if (space_behind(lens, i, &space)) {
            count += merit_shape_is_wanted(kind, &space, SPACE_AXIS) +
                     merit_shape_is_wanted(kind, &space, SPACE_EDGE);
            reaches = reaches || wants_reach(lens, kind, &space);
        }
    }
    if (count == 0) {
        fail(error, ERROR_DOMAIN, "no %s lies behind these surfaces",
             kind == OPERAND_AIR ? "air" : "glass");
    }
    return reaches && !merit_reach_open(merit, slot, arena, error) ? 0 : count;
}

bool merit_fill_shape(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    const struct merit_place *place = &merit->places[slot->place];
    size_t at = 0, first, end;
    struct space space;
    merit_light(merit, slot, NAN);
    if (place->reach != NULL && !merit_reach(merit, slot)) {
        return false;
    }
    merit_surfaces(slot->operand, place->lens, &first, &end);
    for (size_t i = first; i < end && i < place->lens->surface_count; i++) {
        const bool is_there = space_behind(place->lens, i, &space);
        for (int where = 0; is_there && where < SPACE_PLACES; where++) {
            if (!merit_shape_is_wanted(slot->operand->kind, &space, (enum space_place)where)) {
                continue;
            }
            merit_shape_measure(merit, place, &space, (enum space_place)where);
            if (!merit_put(merit, slot, at++, residuals, jacobian)) {
                return fail(&merit->why, ERROR_DOMAIN,
                            "surface %zu or %zu does not reach as far out as its edge",
                            space.left + 1, space.right + 1);
            }
        }
    }
    return true;
}
