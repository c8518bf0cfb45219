/* design/merit/merit_chief.c - operands of real chief rays. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_kinds.h"

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
static double chief_direction_of(const struct merit_place *place, const struct field_point *field,
                                 double towards[2])
{
    const bool is_angle = field->kind == FIELD_ANGLE;
    const double x = is_angle ? tan(field->value[0]) : field->value[0];
    const double y = is_angle ? tan(field->value[1]) : field->value[1];
    wave_section(field, towards);
    return (is_angle && !place->setup.object.is_infinite ? -1 : 1) *
           (x * towards[0] + y * towards[1]);
}

static struct dual chief_along(const struct dual *vector, const double towards[2])
{
    return dual_add(dual_scale(vector[0], towards[0]), dual_scale(vector[1], towards[1]));
}

/* Per cent that a height is off the ideal one of a field that is so far out. */
static struct dual distortion_of(const struct merit_place *place, const struct field_point *field,
                                 double size, const struct dual_first *first, struct dual height)
{
    const bool far = place->setup.object.is_infinite, is_image = field->kind == FIELD_IMAGE;
    const struct dual scale =
        far ? dual_multiply(first->index_object, first->efl) : first->magnification;
    const struct dual object =
        !is_image && far && field->kind != FIELD_ANGLE ? dual_of(NAN) : dual_of(size);
    const struct dual near = field->kind == FIELD_ANGLE && !far
                                 ? dual_scale(object, place->setup.object.distance.hi)
                                 : object;
    const struct dual ideal = is_image ? dual_of(size) : dual_multiply(scale, near);
    return dual_scale(dual_divide(dual_subtract(height, ideal), ideal), 100);
}

/* The figure of the chief rays, which are aimed, into merit->change: of lateral colour two. */
static bool merit_chief_find(struct merit *merit, const struct merit_slot *slot)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct field_point *field = merit_chief_field_of(place, slot->operand);
    const enum operand_kind kind = slot->operand->kind;
    const size_t rays = kind == OPERAND_LATERAL ? 2 : 1;
    const size_t at = kind == OPERAND_TELECENTRIC ? place->lens->surface_count : LENS_NONE;
    struct merit_ray *ends[2];
    double towards[2];
    const double size = chief_direction_of(place, field, towards);
    for (size_t i = 0; i < rays; i++) {
        ends[i] = ARENA_ARRAY(merit->arena, merit->variable_count + 1, struct merit_ray);
        if (!merit_ray_trace(merit, slot->own, i) ||
            !merit_ray_derive(merit, slot->own, i, at, ends[i])) {
            return false;
        }
    }
    const struct merit_figures *figures = merit_figures(merit, slot, NAN);
    if (figures == NULL) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        const struct merit_ray *end = &ends[0][j];
        struct dual change = chief_along(end->at, towards);
        if (kind == OPERAND_DISTORTION) {
            change = distortion_of(place, field, size, &figures[j].first, change);
        } else if (kind == OPERAND_LATERAL) {
            change = dual_subtract(change, chief_along(ends[1][j].at, towards));
        } else if (kind == OPERAND_TELECENTRIC) {
            change = dual_arc_tangent(dual_divide(chief_along(end->along, towards), end->along[2]));
        }
        merit->change[j] = change;
    }
    return true;
}

bool merit_fill_chief(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    if (!merit_beams_aim(merit, slot, slot->own)) {
        return false;
    }
    const struct arena_mark mark = arena_mark(merit->arena);
    const bool found =
        merit_chief_find(merit, slot) && merit_put(merit, slot, 0, residuals, jacobian);
    arena_reset(merit->arena, mark);
    return found;
}

size_t merit_prepare_chief(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    const struct merit_place *place = &merit->places[slot->place];
    const enum operand_kind kind = slot->operand->kind;
    const struct field_point *field = merit_chief_field_of(place, slot->operand);
    static const struct pupil_point middle = {0, 0, 1};
    struct setup_field *fields = ARENA_NEW(arena, struct setup_field);
    struct setup_wavelength *lights = ARENA_ARRAY(arena, 2, struct setup_wavelength);
    struct bundle_wish wish = {.fields = fields,
                               .field_count = 1,
                               .wavelengths = lights,
                               .wavelength_count = kind == OPERAND_LATERAL ? 2 : 1,
                               .points = &middle,
                               .point_count = 1,
                               .is_bare = kind == OPERAND_TELECENTRIC};
    double towards[2], colours[2];
    *fields = (struct setup_field){*field, 1};
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
    if (kind == OPERAND_DISTORTION && !(fabs(chief_direction_of(place, field, towards)) > 0)) {
        fail(error, ERROR_DOMAIN, "there is no distortion on the axis");
        return 0;
    }
    if (!merit_ray_check(place, field, error) ||
        (kind != OPERAND_TELECENTRIC && !merit_image_check(place, error))) {
        return 0;
    }
    if (kind != OPERAND_LATERAL) {
        colours[0] = merit_light(merit, slot, slot->operand->wavelength)->wavelength;
    }
    for (size_t i = 0; i < wish.wavelength_count; i++) {
        lights[i] = (struct setup_wavelength){colours[i], 1};
    }
    slot->own = ARENA_NEW(arena, struct merit_beams);
    return merit_ray_open(merit, slot, &wish, arena, slot->own, error) ? 1 : 0;
}
