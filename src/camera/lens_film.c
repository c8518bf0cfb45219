/* camera/lens_film.c - systems towards the scene, regions of pupils, sequences. */
/* SPDX-License-Identifier: MIT */
#include "camera/lens_film.h"

#include <math.h>

bool lens_film_open(const struct setup *setup, double width, double height, struct arena *arena,
                    struct lens_film *film, struct error *error)
{
    film->systems = ARENA_ARRAY(arena, setup->wavelength_count, const struct system *);
    film->corner = hypot(width, height) / 2;
    if (isnan(setup->image)) {
        fail(error, ERROR_DOMAIN, "the image of the lens lies at infinity: there is no film");
        return error_hint(error, "say with {focus} how far behind the last vertex it is");
    }
    if (setup->lens->stop == LENS_NONE || !(setup->first.stop_radius > 0)) {
        fail(error, ERROR_DOMAIN, "%s: how much light comes is not known",
             setup->lens->stop == LENS_NONE ? "the lens has no stop" : "the stop has no diameter");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        film->systems[w] = setup_system(setup, w, SETUP_CLIPPED | SETUP_REVERSED, error);
        if (film->systems[w] == NULL) {
            return false;
        }
    }
    const struct film_lens lens = {.systems = film->systems,
                                   .count = setup->wavelength_count,
                                   .first = &setup->first,
                                   .film = setup->image,
                                   .reach = film->corner};
    if (!film_region_open(&lens, arena, &film->region, error)) {
        return false;
    }
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        sobol_open(k, &film->sobol[k]);
    }
    return film->region.largest > 0 ||
           fail(error, ERROR_DOMAIN, "no light reaches the film at %.6g mm", setup->image);
}
