/* camera/film/lens_film.c - systems towards the scene, regions of pupils, sequences. */
/* SPDX-License-Identifier: MIT */
#include "camera/film/lens_film.h"

#include "trace/aim/sample.h"

#include <math.h>
#include <string.h>

static void start_in_disc(const struct lens_film *film, struct film_samples *samples,
                          struct ray_block *block)
{
    disc_start(&film->disc, samples, SET_BEST, block);
}

static void start_in_region(const struct lens_film *film, struct film_samples *samples,
                            struct ray_block *block)
{
    film_rays_start(&film->region, samples, SET_BEST, block);
}

/* As kernel_film, of one rectangle for all points. */
static void start_anywhere(const struct lens_film *film, struct film_samples *samples,
                           struct ray_block *block)
{
    const double n = film->region.index, back = film->region.film > 0 ? -n : n;
    const double width = film->high[0] - film->low[0], height = film->high[1] - film->low[1];
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double x = samples->x[i], y = samples->y[i], h = hypot(x, y);
        const double up_x = h > 0 ? x / h : 0, up_y = h > 0 ? y / h : 1;
        const double right = film->low[0] + width * samples->u[i];
        const double up = film->low[1] + height * samples->v[i];
        const double left = 1 - right * right - up * up;
        block->x[i] = x;
        block->y[i] = y;
        block->z[i] = film->region.film;
        block->p[i] = n * (right * up_y + up * up_x);
        block->q[i] = n * (up * up_y - right * up_x);
        block->r[i] = back * sqrt(fmax(left, 0));
        block->path[i] = block->lost[i] = 0;
        samples->weight[i] = left > 0 ? width * height : 0;
    }
}

/* The rectangle that holds the regions of all distances from the axis. */
static void find_rectangle(struct lens_film *film)
{
    enum { RADII = 256 };
    struct film_samples samples;
    struct ray_block block;
    for (int k = 0; k < 2; k++) {
        film->low[k] = INFINITY;
        film->high[k] = -INFINITY;
    }
    for (int radius = 0; radius <= RADII; radius++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            samples.x[i] = 0;
            samples.y[i] = film->region.largest * radius / RADII;
            samples.u[i] = (double)i / RAYS_BLOCK;
            samples.v[i] = 1;
        }
        film->aim(film, &samples, &block);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const double way[2] = {block.p[i] / film->region.index,
                                   block.q[i] / film->region.index};
            for (int k = 0; k < 2; k++) {
                film->low[k] = fmin(film->low[k], way[k]);
                film->high[k] = fmax(film->high[k], way[k]);
            }
        }
    }
}

struct ray_model *lens_film_models(const struct film_question *question, unsigned way,
                                   struct arena *arena, struct error *error)
{
    const struct setup *setup = question->setup;
    const unsigned which =
        SETUP_CLIPPED | way | (question->model == MODEL_PARAXIAL ? (unsigned)SETUP_PARAXIAL : 0);
    const bool has_blades = question->blades.count > 0;
    struct lens *bladed = ARENA_NEW(arena, struct lens);
    if (has_blades && !blades_stop(setup->lens, &question->blades, setup_stop_radius(setup), arena,
                                   bladed, error)) {
        return NULL;
    }
    struct ray_model *models = ARENA_ARRAY(arena, setup->wavelength_count, struct ray_model);
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        struct system *system = has_blades ? ARENA_NEW(arena, struct system) : NULL;
        if (has_blades && !setup_compile(setup, bladed, w, which, system, error)) {
            return NULL;
        }
        models[w] = ray_model_of_system(has_blades ? system : setup_system(setup, w, which, error));
        if (models[w].system == NULL) {
            return NULL;
        }
    }
    return models;
}

