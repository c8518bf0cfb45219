/* camera/tile_rays.c - blocks of rays of a tile: traced, timed, looked along and added up. */
/* SPDX-License-Identifier: MIT */
#include "camera/tile_rays.h"

#include <math.h>
#include <string.h>

_Static_assert(TILE_PIXELS == (int)RAYS_BLOCK, "a block of points for a tile");

/* -------- made ready -------- */

/* Do all wavelengths go the same way? */
static bool is_alike(const struct lens_film *film, size_t wavelengths)
{
    const size_t media = film->systems[0]->lens->surface_count + 1;
    bool alike = true;
    for (size_t w = 1; w < wavelengths; w++) {
        for (size_t i = 0; i < media; i++) {
            alike = alike && film->systems[w]->n[i].hi == film->systems[0]->n[i].hi;
        }
    }
    return alike;
}

/* What the wavelengths of the question are for. */
static const struct spare_pass *passes_of(const struct photograph_question *question, size_t passes,
                                          struct arena *arena)
{
    const struct setup *setup = question->film.setup;
    const size_t parts = question->is_coloured && passes > 1 ? TILE_CHANNELS : 1;
    const size_t waves = passes / parts, channels = TILE_CHANNELS / parts;
    struct spare_pass *pass = ARENA_ARRAY(arena, passes, struct spare_pass);
    for (size_t i = 0; i < passes; i++) {
        double all = 0;
        for (size_t k = 0; k < waves; k++) {
            all += setup->wavelengths[i / waves * waves + k].weight;
        }
        pass[i] = (struct spare_pass){.begin = i / waves * channels,
                                      .end = (i / waves + 1) * channels,
                                      .share = setup->wavelengths[i].weight / all};
    }
    return pass;
}

bool tile_rays_in_bands(const struct tile_rays *tile)
{
    const struct view *view = tile->subject.view;
    return view != NULL && !isnan(view->bands->wavelength[0]);
}

void tile_rays_open(const struct photograph_question *question, const struct lens_film *film,
                    struct arena *arena, struct tile_rays *tile)
{
    const size_t wavelengths = question->film.setup->wavelength_count;
    const bool as_one = wavelengths == 1 ||
                        ((question->kept & 1U << SKIP_COLOUR) == 0 && is_alike(film, wavelengths));
    *tile = (struct tile_rays){.film = film,
                               .passes = as_one ? 1 : wavelengths,
                               .duration = question->duration,
                               .seed = question->seed};
    tile->pass = passes_of(question, tile->passes, arena);
    sobol_open(FILM_DIMENSIONS, &tile->when);
}

struct tile_room *tile_room_new(struct arena *arena)
{
    struct tile_room *room = ARENA_NEW(arena, struct tile_room);
    room->rays = rays_new(arena, RAYS_BLOCK);
    return room;
}

/* -------- rays -------- */

/* How a block of rays goes: at which wavelength of the lens, in which bands, for whom. */
struct way {
    size_t wavelength;
    struct lanes lanes;
    struct spare_pass pass;
};

void tile_rays_trace(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                     size_t wavelength, struct tile_room *room)
{
    film_rays_plan(plan, block, SET_BEST, &room->samples);
    lens_film_start(tile->film, &room->samples, room->rays.blocks);
    lens_film_trace(tile->film, wavelength, &room->samples, &room->rays);
}

/* When the rays of a block come: evenly within the time that each has, the middle of all at 0. */
static void time_rays(const struct tile_rays *tile, uint32_t block, struct tile_room *room)
{
    const double duration = tile->duration;
    if (duration > 0) {
        sobol_points(&tile->when, room->when, block, room->times);
        const double *begin = room->samples.begin, *end = room->samples.end;
        const bool is_shut = tile->film->shutter != NULL;
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            room->times[i] = is_shut ? begin[i] + room->times[i] * (end[i] - begin[i])
                                     : duration * (room->times[i] - 0.5);
        }
    }
}

