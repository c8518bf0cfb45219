/* design/merit/merit_state.c - what an evaluation knows, and how kinds of operands fill it. */
/* SPDX-License-Identifier: MIT */
#include "design/merit/merit_state.h"

#include <assert.h>
#include <math.h>

size_t merit_columns(const struct merit *merit)
{
    return merit->derives ? merit->variable_count : 1;
}

static struct merit_light *merit_state_find_light(struct merit_place *place, double wavelength)
{
    struct merit_light *light = place->lights;
    while (!isnan(wavelength) && light->wavelength != wavelength) {
        light++; /* merit_open has listed all of them */
        assert(light < place->lights + place->light_count);
    }
    return light;
}

struct merit_light *merit_light(struct merit *merit, const struct merit_slot *slot,
                                double wavelength)
{
    struct merit_place *place = &merit->places[slot->place];
    struct merit_light *light = merit_state_find_light(place, wavelength);
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

bool merit_needs_aperture(const struct merit_place *place, struct error *error)
{
    return place->aperture.kind != APERTURE_NONE ||
           fail(error, ERROR_DOMAIN, "the lens has no aperture: state one, or give {f-number}");
}
