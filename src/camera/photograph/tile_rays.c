/* camera/photograph/tile_rays.c - blocks of rays of a tile, added up by pixel and channel. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tile_rays.h"

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
    const size_t media = film->models[0].system->lens->surface_count + 1;
    bool alike = true;
    for (size_t w = 1; w < wavelengths; w++) {
        for (size_t i = 0; i < media; i++) {
            alike = alike && film->models[w].system->n[i].hi == film->models[0].system->n[i].hi;
        }
    }
    return alike;
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
    /* what the wavelengths of the question are for */
    const size_t passes = tile->passes;
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
    tile->pass = pass;
    tile_rays_open_points(tile, tile_rays_bits_of(question->samples));
}

/* -------- blocks -------- */

/* Start and trace a block of points of a plan, at a wavelength of the lens. */
static void tile_block_trace(const struct tile_rays *tile, const struct film_plan *plan,
                             uint32_t block, size_t wavelength, struct tile_scratch *scratch)
{
    film_rays_plan(plan, tile->in_strands ? scratch->cells : NULL, block, SET_BEST,
                   &scratch->samples);
    lens_film_start(tile->film, &scratch->samples, scratch->rays.blocks);
    lens_film_trace(tile->film, wavelength, &scratch->samples, &scratch->rays);
}

/* The light along a block of traced rays, in these lanes: scratch->light. */
static void tile_block_look(const struct tile_rays *tile, uint32_t block, const struct lanes *lanes,
                            struct tile_scratch *scratch)
{
    /*
     * when the rays of a block come: evenly within the time that each has, the middle of all at 0
     */
    const double duration = tile->duration;
    if (duration > 0) {
        sobol_points(&tile->when, scratch->when, block, scratch->times);
        const double *begin = scratch->samples.begin, *end = scratch->samples.end;
        const bool is_shut = tile->film->shutter != NULL;
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            scratch->times[i] = is_shut ? begin[i] + scratch->times[i] * (end[i] - begin[i])
                                        : duration * (scratch->times[i] - 0.5);
        }
    }
    const struct subject_rays rays = {.block = scratch->rays.blocks,
                                      .weights = scratch->samples.weight,
                                      .times = scratch->times,
                                      .lanes = lanes,
                                      .sequence = &scratch->sequence,
                                      .number = block};
    tile->subject.look(&tile->subject, &rays, scratch->counts, scratch->light);
}

/* Does a ray arrive, from a lit place, taken by the pixel? */
static inline bool tile_block_arrives(const struct tile_scratch *scratch, size_t i)
{
    return scratch->samples.weight[i] > 0 && scratch->rays.blocks->lost[i] == 0;
}

/* Count a traced ray. */
static inline void tile_block_count(size_t i, struct tile_scratch *scratch)
{
    scratch->counts[PHOTOGRAPH_TRACED] += scratch->samples.weight[i] > 0;
    scratch->counts[PHOTOGRAPH_PASSED] += tile_block_arrives(scratch, i);
}

/* -------- colours that share rays -------- */

typedef double channels[TILE_PIXELS][TILE_CHANNELS];

/* Of the pixels of a tile, by channel, since the last round was complete. */
struct round {
    channels own;              /* weights of a colour's own rays, which arrive */
    channels seen, light;      /* of shared ones that show what these do; and times light */
    channels nearby, light_of; /* the same of all shared ones: where there are none of these */
};

struct tile_colours {
    struct lateral_colour_scratch *fringes;
    struct round round;
};

/* Samples of a round, whose weights are compared, and of all rounds before it. */
enum { FIRST_ROUND = 8 };

static size_t colours_middle_of(const struct tile_rays *tile)
{
    return tile->passes / 2;
}

/* What of the light comes to the pixels, by each colour's own rays. */
static void trace_own(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      struct tile_scratch *scratch)
{
    struct round *round = &scratch->colours->round;
    const struct film_samples *samples = &scratch->samples;
    for (size_t wavelength = 0; wavelength < tile->passes; wavelength++) {
        const struct ray_reuse_pass *pass = &tile->pass[wavelength];
        tile_block_trace(tile, plan, block, wavelength, scratch);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            double *own = round->own[tile_cell_of(plan, samples->x[i], samples->y[i]).pixel];
            tile_block_count(i, scratch);
            for (size_t k = pass->begin; k < pass->end && tile_block_arrives(scratch, i); k++) {
                own[k] += pass->share * samples->weight[i];
            }
        }
    }
}

