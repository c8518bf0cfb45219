/* camera/lens_film.c - systems towards the scene, regions of pupils, sequences. */
/* SPDX-License-Identifier: MIT */
#include "camera/lens_film.h"

#include <math.h>

/* The same systems behind blades: their pupils lie within those of the round stop. */
static bool put_blades(const struct film_question *question, struct arena *arena,
                       struct lens_film *film, struct error *error)
{
    const struct setup *setup = question->setup;
    struct lens *bladed = ARENA_NEW(arena, struct lens);
    if (!blades_stop(setup->lens, &question->blades, setup->first.stop_radius, arena, bladed,
                     error)) {
        return false;
    }
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        struct system *system = ARENA_NEW(arena, struct system);
        if (!setup_compile(setup, bladed, w, SETUP_CLIPPED | SETUP_REVERSED, system, error)) {
            return false;
        }
        film->systems[w] = system;
    }
    return true;
}

bool lens_film_open(const struct film_question *question, struct arena *arena,
                    struct lens_film *film, struct error *error)
{
    const struct setup *setup = question->setup;
    film->systems = ARENA_ARRAY(arena, setup->wavelength_count, const struct system *);
    film->corner = hypot(question->width, question->height) / 2;
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
    if (film->region.largest == 0) {
        return fail(error, ERROR_DOMAIN, "no light reaches the film at %.6g mm", setup->image);
    }
    return question->blades.count == 0 || put_blades(question, arena, film, error);
}