/* Does nothing but a stop limit the rays, with the same picture at all wavelengths? */
static bool is_disc(const struct film_question *question, const struct lens_film *film)
{
    const struct setup *setup = question->setup;
    const struct lens *lens = setup->lens;
    bool is = lens_model_replaces(question->model) && isfinite(setup->first.exit_pupil);
    if (question->model == MODEL_PINHOLE) {
        return true; /* straight on, whatever the media */
    }
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        is = is && (i == lens->stop || !surface->has_diameter) && surface->aperture_count == 0;
    }
    for (size_t w = 1; w < setup->wavelength_count; w++) {
        const struct system *one = film->models[w].system, *first = film->models[0].system;
        is = is && !(fabs(one->index_first / one->index_last -
                          first->index_first / first->index_last) > 0);
    }
    return is;
}

/* What the edges of all surfaces leave. */
static bool open_region(const struct film_question *question, struct arena *arena,
                        struct lens_film *film, struct error *error)
{
    const struct setup *setup = question->setup;
    const struct system **systems =
        ARENA_ARRAY(arena, setup->wavelength_count, const struct system *);
    for (size_t w = 0; w < setup->wavelength_count; w++) {
        systems[w] = film->models[w].system;
    }
    const struct film_lens lens = {.systems = systems,
                                   .count = setup->wavelength_count,
                                   .first = &setup->first,
                                   .film = setup->image,
                                   .reach = film->corner};
    film->start = start_in_region;
    return exit_pupil_bounds_open(&lens, arena, &film->region, error);
}

/* How far from the axis light arrives on the way to each of the corners: the least. */
static double lit_of(const struct lens_film *film, double x, double y)
{
    const struct exit_pupil_bounds *region = &film->region;
    double least = fmin(region->largest, film->corner);
    for (int i = 0; i < 4 && region->is_grid; i++) {
        const double right = (i % 2 == 0 ? x : -x) - region->pole[0];
        const double up = (i < 2 ? y : -y) - region->pole[1];
        const double by =
            fmin(1, exit_pupil_bounds_end(region, right, up) / hypot(right, up) + 1e-9);
        least = fmin(least, hypot(region->pole[0] + by * right, region->pole[1] + by * up));
    }
    return least;
}

bool lens_film_open(const struct film_question *question, struct arena *arena,
                    struct lens_film *film, struct error *error)
{
    const struct setup *setup = question->setup;
    film->corner = hypot(question->width, question->height) / 2;
    film->acceptance = question->acceptance;
    film->shutter = question->shutter;
    if (question->model == MODEL_PINHOLE && question->blades.count > 0) {
        return fail(error, ERROR_DOMAIN, "a pinhole has no shape: blades do nothing to it");
    }
    const struct shutter *shutter = question->shutter;
    const double room = fabs(question->setup->image);
    if (shutter != NULL && shutter->kind == SHUTTER_LEAF && question->model == MODEL_PINHOLE) {
        return fail(error, ERROR_DOMAIN,
                    "a pinhole has no width that a leaf shutter could open little by little");
    }
    if (shutter != NULL && shutter->distance >= room) {
        return fail(error, ERROR_DOMAIN,
                    "the curtains, %.6g mm before the film, stand in the lens: its last vertex is "
                    "%.6g mm before it",
                    shutter->distance, room);
    }
    if (isnan(setup->image)) {
        fail(error, ERROR_DOMAIN, "the image of the lens lies at infinity: there is no film");
        return error_hint(error, "say with {focus} how far behind the last vertex it is");
    }
    if (setup->lens->stop == LENS_NONE) {
        fail(error, ERROR_DOMAIN, "the lens has no stop: how much light comes is not known");
        return lens_hint_stop(error);
    }
    if (!(setup->first.stop_radius > 0)) {
        fail(error, ERROR_DOMAIN, "the stop has no diameter: how much light comes is not known");
        return error_hint(error, "give an f-number, or a diameter in the file");
    }
    film->models = lens_film_models(question, SETUP_REVERSED, arena, error);
    if (film->models == NULL) {
        return false;
    }
    if (is_disc(question, film)) {
        /*
         * the pupil as a disc, and a region of no more than how far it is seen: all over the film
         */
        const double radius = fabs(setup->first.exit_diameter) / 2;
        const double index = film->models[0].system->index_first;
        film->start = start_in_disc;
        film->region = (struct exit_pupil_bounds){
            .film = setup->image, .index = index, .largest = film->corner};
        film->disc.film = setup->image;
        film->disc.place = setup->first.exit_pupil;
        film->disc.index = index;
        if (question->model == MODEL_PINHOLE) {
            disc_open_pinhole(radius, &film->disc);
        } else {
            disc_open(radius, &film->disc);
        }
    } else if (!open_region(question, arena, film, error)) {
        return false;
    }
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        sobol_open(k, &film->sobol[k]);
    }
    if (film->region.largest == 0) {
        return fail(error, ERROR_DOMAIN, "no light reaches the film at %.6g mm", setup->image);
    }
    film->lit = lit_of(film, question->width / 2, question->height / 2);
    film->aim = film->start;
    if (question->is_anywhere) {
        if (!lens_is_round(film->models[0].system->lens)) {
            return fail(error, ERROR_DOMAIN,
                        "{no skip} pupil: the lens is not the same all around its axis");
        }
        find_rectangle(film);
        film->start = start_anywhere;
    }
    return true;
}