/* Points of pixels become points of all that any colour shows there. */
static void move_points(const struct film_plan *plan, struct tile_scratch *scratch,
                        struct tile_cell cells[RAYS_BLOCK])
{
    const struct lateral_colour *fringes = scratch->fringes;
    struct film_samples *samples = &scratch->samples;
    const double wide = plan->width / TILE_ACROSS, high = plan->height / TILE_DOWN;
    const double more_x = (fringes->high[0] - fringes->low[0]) / wide;
    const double more_y = (fringes->high[1] - fringes->low[1]) / high;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        cells[i] = tile_cell_of(plan, samples->x[i], samples->y[i]);
        const double x = samples->x[i] - (plan->left + (double)cells[i].column * wide);
        const double y = samples->y[i] - (plan->bottom + (double)cells[i].row * high);
        samples->x[i] += fringes->low[0] + more_x * x;
        samples->y[i] += fringes->low[1] + more_y * y;
    }
}

/* Does a ray of the middle show what one of this wavelength does, of the same pixel? */
static bool shows_same(const struct film_plan *plan, const struct tile_scratch *scratch, size_t i,
                       const struct tile_cell *cell, size_t wavelength)
{
    const double across = (scratch->samples.x[i] - plan->left) / plan->width;
    const double up = (scratch->samples.y[i] - plan->bottom) / plan->height;
    const double x =
        across - lateral_colour_moved(scratch->fringes, wavelength, 0, across, up) / plan->width;
    const double y =
        up - lateral_colour_moved(scratch->fringes, wavelength, 1, across, up) / plan->height;
    const double column = TILE_ACROSS * x - (double)cell->column;
    const double row = TILE_DOWN * y - (double)cell->row;
    return column >= 0 && column < 1 && row >= 0 && row < 1;
}

/* What a ray of the middle adds for a wavelength. */
static void add_shared(const struct ray_reuse_pass *pass, size_t pixel, double weight,
                       const double *light, bool is_same, struct round *round)
{
    for (size_t k = pass->begin; k < pass->end; k++) {
        const double w = pass->share * weight;
        round->nearby[pixel][k] += w;
        round->light_of[pixel][k] += w * light[k];
        if (is_same) {
            round->seen[pixel][k] += w;
            round->light[pixel][k] += w * light[k];
        }
    }
}

bool tile_colours_share(const struct tile_rays *tile, const struct film_plan *plan,
                        struct tile_scratch *scratch)
{
    const double pixel[2] = {plan->width / TILE_ACROSS, plan->height / TILE_DOWN};
    if (tile->may_share && tile->subject.view != NULL && !tile_rays_in_bands(tile)) {
        scratch->fringes = lateral_colour_find(tile->film, tile->passes, colours_middle_of(tile),
                                               pixel, plan, scratch->colours->fringes);
    }
    return scratch->fringes != NULL;
}

/*
 * Blocks begin .. end - 1 of points of a tile whose colours share rays.
 *
 * Result    scratch->sums, where a round ends: after a power of two of blocks, 8 at least
 * Formula   of each pixel and colour the light that its own rays bring from a white scene, times
 *           the mean of what the shared rays show that look where these do. Means of few are off by
 *           as much as weights and light have to do with each other over their number: rounds are
 *           as long as all before them
 */
static void tile_colours_sum(const struct tile_rays *tile, const struct film_plan *plan,
                             size_t begin, size_t end, struct tile_scratch *scratch)
{
    for (uint32_t block = (uint32_t)begin; block < end; block++) {
        /* a block of points: rays of the middle, for all channels */
        static const struct lanes lanes = {TILE_CHANNELS, {0, 1, 2}};
        struct tile_cell cells[RAYS_BLOCK];
        trace_own(tile, plan, block, scratch);
        move_points(plan, scratch, cells);
        lens_film_start(tile->film, &scratch->samples, scratch->rays.blocks);
        lens_film_trace(tile->film, colours_middle_of(tile), &scratch->samples, &scratch->rays);
        tile_block_look(tile, block, &lanes, scratch);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const double weight = scratch->samples.weight[i];
            for (size_t w = 0; w < tile->passes && tile_block_arrives(scratch, i); w++) {
                add_shared(&tile->pass[w], cells[i].pixel, weight, scratch->light[i],
                           shows_same(plan, scratch, i, &cells[i], w), &scratch->colours->round);
            }
        }
    }
    if (end >= FIRST_ROUND && (end & (end - 1)) == 0) {
        /* a round is complete: sums receive what it brought */
        struct round *round = &scratch->colours->round;
        for (size_t i = 0; i < TILE_PIXELS; i++) {
            for (size_t k = 0; k < TILE_CHANNELS; k++) {
                const double own = round->own[i][k];
                if (round->seen[i][k] > 0) {
                    scratch->sums[i][k] += own * round->light[i][k] / round->seen[i][k];
                } else if (round->nearby[i][k] > 0) {
                    scratch->sums[i][k] += own * round->light_of[i][k] / round->nearby[i][k];
                }
            }
        }
        memset(round, 0, sizeof *round);
    }
}

struct tile_scratch *tile_scratch_new(size_t passes, struct arena *arena)
{
    struct tile_scratch *scratch = ARENA_NEW(arena, struct tile_scratch);
    scratch->rays = rays_new(arena, RAYS_BLOCK);
    /* what shared rays have brought to one tile since its last round */
    struct tile_colours *colours = ARENA_NEW(arena, struct tile_colours);
    colours->fringes = lateral_colour_scratch_new(passes, arena);
    scratch->colours = colours;
    return scratch;
}

