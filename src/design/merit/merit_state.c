/* design/merit/merit_state.c - what an evaluation knows, and how kinds of operands fill it. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_state.h"

#include <assert.h>
#include <math.h>

/* -------- positions -------- */

void merit_begin(struct merit *merit, const struct merit_question *question, struct arena *arena)
{
    *merit = (struct merit){.question = *question,
                            .variable_count =
                                question->variable_count + merit_irregular_columns(question),
                            .limit = ARENA_NEW(arena, struct merit_limit),
                            .arena = arena};
}

static void merit_place_add_light(const struct merit *merit, struct merit_place *place,
                                  double wavelength, struct arena *arena)
{
    for (size_t i = 0; i < place->light_count; i++) {
        if (place->lights[i].wavelength == wavelength) {
            return;
        }
    }
    struct merit_light *light = &place->lights[place->light_count++];
    const struct merit_question *question = &merit->question;
    const size_t columns = merit->variable_count > 0 ? merit->variable_count : 1;
    const size_t links =
        question->by != NULL ? question->by->most : variables_most_links(question->variables);
    *light = (struct merit_light){
        .wavelength = wavelength,
        .links = ARENA_ARRAY(arena, links, struct variable_link),
        .paraxial = paraxial_dual_new(place->setup.lens, place->setup.section, arena),
        .figures = ARENA_ARRAY(arena, columns, struct merit_figures)};
}

/* A lens that begins without power has no f-number as yet: its fields and wavelengths are known. */
static bool merit_place_open_setup(const struct setup_question *question, struct merit_place *place,
                                   struct arena *arena, struct error *error)
{
    struct setup_question bare = *question;
    struct lens *lens = ARENA_NEW(arena, struct lens);
    struct error ignored;
    if (setup_open(question, arena, &place->setup, error)) {
        return true;
    }
    *lens = *question->lens;
    lens->aperture_kind = APERTURE_NONE;
    lens->apertures = NULL;
    bare.lens = lens;
    bare.fnumber = NAN;
    return place->aperture.kind == APERTURE_FNUMBER && place->setup.first.is_afocal &&
           setup_open(&bare, arena, &place->setup, &ignored);
}

static bool open_place(const struct merit *merit, size_t position, struct arena *arena,
                       struct merit_place *place, struct error *error)
{
    const struct merit_question *question = &merit->question;
    const struct setup_question asked = {.lens = question->lens,
                                         .position = position,
                                         .section = question->section,
                                         .wavelength = NAN,
                                         .wavelengths = WAVELENGTHS_ALL,
                                         .spectrum = question->wavelengths,
                                         .spectrum_count = question->wavelength_count,
                                         .fnumber = question->fnumber,
                                         .fields = question->fields,
                                         .field_count = question->field_count,
                                         .field_policy = FIELDS_ALL,
                                         .takes_telecentric = true,
                                         .leaves_stop = true};
    *place = (struct merit_place){.position = position};
    place->lens = lens_at_position(question->lens, position, arena);
    place->aperture = isnan(question->fnumber)
                          ? lens_aperture(place->lens)
                          : (struct aperture_setting){APERTURE_FNUMBER, question->fnumber};
    if (!merit_place_open_setup(&asked, place, arena, error)) {
        return place->setup.position != NULL &&
               error_prefix(error, "position %s: ", place->setup.position);
    }
    /* the primary wavelength, those of the lens or asked for, those of operands */
    size_t most = 1 + place->setup.wavelength_count, count;
    for (size_t i = 0; i < question->operand_count; i++) {
        operand_terms(&question->operands[i], &count);
        most += count;
    }
    place->lights = ARENA_ARRAY(arena, most, struct merit_light);
    merit_place_add_light(merit, place, lens_primary_wavelength(place->setup.lens), arena);
    for (size_t i = 0; i < place->setup.wavelength_count; i++) {
        merit_place_add_light(merit, place, place->setup.wavelengths[i].wavelength, arena);
    }
    for (size_t i = 0; i < question->operand_count; i++) {
        const struct operand *terms = operand_terms(&question->operands[i], &count);
        for (size_t k = 0; k < count; k++) {
            if (!isnan(terms[k].wavelength)) {
                merit_place_add_light(merit, place, terms[k].wavelength, arena);
            }
        }
    }
    return true;
}

/* The focal length that is wanted in a position, mm; NaN: none is. */
static double merit_wanted_focal(const struct merit *merit, size_t position)
{
    const struct merit_question *question = &merit->question;
    for (size_t i = 0; i < question->operand_count; i++) {
        const struct operand *operand = &question->operands[i];
        if (operand->kind == OPERAND_EFL && operand->target != 0 &&
            (operand->position == LENS_NONE || operand->position == position)) {
            return operand->target;
        }
    }
    return lens_stated(question->lens, STATED_EFL, position);
}

bool merit_lacks_power(const struct merit *merit)
{
    bool lacks = false;
    for (size_t i = 0; i < merit->place_count; i++) {
        const struct merit_place *place = &merit->places[i];
        lacks = lacks ||
                (place->setup.first.is_afocal && isnan(merit_wanted_focal(merit, place->position)));
    }
    return lacks;
}

