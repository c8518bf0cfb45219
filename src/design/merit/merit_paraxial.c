/* design/merit/merit_paraxial.c - operands of paraxial rays: focal lengths, Seidel sums. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_paraxial.h"

#include <math.h>

/* -------- figures of an evaluation -------- */

/* The lens changed by one variable. */
static void paraxial_change(const struct merit *merit, struct merit_light *light, size_t variable)
{
    if (!merit->derives) {
        return;
    }
    paraxial_dual_rest(&light->paraxial);
    for (size_t i = 0; i < light->link_count; i++) {
        const struct variable_link *link = &light->links[i];
        if (link->variable == variable) {
            paraxial_dual_change(&light->paraxial, link->basis, link->slope);
        }
    }
}

/* All columns of a light; the stop is that of the primary one. */
static bool merit_paraxial_compute(struct merit *merit, const struct merit_place *place,
                                   struct merit_light *light, const struct dual_question *question,
                                   const struct merit_figures *primary)
{
    if (light->figured == merit->evaluation && light->field_kind == question->field_kind &&
        light->field == question->field) {
        return true;
    }
    if (!paraxial_dual_read(place->lens, light->wavelength, &light->paraxial, &merit->why)) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        struct dual_question here = *question;
        here.primary = primary != NULL ? &primary[j].first : NULL;
        paraxial_change(merit, light, j);
        paraxial_dual_first(&light->paraxial, &here, &light->figures[j].first);
    }
    light->figured = merit->evaluation;
    light->field_kind = question->field_kind;
    light->field = question->field;
    light->summed = 0;
    return true;
}

/* Paraxial figures of a slot, one a column; of its light, or the primary one where that is null. */
static const struct merit_figures *
paraxial_figures_of(struct merit *merit, const struct merit_slot *slot, struct merit_light *light)
{
    struct merit_place *place = &merit->places[slot->place];
    struct merit_light *primary = merit_light(merit, slot, NAN);
    /* the chief ray of the field of an operand, else of the edge */
    const struct setup *setup = &place->setup;
    const struct field_point *point =
        slot->operand->field != NULL ? &slot->operand->field->point : &setup->edge;
    const struct field_point field = setup_in_section(setup, point);
    const struct dual_question question = {.object = &setup->object,
                                           .aperture = &place->aperture,
                                           .field_kind = field.kind,
                                           .field = field.value[setup_axis(setup)]};
    const bool done = merit_paraxial_compute(merit, place, primary, &question, NULL) &&
                      (light == primary ||
                       merit_paraxial_compute(merit, place, light, &question, primary->figures));
    return done ? light->figures : NULL;
}

const struct merit_figures *merit_figures(struct merit *merit, const struct merit_slot *slot,
                                          double wavelength)
{
    return paraxial_figures_of(merit, slot, merit_light(merit, slot, wavelength));
}

/* What the kinds are of. */
static const size_t members[OPERAND_KINDS] = {
    [OPERAND_EFL] = offsetof(struct dual_first, power),
    [OPERAND_BFL] = offsetof(struct dual_first, bfl),
    [OPERAND_FFL] = offsetof(struct dual_first, ffl),
    [OPERAND_LENGTH] = offsetof(struct dual_first, length),
    [OPERAND_MAGNIFICATION] = offsetof(struct dual_first, magnification),
    [OPERAND_FNUMBER] = offsetof(struct dual_first, fnumber),
    [OPERAND_PETZVAL] = offsetof(struct dual_first, petzval),
    [OPERAND_AXIAL] = offsetof(struct dual_first, image),
};

static struct dual merit_paraxial_member(const struct merit_figures *figures,
                                         const struct merit_slot *slot)
{
    const char *start = (const char *)&figures->first + members[slot->operand->kind];
    return *(const struct dual *)(const void *)start;
}

/* One residual, unless something stands against it. */
static size_t one_unless(bool wrong, const char *words, struct error *error)
{
    return wrong && !fail(error, ERROR_DOMAIN, "%s", words) ? 0 : 1;
}

/* -------- focal length, Petzval radius -------- */