/* -------- rays -------- */

/* How a block of rays goes: at which wavelength of the lens, in which bands, for whom. */
struct tile_rays_way {
    size_t wavelength;
    struct lanes lanes;
    struct ray_reuse_pass pass;
};

/* A block of points, of one wavelength of the lens, in the bands of these lanes. */
static void sum_block(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      const struct tile_rays_way *way, struct tile_scratch *scratch)
{
    tile_block_trace(tile, plan, block, way->wavelength, scratch);
    tile_block_look(tile, block, &way->lanes, scratch);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        /* what one ray brings to its pixel */
        const struct ray_reuse_pass *pass = &way->pass;
        const struct film_samples *samples = &scratch->samples;
        double *sums = scratch->sums[tile_cell_of(plan, samples->x[i], samples->y[i]).pixel];
        const double *light = scratch->light[i];
        tile_block_count(i, scratch);
        for (size_t channel = pass->begin; channel < pass->end; channel++) {
            sums[channel] += pass->share * samples->weight[i] * light[channel];
        }
    }
}

/*
 * The same of many bands: one of each quarter of them for each block, as far apart as can be, in
 * one pass where all go the same way through the lens. Blocks that follow each other have places of
 * a sequence in these, so that a power of two of them meets all bands evenly. No density of our
 * rays depends on the band, so that the balance heuristic is the plain mean [Wilkie14].
 */
static void sum_bands(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      struct tile_scratch *scratch)
{
    const size_t count = tile->subject.view->bands->count;
    /* blocks are points of a sequence too: those of their first places */
    const uint32_t point = block * SOBOL_BLOCK;
    const double hero = sobol_point(&tile->hero, scratch->hero, point);
    struct tile_rays_way way = {.pass = {0, TILE_CHANNELS, (double)count / BANDS_LANES}};
    for (size_t lane = 0; lane < BANDS_LANES; lane++) {
        const size_t band = (size_t)((double)count * (((double)lane + hero) / BANDS_LANES));
        if (tile->passes > 1) {
            way.wavelength = band;
            way.lanes = (struct lanes){1, {band}};
            sum_block(tile, plan, block, &way, scratch);
        } else {
            way.lanes.band[way.lanes.count++] = band;
        }
    }
    if (tile->passes == 1) {
        sum_block(tile, plan, block, &way, scratch);
    }
}

double tile_rays_light(const struct tile_rays *tile, const double at[2], size_t blocks,
                       struct tile_scratch *scratch)
{
    const size_t wavelength = tile_rays_in_bands(tile) ? tile->passes / 2 : 0;
    return lens_film_light(tile->film, at, wavelength, blocks, &scratch->samples, &scratch->rays);
}

/* -------- tiles -------- */

void tile_rays_sum(const struct tile_rays *tile, const struct film_plan *plan, size_t begin,
                   size_t end, struct tile_scratch *scratch)
{
    assert(!tile->in_strands || end <= (size_t)1 << tile->bits);
    if (scratch->fringes != NULL) {
        tile_colours_sum(tile, plan, begin, end, scratch);
        return;
    }
    /* the same points for all channels: what is left of noise is grey */
    for (size_t pass = 0; pass < tile->passes && !tile_rays_in_bands(tile); pass++) {
        struct tile_rays_way way = {.wavelength = pass, .pass = tile->pass[pass]};
        for (size_t k = way.pass.begin; k < way.pass.end; k++) {
            way.lanes.band[way.lanes.count++] = k;
        }
        for (uint32_t block = (uint32_t)begin; block < end; block++) {
            sum_block(tile, plan, block, &way, scratch);
        }
    }
    for (uint32_t block = (uint32_t)begin; block < end && tile_rays_in_bands(tile); block++) {
        sum_bands(tile, plan, block, scratch);
    }
}

void tile_rays_begin(const struct tile_rays *tile, size_t number, struct film_plan *plan,
                     struct tile_scratch *scratch)
{
    const struct view *view = tile->subject.view;
    memset(scratch->sums, 0, sizeof scratch->sums);
    /* begin a tile, in which nothing is shared yet */
    scratch->fringes = NULL;
    memset(&scratch->colours->round, 0, sizeof scratch->colours->round);
    plan->sobol = tile->film_points;
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        plan->scrambling[k] = sobol_scrambling(tile->seed, number, k);
    }
    scratch->when = sobol_scrambling(tile->seed, number, TIME_DIMENSION);
    scratch->hero = sobol_scrambling(tile->seed, number, HERO_DIMENSION);
    if (tile->in_strands) {
        tile_order(tile->seed, number, scratch->cells);
    }
    if (view != NULL) {
        sampler_sequence_open(view->points, tile->seed, (uint32_t)number, &scratch->sequence);
    }
}