void lens_film_start(const struct lens_film *film, struct film_samples *samples,
                     struct ray_block *block)
{
    film->start(film, samples, block);
    acceptance_weigh(film->acceptance, block, samples);
}

/* -------- shutters -------- */

void lens_film_trace(const struct lens_film *film, size_t wavelength, struct film_samples *samples,
                     const struct rays *rays)
{
    const struct system *system = film->models[wavelength].system;
    if (film->shutter == NULL) {
        ray_model_trace(&film->models[wavelength], rays, NULL);
    } else {
        /* from when to when rays pass, which are traced meanwhile */
        const struct shutter *shutter = film->shutter;
        const struct ray_block *block = rays->blocks;
        const size_t behind =
            shutter->kind == SHUTTER_LEAF ? system_place(system, system->stop) + 1 : 0;
        const double to_full = shutter->stopped / system->stop_radius;
        struct shutter_ray told[RAYS_BLOCK];
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            /* a ray along the film brings no light: its slope must be a number */
            const double towards = fmax(fabs(block->r[i]), 1e-30);
            told[i] = (struct shutter_ray){.film = {samples->x[i], samples->y[i]},
                                           .slope = {block->p[i] / towards, block->q[i] / towards}};
        }
        rays_trace_part(system, 0, behind, rays, NULL);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            double interval[2], at[3] = {block->x[i], block->y[i], block->z[i]};
            if (behind > 0) {
                system_to_own(system, system->stop, at);
                told[i].stop = sqrt(at[0] * at[0] + at[1] * at[1]) * to_full;
            }
            shutter_interval(shutter, &told[i], interval);
            samples->begin[i] = interval[0];
            samples->end[i] = interval[1];
            samples->weight[i] *= (interval[1] - interval[0]) / shutter->time;
        }
        rays_trace_part(system, behind, system->places, rays, NULL);
    }
}

/* Lines from the middle of a point's pupil to the rim of its region, so many in a block of rays. */
enum { LINES = 32, ALONG = RAYS_BLOCK / LINES, TURNS = FILM_SECTORS / LINES };