size_t merit_prepare_power(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    (void)merit;
    (void)arena;
    return merit_inverse_check(slot->operand, error) ? 1 : 0;
}

bool merit_fill_power(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    const struct merit_figures *figures = merit_figures(merit, slot, slot->operand->wavelength);
    if (figures == NULL) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        merit->change[j] = merit_paraxial_member(&figures[j], slot);
    }
    return merit_put_inverse(merit, slot, 0, residuals, jacobian);
}

/* -------- other figures of first order -------- */

size_t merit_prepare_first(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    const struct merit_place *place = &merit->places[slot->place];
    const enum operand_kind kind = slot->operand->kind;
    (void)arena;
    if (kind == OPERAND_MAGNIFICATION) {
        return one_unless(place->setup.object.is_infinite,
                          "the object is infinitely far away, its magnification 0", error);
    }
    return kind != OPERAND_FNUMBER || merit_needs_aperture(place, error) ? 1 : 0;
}

bool merit_fill_first(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    const struct merit_figures *figures = merit_figures(merit, slot, slot->operand->wavelength);
    for (size_t j = 0; j < merit_columns(merit) && figures != NULL; j++) {
        merit->change[j] = merit_paraxial_member(&figures[j], slot);
    }
    return figures != NULL && merit_put(merit, slot, 0, residuals, jacobian);
}

/* -------- what is measured to the image plane -------- */

size_t merit_prepare_plane(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    (void)arena;
    return merit_image_check(&merit->places[slot->place], error) ? 1 : 0;
}

/* From the last vertex to the image plane, by one column. */
static struct dual paraxial_plane_of(struct merit *merit, const struct merit_place *place,
                                     size_t column)
{
    struct merit_light *primary = &place->lights[0];
    if (place->lens->focus != FOCUS_TABLE) {
        return primary->figures[column].first.image;
    }
    paraxial_change(merit, primary, column);
    return primary->paraxial.surfaces[place->lens->surface_count - 1].thickness;
}

bool merit_fill_plane(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    const bool is_track = slot->operand->kind == OPERAND_TRACK;
    const struct merit_figures *figures = merit_figures(merit, slot, slot->operand->wavelength);
    for (size_t j = 0; j < merit_columns(merit) && figures != NULL; j++) {
        const struct dual_first *first = &figures[j].first;
        const struct dual plane = paraxial_plane_of(merit, &merit->places[slot->place], j);
        merit->change[j] =
            is_track ? dual_add(first->length, plane) : dual_subtract(first->image, plane);
    }
    return figures != NULL && merit_put(merit, slot, 0, residuals, jacobian);
}

/* -------- power of a group -------- */

bool merit_fill_group(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    struct merit_light *light = merit_light(merit, slot, slot->operand->wavelength);
    size_t first, end;
    if (paraxial_figures_of(merit, slot, light) == NULL) {
        return false;
    }
    merit_surfaces(slot->operand, merit->places[slot->place].lens, &first, &end);
    for (size_t j = 0; j < merit_columns(merit); j++) {
        paraxial_change(merit, light, j);
        merit->change[j] = paraxial_dual_group(&light->paraxial, first, end);
    }
    return merit_put(merit, slot, 0, residuals, jacobian);
}

/* -------- axial colour -------- */

void merit_colours(const struct merit_place *place, const struct operand *operand,
                   double colours[2])
{
    const struct setup *setup = &place->setup;
    colours[0] = operand->wavelength;
    colours[1] = place->lights[0].wavelength;
    for (size_t i = 0; i < setup->wavelength_count && isnan(operand->wavelength); i++) {
        const double wavelength = setup->wavelengths[i].wavelength;
        colours[0] = fmin(colours[0], wavelength);
        colours[1] = i == 0 ? wavelength : fmax(colours[1], wavelength);
    }
}

size_t merit_prepare_axial(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                           struct error *error)
{
    double colours[2];
    (void)arena;
    merit_colours(&merit->places[slot->place], slot->operand, colours);
    return one_unless(colours[0] == colours[1], "there is only one wavelength, and so no colour",
                      error);
}

