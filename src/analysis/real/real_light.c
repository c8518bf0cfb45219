/* analysis/real/real_light.c - how much light a lens brings to the middle of its film. */
/* SPDX-License-Identifier: MIT */
#include "analysis/real/real_light.h"

#include "analysis/rays/relative_illumination.h"
#include "base/constants.h"
#include "optics/surface.h"
#include "trace/follow.h"

#include <math.h>

/* Does light lose some of itself here by reflection? */
static bool is_face(const struct system *system, size_t place)
{
    const struct lens *lens = system->lens;
    const size_t surface = system_surface(system, place);
    return surface < lens->surface_count && !surface_reflects(&lens->surfaces[surface]) &&
           !surface_has(&lens->surfaces[surface], SURFACE_HAS_FOCAL);
}

/*
 * The share of unpolarised light that all refracting faces let pass along a ray.
 *
 * Given     system  nothing clipped; forward or reversed: the share is the same
 *           start   as given to rays_set
 * Formula   mean of the products of 1 - Rs and of 1 - Rp over the faces,
 *           Rs = ((n cos I - n' cos I')/(n cos I + n' cos I'))^2,
 *           Rp = ((n' cos I - n cos I')/(n' cos I + n cos I'))^2
 * Source    Fresnel's formulas, [BornWolf99] 1.5.2
 * Result    NaN: the ray is lost
 * Limits    both polarisations stay what they are: exact for rays that run in one plane, as those
 *           of a point on the axis of a round lens. Mirrors and ideal thick lenses lose nothing;
 *           what is reflected twice and arrives is not counted; glass absorbs nothing
 */
static double fresnel_pass(const struct system *system, const struct ray *start,
                           struct arena *arena)
{
    const struct arena_mark mark = arena_mark(arena);
    struct ray_intersection *meetings = ARENA_ARRAY(arena, system->places, struct ray_intersection);
    double across = 1, along = 1, before = fabs(system->index_first);
    ray_follow(system, start, arena, meetings);
    for (size_t i = 0; i < system->places; i++) {
        const double behind = fabs(system_index_after(system, i));
        if (is_face(system, i) && behind != before) {
            const double in = cos(meetings[i].angles.incidence);
            const double out = cos(meetings[i].angles.refraction);
            const double rs = (before * in - behind * out) / (before * in + behind * out);
            const double rp = (behind * in - before * out) / (behind * in + before * out);
            across *= 1 - rs * rs;
            along *= 1 - rp * rp;
        }
        before = behind;
    }
    arena_reset(arena, mark);
    return (across + along) / 2;
}

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