/* Trace ALONG rays on each of LINES of a turn, one of FILM_SECTORS a sector, at `v`. */
static void trace_lines(const struct lens_film *film, const double at[2], size_t wavelength,
                        int turn, const double *v, struct film_samples *samples,
                        const struct rays *rays)
{
    for (int i = 0; i < RAYS_BLOCK; i++) {
        samples->x[i] = at[0];
        samples->y[i] = at[1];
        /* Gauss's two points of a sector, one in each of two: rims are polygons, where light ends
           is round */
        const double beside = turn % 2 == 0 ? 0.5 - sqrt(1 / 12.0) : 0.5 + sqrt(1 / 12.0);
        samples->u[i] = (TURNS * (i / ALONG) + turn + beside) / FILM_SECTORS;
        samples->v[i] = v[i];
    }
    lens_film_start(film, samples, rays->blocks);
    lens_film_trace(film, wavelength, samples, rays);
}

/* Find where light ends on each line; false: it comes again behind that. */
static bool find_ends(const struct lens_film *film, const double at[2], size_t wavelength, int turn,
                      double *ends, struct film_samples *samples, const struct rays *rays)
{
    enum { LOOKS = 4 };
    static const double first[ALONG] = {0, 0.9, 0.97, 1}; /* a region's rim is near the pupil's */
    const struct ray_block *block = rays->blocks;
    double low[LINES] = {0}, high[LINES], v[RAYS_BLOCK];
    for (int look = 0; look < LOOKS; look++) {
        for (int i = 0; i < RAYS_BLOCK; i++) {
            const int line = i / ALONG, k = i % ALONG;
            v[i] =
                look == 0 ? first[k] : low[line] + (high[line] - low[line]) * (k + 1) / (ALONG + 1);
        }
        trace_lines(film, at, wavelength, turn, v, samples, rays);
        for (int line = 0; line < LINES; line++) {
            int k = line * ALONG, end = k + ALONG;
            high[line] = look == 0 ? 1 : high[line];
            for (; k < end && block->lost[k] == 0; k++) {
                low[line] = v[k];
            }
            high[line] = k < end ? v[k] : high[line];
            for (; k < end; k++) {
                if (block->lost[k] == 0) {
                    return false;
                }
            }
        }
    }
    for (int line = 0; line < LINES; line++) {
        ends[line] = (low[line] + high[line]) / 2;
    }
    return true;
}

/*
 * By Gauss's points up to where light ends on each of many lines, which many times as many rays
 * only come near to. NAN of a pupil that is not in one piece about its middle.
 */
static double light_to_ends(const struct lens_film *film, const double at[2], size_t wavelength,
                            struct film_samples *samples, const struct rays *rays)
{
    double x[ALONG], w[ALONG], ends[LINES], v[RAYS_BLOCK], sum = 0;
    gauss_rule(ALONG, x, w);
    for (int turn = 0; turn < TURNS; turn++) {
        if (!find_ends(film, at, wavelength, turn, ends, samples, rays)) {
            return NAN;
        }
        for (int i = 0; i < RAYS_BLOCK; i++) {
            v[i] = ends[i / ALONG] * x[i % ALONG];
        }
        trace_lines(film, at, wavelength, turn, v, samples, rays);
        for (int i = 0; i < RAYS_BLOCK; i++) {
            const double share = ends[i / ALONG] * w[i % ALONG];
            sum += rays->blocks->lost[i] == 0 ? share * samples->weight[i] : (double)NAN;
        }
    }
    return sum / FILM_SECTORS;
}

/* The same by scattered rays, whatever the pupil is. */
static double light_of_scattered(const struct lens_film *film, const double at[2],
                                 size_t wavelength, size_t blocks, struct film_samples *samples,
                                 const struct rays *rays)
{
    const struct film_plan plan = {
        .sobol = film->sobol, .scrambling = {1, 2, 3, 4}, .left = at[0], .bottom = at[1]};
    double sum = 0;
    for (uint32_t block = 0; block < blocks; block++) {
        film_rays_plan(&plan, NULL, block, SET_BEST, samples);
        lens_film_start(film, samples, rays->blocks);
        lens_film_trace(film, wavelength, samples, rays);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            sum += rays->blocks->lost[i] == 0 ? samples->weight[i] : 0;
        }
    }
    return sum / (double)(blocks * RAYS_BLOCK);
}