bool merit_fill_axial(struct merit *merit, const struct merit_slot *slot, double *residuals,
                      double *jacobian)
{
    double colours[2];
    merit_colours(&merit->places[slot->place], slot->operand, colours);
    for (int k = 0; k < 2; k++) {
        const struct merit_figures *figures = merit_figures(merit, slot, colours[k]);
        for (size_t j = 0; j < merit_columns(merit) && figures != NULL; j++) {
            const struct dual here = merit_paraxial_member(&figures[j], slot);
            merit->change[j] = k == 0 ? here : dual_subtract(merit->change[j], here);
        }
        if (figures == NULL) {
            return false;
        }
    }
    return merit_put(merit, slot, 0, residuals, jacobian);
}

/* -------- Seidel sums -------- */

size_t merit_prepare_seidel(struct merit *merit, struct merit_slot *slot, struct arena *arena,
                            struct error *error)
{
    const struct merit_place *place = &merit->places[slot->place];
    const struct setup *setup = &place->setup;
    const bool of_field = slot->operand->kind != OPERAND_S1;
    const bool has_field = slot->operand->field != NULL || setup->edge.kind != FIELD_NONE;
    (void)arena;
    if (!merit_needs_aperture(place, error)) {
        return 0;
    }
    if (setup->lens->stop == LENS_NONE && !setup->first.is_telecentric) {
        return one_unless(true, "the lens has no stop: it has no chief rays", error);
    }
    const struct lens *lens = setup->lens;
    bool is_cone = false;
    for (size_t i = 0; i < lens->surface_count; i++) {
        for (int order = 1; order <= 3; order += 2) {
            is_cone = is_cone || (surface_has(&lens->surfaces[i], SURFACE_HAS_CURVE) &&
                                  lens->surfaces[i].coefficient[surface_term(order)].value.hi != 0);
        }
    }
    if (is_cone) {
        return one_unless(true,
                          "A1 or A3 of a surface makes an aberration of lower order than the "
                          "Seidel sums have",
                          error);
    }
    return one_unless(of_field && !has_field, "the lens states no field: say which, as in S3@10deg",
                      error);
}

bool merit_fill_seidel(struct merit *merit, const struct merit_slot *slot, double *residuals,
                       double *jacobian)
{
    const size_t which = (size_t)(slot->operand->kind - OPERAND_S1);
    struct merit_light *light = merit_light(merit, slot, slot->operand->wavelength);
    if (paraxial_figures_of(merit, slot, light) == NULL) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        struct merit_figures *figures = &light->figures[j];
        if (light->summed != merit->evaluation) {
            paraxial_change(merit, light, j);
            paraxial_dual_seidel(&light->paraxial, &figures->first, figures->sums);
        }
        merit->change[j] = figures->sums[which];
    }
    light->summed = merit->evaluation;
    return merit_put(merit, slot, 0, residuals, jacobian);
}

/* -------- how far out light comes -------- */

bool merit_reach_paraxial(struct merit *merit, const struct merit_slot *slot)
{
    struct merit_place *place = &merit->places[slot->place];
    struct merit_light *light = merit_light(merit, slot, NAN);
    if (paraxial_figures_of(merit, slot, light) == NULL) {
        return false;
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        paraxial_change(merit, light, j);
        paraxial_dual_reach(&light->paraxial, &light->figures[j].first,
                            place->reach + j * place->lens->surface_count);
    }
    return true;
}

/* -------- the image plane -------- */

bool merit_image_check(const struct merit_place *place, struct error *error)
{
    const struct lens *lens = place->setup.lens;
    if (lens->focus == FOCUS_TABLE && !lens->surfaces[lens->surface_count - 1].has_thickness) {
        return fail(error, ERROR_DOMAIN, "the lens states no distance of its image plane");
    }
    if (lens->focus == FOCUS_BEST) {
        fail(error, ERROR_DOMAIN, "the image plane of 'focus best' is another in every lens");
        return error_hint(error, "'focus table' lets the last thickness vary, 'focus paraxial' "
                                 "follows the lens");
    }
    return lens->focus != FOCUS_AFOCAL ||
           fail(error, ERROR_DOMAIN, "the image of an afocal lens is infinitely far away");
}
