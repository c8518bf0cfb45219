/* analysis/real/real_light.c - how much light a lens brings to the middle of its film. */
/* SPDX-License-Identifier: MIT */
#include "analysis/real/real_light.h"

#include "analysis/rays/fresnel.h"
#include "analysis/rays/relative_illumination.h"
#include "base/constants.h"

#include <math.h>

/* Relative, of the integrals. */
static const double wanted = 1e-10;

/* The same integral with what faces take. */
static double through_faces(const struct relative_illumination *falloff, struct arena *arena)
{
    const struct beam film =
        beam_to_pupil((double[3]){0, 0, falloff->setup.image}, falloff->first.exit_pupil,
                      falloff->film_open->index_first);
    const struct illumination_question question = {.clipped = falloff->film,
                                                   .open = falloff->film_open,
                                                   .beam = &film,
                                                   .first = &falloff->first,
                                                   .error = wanted,
                                                   .pass = fresnel_pass};
    return illumination_of_film(&question, arena).value;
}

bool real_light_find(const struct real_light_question *question, struct arena *arena,
                     struct real_light *light, struct error *error)
{
    struct setup_question asked = question->lens;
    const struct plane_value film = {PLANE_AT, question->film};
    struct setup setup;
    double weights = 0, sum = 0, passed = 0;
    asked.object = &question->object;
    if (!setup_open(&asked, arena, &setup, error) || !setup_place_image(&setup, &film, error)) {
        return false;
    }
    for (size_t g = 0; g < setup.wavelength_count; g++) {
        const struct relative_illumination_question one = {.setup = &setup,
                                                           .wavelength = g,
                                                           .stop_diameter = NAN,
                                                           .error = wanted,
                                                           .clip = true,
                                                           .no_field = true,
                                                           .no_vignetting = true};
        const double weight = setup.wavelengths[g].weight;
        struct relative_illumination falloff;
        if (!relative_illumination_open(&one, &falloff, error)) {
            return false;
        }
        weights += weight;
        sum += weight * falloff.axis.value;
        passed +=
            weight * (question->uncoated ? through_faces(&falloff, arena) : falloff.axis.value);
    }
    if (!(sum > 0)) {
        return fail(error, ERROR_DOMAIN, "no light reaches the middle of the film");
    }
    *light = (struct real_light){sum / weights, passed / sum, sqrt(PI * weights / (4 * passed))};
    return true;
}
