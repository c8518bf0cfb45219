/* camera/photograph/tile_rays.c - blocks of rays of a tile, added up by pixel and channel. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tile_rays.h"

#include "camera/photograph/tile_block.h"
#include "camera/photograph/tile_cell.h"
#include "camera/photograph/tile_colours.h"
#include "camera/photograph/tile_order.h"

#include <assert.h>
#include <string.h>

/* Dimensions of points: film, time, paths, bands of blocks. */
enum {
    TIME_DIMENSION = FILM_DIMENSIONS,
    PATH_DIMENSION = TIME_DIMENSION + 1,
    HERO_DIMENSION = PATH_DIMENSION + SAMPLER_DIMENSIONS
};

/* -------- made ready -------- */

/* Do all wavelengths go the same way? */
static bool tile_rays_is_alike(const struct lens_film *film, size_t wavelengths)
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
static const struct ray_reuse_pass *passes_of(const struct photograph_question *question,
                                              size_t passes, struct arena *arena)
{
    const struct setup *setup = question->film.setup;
    const size_t parts = question->is_coloured && passes > 1 ? TILE_CHANNELS : 1;
    const size_t waves = passes / parts, channels = TILE_CHANNELS / parts;
    struct ray_reuse_pass *pass = ARENA_ARRAY(arena, passes, struct ray_reuse_pass);
    for (size_t i = 0; i < passes; i++) {
        double all = 0;
        for (size_t k = 0; k < waves; k++) {
            all += setup->wavelengths[i / waves * waves + k].weight;
        }
        pass[i] = (struct ray_reuse_pass){.begin = i / waves * channels,
                                          .end = (i / waves + 1) * channels,
                                          .share = setup->wavelengths[i].weight / all};
    }
    return pass;
}

/* The least bits of strands for so many samples. */
static uint32_t tile_rays_bits_of(size_t samples)
{
    uint32_t bits = 0;
    while (bits < 32 - SOBOL_LOW && (size_t)1 << bits < samples) {
        bits++;
    }
    return bits;
}

const struct sampler_table *tile_rays_points(size_t samples, struct arena *arena)
{
    return sampler_table_new(PATH_DIMENSION, tile_rays_bits_of(samples), arena);
}

void tile_rays_open_points(struct tile_rays *tile, uint32_t bits)
{
    tile->bits = bits;
    sobol_open_strands(HERO_DIMENSION, bits, &tile->hero);
    for (uint32_t k = 0; k <= FILM_DIMENSIONS; k++) {
        struct sobol *sobol = k < FILM_DIMENSIONS ? &tile->film_points[k] : &tile->when;
        if (tile->in_strands) {
            sobol_open_strands(k, bits, sobol);
        } else {
            sobol_open(k, sobol);
        }
    }
}

void tile_rays_open(const struct photograph_question *question, const struct lens_film *film,
                    struct arena *arena, struct tile_rays *tile)
{
    const size_t wavelengths = question->film.setup->wavelength_count;
    const bool as_one = wavelengths == 1 || (!skip_is_kept(question->kept, SKIP_COLOUR) &&
                                             tile_rays_is_alike(film, wavelengths));
    *tile = (struct tile_rays){.film = film,
                               .passes = as_one ? 1 : wavelengths,
                               .may_share = !as_one && !skip_is_kept(question->kept, SKIP_COLOUR),
                               .duration = question->duration,
                               .in_strands = question->view != NULL,
                               .seed = question->seed};
    tile->pass = passes_of(question, tile->passes, arena);
    tile_rays_open_points(tile, tile_rays_bits_of(question->samples));
}

struct tile_room *tile_room_new(size_t passes, struct arena *arena)
{
    struct tile_room *room = ARENA_NEW(arena, struct tile_room);
    room->rays = rays_new(arena, RAYS_BLOCK);
    room->colours = tile_colours_new(passes, arena);
    return room;
}

/* -------- rays -------- */

/* How a block of rays goes: at which wavelength of the lens, in which bands, for whom. */
struct tile_rays_way {
    size_t wavelength;
    struct lanes lanes;
    struct ray_reuse_pass pass;
};

/* What one ray brings to its pixel. */
static void tile_rays_add_ray(const struct film_plan *plan, const struct ray_reuse_pass *pass,
                              size_t i, struct tile_room *room)
{
    const struct film_samples *samples = &room->samples;
    double *sums = room->sums[tile_cell_of(plan, samples->x[i], samples->y[i]).pixel];
    const double *light = room->light[i];
    tile_block_count(i, room);
    for (size_t channel = pass->begin; channel < pass->end; channel++) {
        sums[channel] += pass->share * samples->weight[i] * light[channel];
    }
}

/* A block of points, of one wavelength of the lens, in the bands of these lanes. */
static void sum_block(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      const struct tile_rays_way *way, struct tile_room *room)
{
    tile_block_trace(tile, plan, block, way->wavelength, room);
    tile_block_look(tile, block, &way->lanes, room);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        tile_rays_add_ray(plan, &way->pass, i, room);
    }
}

/*
 * The same of many bands: one of each quarter of them for each block, as far apart as can be, in
 * one pass where all go the same way through the lens. Blocks that follow each other have places of
 * a sequence in these, so that a power of two of them meets all bands evenly. No density of our
 * rays depends on the band, so that the balance heuristic is the plain mean [Wilkie14].
 */
static void sum_bands(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      struct tile_room *room)
{
    const size_t count = tile->subject.view->bands->count;
    /* blocks are points of a sequence too: those of their first places */
    const uint32_t point = block * SOBOL_BLOCK;
    const double hero = sobol_point(&tile->hero, room->hero, point);
    struct tile_rays_way way = {.pass = {0, TILE_CHANNELS, (double)count / BANDS_LANES}};
    for (size_t lane = 0; lane < BANDS_LANES; lane++) {
        const size_t band = (size_t)((double)count * (((double)lane + hero) / BANDS_LANES));
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

double tile_rays_light(const struct tile_rays *tile, const double at[2], size_t blocks,
                       struct tile_room *room)
{
    const size_t wavelength = tile_rays_in_bands(tile) ? tile->passes / 2 : 0;
    return lens_film_light(tile->film, at, wavelength, blocks, &room->samples, &room->rays);
}

/* -------- tiles -------- */

void tile_rays_sum(const struct tile_rays *tile, const struct film_plan *plan, size_t begin,
                   size_t end, struct tile_room *room)
{
    assert(!tile->in_strands || end <= (size_t)1 << tile->bits);
    if (room->fringes != NULL) {
        tile_colours_sum(tile, plan, begin, end, room);
        return;
    }
    /* the same points for all channels: what is left of noise is grey */
    for (size_t pass = 0; pass < tile->passes && !tile_rays_in_bands(tile); pass++) {
        struct tile_rays_way way = {.wavelength = pass, .pass = tile->pass[pass]};
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
    tile_colours_begin(room);
    plan->sobol = tile->film_points;
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        plan->scrambling[k] = sobol_scrambling(tile->seed, number, k);
    }
    room->when = sobol_scrambling(tile->seed, number, TIME_DIMENSION);
    room->hero = sobol_scrambling(tile->seed, number, HERO_DIMENSION);
    if (tile->in_strands) {
        tile_order(tile->seed, number, room->cells);
    }
    if (view != NULL) {
        sampler_sequence_open(view->points, tile->seed, (uint32_t)number, &room->sequence);
    }
}