double lens_film_light(const struct lens_film *film, const double at[2], size_t wavelength,
                       size_t blocks, struct film_samples *samples, const struct rays *rays)
{
    const bool is_plain = film->shutter == NULL && !film->region.has_hole;
    const double light =
        is_plain ? light_to_ends(film, at, wavelength, samples, rays) : (double)NAN;
    return isfinite(light) ? light
                           : light_of_scattered(film, at, wavelength, blocks, samples, rays);
}

double lens_film_open_share(const struct lens_film *film, size_t wavelengths, struct arena *arena)
{
    enum { BLOCKS = 16384 / RAYS_BLOCK };
    const double *at = film->region.pole;
    struct film_samples samples;
    const struct rays rays = rays_new(arena, RAYS_BLOCK);
    struct lens_film open = *film;
    double share = 0;
    open.shutter = NULL;
    for (size_t w = 0; w < wavelengths; w++) {
        /* the same rays with and without the shutter */
        share += light_of_scattered(film, at, w, BLOCKS, &samples, &rays) /
                 light_of_scattered(&open, at, w, BLOCKS, &samples, &rays);
    }
    return share / (double)wavelengths;
}

void lens_film_chief(const struct lens_film *film, const double at[2], struct film_samples *samples,
                     struct rays *rays)
{
    const double share = fmin(1, 0.999 * film->region.largest / hypot(at[0], at[1]));
    memset(samples, 0, sizeof *samples);
    samples->x[0] = share * at[0];
    samples->y[0] = share * at[1];
    samples->v[0] = film->region.has_hole ? 0.5 : 0; /* not at the edge of a hole */
    film->aim(film, samples, rays->blocks);
    ray_model_trace(&film->models[0], rays, NULL);
}

double lens_film_angle(const struct lens_film *film, const double step[2],
                       struct film_samples *samples, struct rays *rays)
{
    /* both on one side of the middle, where what is clear may be a ring */
    static const double shares[2] = {1e-6, 1};
    const struct ray_block *block = rays->blocks;
    double way[2][3];
    bool arrive = true;
    for (int i = 0; i < 2; i++) {
        const double at[2] = {shares[i] * step[0], shares[i] * step[1]};
        lens_film_chief(film, at, samples, rays);
        way[i][0] = block->p[0];
        way[i][1] = block->q[0];
        way[i][2] = block->r[0];
        arrive = arrive && block->lost[0] == 0;
    }
    const double chord =
        hypot(hypot(way[1][0] - way[0][0], way[1][1] - way[0][1]), way[1][2] - way[0][2]);
    return arrive ? 2 * asin(fmin(1, chord / 2)) : NAN;
}

void lens_film_span(const struct lens_film *film, double span[2])
{
    enum { STEPS = 16 };
    const struct shutter *shutter = film->shutter;
    const double *along = shutter->along, step = shutter->extent / STEPS;
    const double across = 2 * film->corner / STEPS;
    struct film_samples samples;
    struct ray_block block;
    double reach = 0;
    for (int point = 0; point < (STEPS + 1) * (STEPS + 1); point++) {
        const double q = step * (point % (STEPS + 1) - STEPS / 2);
        const double beside = across * (point / (STEPS + 1) - STEPS / 2);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            samples.x[i] = along[0] * q - along[1] * beside;
            samples.y[i] = along[1] * q + along[0] * beside;
            samples.u[i] = (double)i / RAYS_BLOCK;
            samples.v[i] = 1;
        }
        film->aim(film, &samples, &block);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const double way = along[0] * block.p[i] + along[1] * block.q[i];
            const double passed = q + shutter->distance * way / fabs(block.r[i]);
            reach = samples.weight[i] > 0 ? fmax(reach, fabs(passed)) : reach;
        }
    }
    shutter_span(shutter, reach + step, span);
}
