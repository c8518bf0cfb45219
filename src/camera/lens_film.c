/* camera/lens_film.c - systems towards the scene, regions of pupils, sequences. */
/* SPDX-License-Identifier: MIT */
#include "camera/lens_film.h"

#include "base/constants.h"

#include <math.h>

/* All through the middle of the hole, whatever u and v. */
static void start_pinhole(const struct lens_film *film, struct film_samples *samples,
                          struct ray_block *block)
{
    const double z = film->hole - film->region.film, n = film->region.index;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double x = samples->x[i], y = samples->y[i], p2 = x * x + y * y + z * z;
        const double over = n / sqrt(p2);
        block->x[i] = x;
        block->y[i] = y;
        block->z[i] = film->region.film;
        block->p[i] = -x * over;
        block->q[i] = -y * over;
        block->r[i] = z * over;
        block->path[i] = block->lost[i] = 0;
        samples->weight[i] = film->hole_area * (z * z) / (p2 * p2);
    }
}

static void start_in_region(const struct lens_film *film, struct film_samples *samples,
                            struct ray_block *block)
{
    film_rays_start(&film->region, samples, SET_BEST, block);
}

/* Systems towards the scene, at all wavelengths: with blades in the stop, if there are any. */
static bool open_systems(const struct film_question *question, struct arena *arena,
                         struct lens_film *film, struct error *error)
{
    const struct setup *setup = question->setup;
    const unsigned which =
        SETUP_CLIPPED | SETUP_REVERSED | (question->model == MODEL_PARAXIAL ? SETUP_PARAXIAL : 0);
    const bool has_blades = question->blades.count > 0;
    struct lens *bladed = ARENA_NEW(arena, struct lens);
    if (has_blades && !blades_stop(setup->lens, &question->blades, setup->first.stop_radius, arena,
                                   bladed, error)) {
        return false;
    }
    film->systems = ARENA_ARRAY(arena, setup->wavelength_count, const struct system *);
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        struct system *system = has_blades ? ARENA_NEW(arena, struct system) : NULL;
        if (has_blades && !setup_compile(setup, bladed, w, which, system, error)) {
            return false;
        }
        film->systems[w] = has_blades ? system : setup_system(setup, w, which, error);
        if (film->systems[w] == NULL) {
            return false;
        }
    }
    return true;
}

bool lens_film_open(const struct film_question *question, struct arena *arena,
                    struct lens_film *film, struct error *error)
{
    const struct setup *setup = question->setup;
    film->corner = hypot(question->width, question->height) / 2;
    film->acceptance = question->acceptance;
    if (question->model == MODEL_PINHOLE && question->blades.count > 0) {
        return fail(error, ERROR_DOMAIN, "a pinhole has no shape: blades do nothing to it");
    }
    if (isnan(setup->image)) {
        fail(error, ERROR_DOMAIN, "the image of the lens lies at infinity: there is no film");
        return error_hint(error, "say with {focus} how far behind the last vertex it is");
    }
    if (setup->lens->stop == LENS_NONE || !(setup->first.stop_radius > 0)) {
        fail(error, ERROR_DOMAIN, "%s: how much light comes is not known",
             setup->lens->stop == LENS_NONE ? "the lens has no stop" : "the stop has no diameter");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    if (!open_systems(question, arena, film, error)) {
        return false;
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
    film->start = start_in_region;
    if (question->model == MODEL_PINHOLE) {
        film->start = start_pinhole;
        film->hole = setup->first.exit_pupil;
        film->hole_area = PI / 4 * setup->first.exit_diameter * setup->first.exit_diameter;
    }
    return true;
}

void lens_film_start(const struct lens_film *film, struct film_samples *samples,
                     struct ray_block *block)
{
    film->start(film, samples, block);
    acceptance_weigh(film->acceptance, block, samples);
}