/* What one ray brings to its pixel. */
static void add_ray(const struct film_plan *plan, const struct spare_pass *pass, size_t i,
                    struct tile_room *room)
{
    const struct film_samples *samples = &room->samples;
    const double across = (samples->x[i] - plan->left) / plan->width * TILE_ACROSS;
    const double down = (samples->y[i] - plan->bottom) / plan->height * TILE_DOWN;
    const size_t column = (size_t)fmin(across, TILE_ACROSS - 1),
                 row = (size_t)fmin(down, TILE_DOWN - 1);
    double *sums = room->sums[row * TILE_ACROSS + (TILE_ACROSS - 1 - column)];
    const double *light = room->light[i];
    const bool is_sent = samples->weight[i] > 0; /* from a lit place, and taken by the pixel */
    room->counts[PHOTOGRAPH_TRACED] += is_sent;
    room->counts[PHOTOGRAPH_PASSED] += is_sent && room->rays.blocks->lost[i] == 0;
    for (size_t channel = pass->begin; channel < pass->end; channel++) {
        sums[channel] += pass->share * samples->weight[i] * light[channel];
    }
}

/* A block of points, of one wavelength of the lens, in the bands of these lanes. */
static void sum_block(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      const struct way *way, struct tile_room *room)
{
    tile_rays_trace(tile, plan, block, way->wavelength, room);
    time_rays(tile, block, room);
    const struct subject_rays rays = {.block = room->rays.blocks,
                                      .weights = room->samples.weight,
                                      .times = room->times,
                                      .lanes = &way->lanes,
                                      .sequence = &room->sequence,
                                      .first = block * RAYS_BLOCK};
    tile->subject.look(&tile->subject, &rays, room->counts, room->light);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        add_ray(plan, &way->pass, i, room);
    }
}

/*
 * The same of many bands: a hero of each block and others as far apart as can be, in one pass
 * where all go the same way through the lens. No density of our rays depends on the band, so that
 * the balance heuristic is the plain mean [Wilkie14].
 */
static void sum_bands(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      struct tile_room *room)
{
    const size_t count = tile->subject.view->bands->count;
    /* blocks are points of a sequence too */
    const size_t hero = (size_t)((double)count * sobol_point(&tile->when, room->hero, block));
    struct way way = {.pass = {0, TILE_CHANNELS, (double)count / BANDS_LANES}};
    for (size_t lane = 0; lane < BANDS_LANES; lane++) {
        const size_t band = (hero + lane * count / BANDS_LANES) % count;
        if (tile->passes > 1) {
            way.wavelength = band;
            way.lanes = (struct lanes){1, {band}};
            sum_block(tile, plan, block, &way, room);
        } else {
            way.lanes.band[way.lanes.count++] = band;
        }
    }
    if (tile->passes == 1) {
        sum_block(tile, plan, block, &way, room);
    }
}

void tile_rays_sum(const struct tile_rays *tile, const struct film_plan *plan, size_t begin,
                   size_t end, struct tile_room *room)
{
    /* the same points for all channels: what is left of noise is grey */
    for (size_t pass = 0; pass < tile->passes && !tile_rays_in_bands(tile); pass++) {
        struct way way = {.wavelength = pass, .pass = tile->pass[pass]};
        for (size_t k = way.pass.begin; k < way.pass.end; k++) {
            way.lanes.band[way.lanes.count++] = k;
        }
        for (uint32_t block = (uint32_t)begin; block < end; block++) {
            sum_block(tile, plan, block, &way, room);
        }
    }
    for (uint32_t block = (uint32_t)begin; block < end && tile_rays_in_bands(tile); block++) {
        sum_bands(tile, plan, block, room);
    }
}

void tile_rays_begin(const struct tile_rays *tile, size_t number, struct film_plan *plan,
                     struct tile_room *room)
{
    const struct view *view = tile->subject.view;
    memset(room->sums, 0, sizeof room->sums);
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        plan->scrambling[k] = sobol_scrambling(tile->seed, number, k);
    }
    room->when = sobol_scrambling(tile->seed, number, FILM_DIMENSIONS);
    room->hero = sobol_scrambling(tile->seed, number, FILM_DIMENSIONS + POINTS_DIMENSIONS + 1);
    if (view != NULL) {
        points_sequence_open(view->points, tile->seed, (uint32_t)number, &room->sequence);
    }
}
