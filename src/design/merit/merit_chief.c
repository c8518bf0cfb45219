/* design/merit/merit_chief.c - operands of real chief rays. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_chief.h"

#include "analysis/waves/wave_reference.h"
#include "design/merit/merit_paraxial.h"
#include "design/merit/merit_ray.h"

#include <math.h>

static const struct field_point *merit_chief_field_of(const struct merit_place *place,
                                                      const struct operand *operand)
{
    return operand->field != NULL ? &operand->field->point : &place->setup.edge;
}

/* The direction of a field in the object, and how far out: tan t, or mm. */
static double merit_chief_direction_of(const struct merit_place *place,
                                       const struct field_point *field, double towards[2])
{
    const bool is_angle = field->kind == FIELD_ANGLE;
    const double x = is_angle ? tan(field->value[0]) : field->value[0];
    const double y = is_angle ? tan(field->value[1]) : field->value[1];
    wave_section(field, towards);
    return (is_angle && !place->setup.object.is_infinite ? -1 : 1) *
           (x * towards[0] + y * towards[1]);
}

/* -------- one chief ray -------- */

/* Its end by all columns, into `end`. */
static bool merit_chief_follow(struct merit *merit, const struct merit_slot *slot,
                               double wavelength, size_t passed, struct merit_ray *end)
{
    const struct merit_place *place = &merit->places[slot->place];
    struct aim_near *near = slot->own; /* chief rays found last, one a light */
    struct merit_light *light = merit_light(merit, slot, wavelength);
    const struct merit_ray_question question = {.slot = slot,
                                                .light = light,
                                                .field = merit_chief_field_of(place, slot->operand),
                                                .near = &near[light - place->lights]};
    struct merit_ray *start = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
    return merit_ray_start(merit, &question, merit->arena, start) &&
           merit_ray_follow(merit, &question, passed, start, merit->arena, end);
}

static struct dual merit_chief_along(const struct dual *vector, const double towards[2])
{
    return dual_add(dual_scale(vector[0], towards[0]), dual_scale(vector[1], towards[1]));
}

/* The height of the chief ray in the image, into merit->change. */
static bool find_height(struct merit *merit, const struct merit_slot *slot, double wavelength)
{
    struct merit_ray *end = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
    double towards[2];
    merit_chief_direction_of(&merit->places[slot->place],
                             merit_chief_field_of(&merit->places[slot->place], slot->operand),
                             towards);
    if (!merit_chief_follow(merit, slot, wavelength, MERIT_RAY_IMAGE, end)) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] = merit_chief_along(end[j].at, towards);
    }
    return true;
}

static bool find_distortion(struct merit *merit, const struct merit_slot *slot, double wavelength)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct field_point *field = merit_chief_field_of(place, slot->operand);
    const bool far = place->setup.object.is_infinite, is_image = field->kind == FIELD_IMAGE;
    double towards[2];
    const double size = merit_chief_direction_of(place, field, towards);
    if (!find_height(merit, slot, wavelength)) {
        return false;
    }
    const struct merit_figures *figures = merit_figures(merit, slot, NAN);
    for (size_t j = 0; j < merit_columns(merit) && figures != NULL; j++) {
        const struct dual_first *first = &figures[j].first;
        const struct dual scale =
            far ? dual_multiply(first->index_object, first->efl) : first->magnification;
        const struct dual object =
            !is_image && far && field->kind != FIELD_ANGLE ? dual_of(NAN) : dual_of(size);
        const struct dual near = field->kind == FIELD_ANGLE && !far
                                     ? dual_scale(object, place->setup.object.distance.hi)
                                     : object;
        const struct dual ideal = is_image ? dual_of(size) : dual_multiply(scale, near);
        merit->change[j] =
            dual_scale(dual_divide(dual_subtract(merit->change[j], ideal), ideal), 100);
    }
    return figures != NULL;
}

static bool merit_chief_find_lateral(struct merit *merit, const struct merit_slot *slot,
                                     double wavelength)
{
    const size_t columns = merit_columns(merit);
    struct dual *first = ARENA_ARRAY(merit->arena, columns, struct dual);
    double colours[2];
    (void)wavelength;
    merit_colours(&merit->places[slot->place], slot->operand, colours);
    if (!find_height(merit, slot, colours[0])) {
        return false;
    }
    for (size_t j = 0; j < columns; j++) {
        first[j] = merit->change[j];
    }
    if (!find_height(merit, slot, colours[1])) {
        return false;
    }
    for (size_t j = 0; j < columns; j++) {
        merit->change[j] = dual_subtract(first[j], merit->change[j]);
    }
    return true;
}

static bool find_telecentric(struct merit *merit, const struct merit_slot *slot, double wavelength)
{
    const struct merit_place *place = &merit->places[slot->place];
    struct merit_ray *end = ARENA_ARRAY(merit->arena, merit_columns(merit), struct merit_ray);
    double towards[2];
    merit_chief_direction_of(place, merit_chief_field_of(place, slot->operand), towards);
    if (!merit_chief_follow(merit, slot, wavelength, place->lens->surface_count, end)) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] = dual_arc_tangent(
            dual_divide(merit_chief_along(end[j].along, towards), end[j].along[2]));
    }
    return true;
}

static bool (*const finds[OPERAND_KINDS])(struct merit *merit, const struct merit_slot *slot,
                                          double wavelength) = {
    [OPERAND_HEIGHT] = find_height,
    [OPERAND_DISTORTION] = find_distortion,
    [OPERAND_LATERAL] = merit_chief_find_lateral,
    [OPERAND_TELECENTRIC] = find_telecentric,
};

bool merit_fill_chief(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    const struct arena_mark mark = arena_mark(merit->arena);
    const bool found = finds[slot->operand->kind](merit, slot, slot->operand->wavelength) &&
                       merit_put(merit, slot, 0, residuals, jacobian);
    arena_reset(merit->arena, mark);
    return found;
}

size_t merit_prepare_chief(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    const struct merit_place *place = &merit->places[slot->place];
    const enum operand_kind kind = slot->operand->kind;
    const struct field_point *field = merit_chief_field_of(place, slot->operand);
    double towards[2], colours[2];
    if (field->kind == FIELD_NONE) {
        fail(error, ERROR_DOMAIN,
             "the lens states no field off its axis: say which, as in %s@10deg",
             operand_type(kind)->name);
        return 0;
    }
    merit_colours(place, slot->operand, colours);
    if (kind == OPERAND_LATERAL && colours[0] == colours[1]) {
        fail(error, ERROR_DOMAIN, "there is only one wavelength, and so no colour");
        return 0;
    }
    if (kind == OPERAND_DISTORTION &&
        !(fabs(merit_chief_direction_of(place, field, towards)) > 0)) {
        fail(error, ERROR_DOMAIN, "there is no distortion on the axis");
        return 0;
    }
    if (!merit_ray_check(place, field, error) ||
        (kind != OPERAND_TELECENTRIC && !merit_image_check(place, error))) {
        return 0;
    }
    slot->own = ARENA_ARRAY(arena, place->light_count, struct aim_near);
    return 1;
}