bool merit_aperture_of_wanted(struct merit *merit)
{
    bool changed = false;
    for (size_t i = 0; i < merit->place_count; i++) {
        struct merit_place *place = &merit->places[i];
        const double focal = fabs(merit_wanted_focal(merit, place->position));
        if (place->aperture.kind == APERTURE_FNUMBER && place->setup.first.is_afocal &&
            isfinite(focal)) {
            place->aperture =
                (struct aperture_setting){APERTURE_EPD, focal / place->aperture.value};
            changed = true;
        }
    }
    return changed;
}

bool merit_places_open(struct merit *merit, struct arena *arena, struct error *error)
{
    const struct merit_question *question = &merit->question;
    const size_t all = question->lens->position_count > 0 ? question->lens->position_count : 1;
    merit->place_count = question->position_count > 0 ? question->position_count : all;
    merit->places = ARENA_ARRAY(arena, merit->place_count, struct merit_place);
    for (size_t i = 0; i < merit->place_count; i++) {
        const size_t position = question->position_count > 0 ? question->positions[i] : i;
        if (!open_place(merit, position, arena, &merit->places[i], error)) {
            return false;
        }
    }
    return true;
}

void merit_put_lens(struct merit *merit, const double *parameters, bool derives)
{
    merit->evaluation++;
    merit->limit->is_known = false;
    merit->derives = derives;
    merit->parameters = parameters;
    for (size_t i = 0; i < merit->place_count; i++) {
        struct merit_place *place = &merit->places[i];
        place->lens = variables_put(merit->question.variables, parameters, place->position);
    }
}

void merit_surfaces(const struct operand *operand, const struct lens *lens, size_t *first,
                    size_t *end)
{
    const bool all = operand->first == LENS_NONE;
    *first = all ? 0 : operand->first;
    *end = all ? lens->surface_count : operand->last + 1;
}

size_t merit_columns(const struct merit *merit)
{
    return merit->derives ? merit->variable_count : 1;
}

struct merit_light *merit_light(struct merit *merit, const struct merit_slot *slot,
                                double wavelength)
{
    struct merit_place *place = &merit->places[slot->place];
    struct merit_light *light = place->lights;
    while (!isnan(wavelength) && light->wavelength != wavelength) {
        light++; /* merit_open has listed all of them */
        assert(light < place->lights + place->light_count);
    }
    if (merit->derives && light->linked != merit->evaluation) {
        const struct merit_by *by = merit->question.by;
        light->link_count =
            by != NULL ? by->links(by->context, place->position, light->wavelength, light->links)
                       : variables_links(merit->question.variables, place->position,
                                         light->wavelength, light->links);
        light->linked = merit->evaluation;
    }
    return light;
}

bool merit_put(struct merit *merit, const struct merit_slot *slot, size_t at, double *residuals,
               double *jacobian)
{
    const struct dual *figure = merit->change;
    const struct operand *operand = slot->operand;
    const double off = (figure[0].value - operand->target) / operand->deviation;
    if (!isfinite(off)) {
        return fail(&merit->why, ERROR_DOMAIN, "%s is %s", operand->name,
                    isnan(off) ? "not there" : "infinite");
    }
    merit->values[slot->first + at] = figure[0].value;
    residuals[at] = off;
    for (size_t j = 0; j < merit->variable_count && jacobian != NULL; j++) {
        jacobian[at * merit->variable_count + j] = figure[j].slope / operand->deviation;
    }
    return true;
}

bool merit_put_inverse(struct merit *merit, const struct merit_slot *slot, size_t at,
                       double *residuals, double *jacobian)
{
    const double target = slot->operand->target, inverse = merit->change[0].value;
    for (size_t j = 0; j < merit_columns(merit) && slot->operand->is_term; j++) {
        merit->change[j] = dual_divide(dual_of(1), merit->change[j]);
    }
    if (slot->operand->is_term) {
        return merit_put(merit, slot, at, residuals, jacobian);
    }
    for (size_t j = 0; j < merit_columns(merit); j++) {
        /* T/x, and how it goes on where that is far from T; and its derivative */
        const struct dual x = dual_scale(merit->change[j], target);
        double value = target / x.value, slope = -target / (x.value * x.value);
        if (!(x.value >= 0.5)) {
            slope = -4 * target;
            value = 2 * target + slope * (x.value - 0.5);
        } else if (x.value > 2) {
            slope = -0.25 * target;
            value = 0.5 * target + slope * (x.value - 2);
        }
        merit->change[j] = (struct dual){value, slope * x.slope};
    }
    const bool done = merit_put(merit, slot, at, residuals, jacobian);
    merit->values[slot->first + at] = 1 / inverse;
    return done;
}

bool merit_inverse_check(const struct operand *operand, struct error *error)
{
    return operand->is_term || (fabs(operand->target) > 0 && !isinf(operand->target)) ||
           fail(error, ERROR_DOMAIN, "a finite %s that is not 0 must be its target",
                operand_type(operand->kind)->dimension == &dimension_length ? "length" : "number");
}

bool merit_needs_aperture(const struct merit_place *place, struct error *error)
{
    return place->aperture.kind != APERTURE_NONE ||
           fail(error, ERROR_DOMAIN, "the lens has no aperture: state one, or give {f-number}");
}
