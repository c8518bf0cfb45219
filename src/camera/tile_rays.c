/* camera/tile_rays.c - blocks of rays of a tile: traced, timed, looked along and added up. */
/* SPDX-License-Identifier: MIT */
#include "camera/tile_rays.h"

#include "base/random.h"

#include <assert.h>
#include <math.h>
#include <string.h>

_Static_assert(TILE_ACROSS == (int)FILM_ACROSS && TILE_DOWN == (int)FILM_DOWN,
               "a cell of the film for each pixel of a tile");

/* Behind those of film, time and paths. */
enum { HERO_DIMENSION = FILM_DIMENSIONS + 1 + POINTS_DIMENSIONS };

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

uint32_t tile_rays_bits(size_t samples)
{
    uint32_t bits = 0;
    while (bits < 32 - SOBOL_LOW && (size_t)1 << bits < samples) {
        bits++;
    }
    return bits;
}

void tile_rays_open(const struct photograph_question *question, const struct lens_film *film,
                    struct arena *arena, struct tile_rays *tile)
{
    const size_t wavelengths = question->film.setup->wavelength_count;
    const bool as_one = wavelengths == 1 ||
                        ((question->kept & 1U << SKIP_COLOUR) == 0 && is_alike(film, wavelengths));
    *tile = (struct tile_rays){.film = film,
                               .passes = as_one ? 1 : wavelengths,
                               .may_share = !as_one && (question->kept & 1U << SKIP_COLOUR) == 0,
                               .duration = question->duration,
                               .in_strands = question->view != NULL,
                               .bits = tile_rays_bits(question->samples),
                               .seed = question->seed};
    tile->pass = passes_of(question, tile->passes, arena);
    sobol_open_strands(HERO_DIMENSION, tile->bits, &tile->hero);
    for (uint32_t k = 0; k <= FILM_DIMENSIONS; k++) {
        struct sobol *sobol = k < FILM_DIMENSIONS ? &tile->film_points[k] : &tile->when;
        if (tile->in_strands) {
            sobol_open_strands(k, tile->bits, sobol);
        } else {
            sobol_open(k, sobol);
        }
    }
}

typedef double channels[TILE_PIXELS][TILE_CHANNELS];

/* Of the pixels of a tile, by channel, since the last round was complete. */
struct tile_shared {
    channels own;              /* weights of a colour's own rays, which arrive */
    channels seen, light;      /* of shared ones that show what these do; and times light */
    channels nearby, light_of; /* the same of all shared ones: where there are none of these */
};

struct tile_room *tile_room_new(size_t passes, struct arena *arena)
{
    struct tile_room *room = ARENA_NEW(arena, struct tile_room);
    room->rays = rays_new(arena, RAYS_BLOCK);
    room->fringes_room = fringes_room_new(passes, arena);
    room->shared = ARENA_NEW(arena, struct tile_shared);
    return room;
}

/* -------- rays -------- */

/* How a block of rays goes: at which wavelength of the lens, in which bands, for whom. */
struct way {
    size_t wavelength;
    struct lanes lanes;
    struct spare_pass pass;
};

/* Start and trace a block of points of a plan, at a wavelength of the lens. */
static void trace(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                  size_t wavelength, struct tile_room *room)
{
    if (tile->in_strands) {
        film_rays_cells(plan, room->cells, block, SET_BEST, &room->samples);
    } else {
        film_rays_plan(plan, block, SET_BEST, &room->samples);
    }
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

/* Where a point of a tile lies. */
struct cell {
    size_t column, row; /* from the left and from below, on the film */
    size_t pixel;       /* in rows from the upper left of the picture */
};

static struct cell cell_of(const struct film_plan *plan, double x, double y)
{
    const double across = (x - plan->left) / plan->width * TILE_ACROSS;
    const double up = (y - plan->bottom) / plan->height * TILE_DOWN;
    const size_t column = (size_t)fmin(across, TILE_ACROSS - 1),
                 row = (size_t)fmin(up, TILE_DOWN - 1);
    return (struct cell){column, row, row * TILE_ACROSS + (TILE_ACROSS - 1 - column)};
}

/* Does a ray arrive, from a lit place, taken by the pixel? */
static bool arrives(const struct tile_room *room, size_t i)
{
    return room->samples.weight[i] > 0 && room->rays.blocks->lost[i] == 0;
}

static void count_ray(size_t i, struct tile_room *room)
{
    room->counts[PHOTOGRAPH_TRACED] += room->samples.weight[i] > 0;
    room->counts[PHOTOGRAPH_PASSED] += arrives(room, i);
}

/* What one ray brings to its pixel. */
static void add_ray(const struct film_plan *plan, const struct spare_pass *pass, size_t i,
                    struct tile_room *room)
{
    const struct film_samples *samples = &room->samples;
    double *sums = room->sums[cell_of(plan, samples->x[i], samples->y[i]).pixel];
    const double *light = room->light[i];
    count_ray(i, room);
    for (size_t channel = pass->begin; channel < pass->end; channel++) {
        sums[channel] += pass->share * samples->weight[i] * light[channel];
    }
}

/* The light along a block of traced rays. */
static void look(const struct tile_rays *tile, uint32_t block, const struct lanes *lanes,
                 struct tile_room *room)
{
    time_rays(tile, block, room);
    const struct subject_rays rays = {.block = room->rays.blocks,
                                      .weights = room->samples.weight,
                                      .times = room->times,
                                      .lanes = lanes,
                                      .sequence = &room->sequence,
                                      .number = block};
    tile->subject.look(&tile->subject, &rays, room->counts, room->light);
}

/* A block of points, of one wavelength of the lens, in the bands of these lanes. */
static void sum_block(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      const struct way *way, struct tile_room *room)
{
    trace(tile, plan, block, way->wavelength, room);
    look(tile, block, &way->lanes, room);
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
    /* blocks are points of a sequence too: those of their first places */
    const uint32_t point = block * SOBOL_BLOCK;
    const size_t hero = (size_t)((double)count * sobol_point(&tile->hero, room->hero, point));
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

/* -------- rays that colours share -------- */

/* Samples of a round, whose weights are compared, and of all rounds before it. */
enum { FIRST_ROUND = 8 };

static size_t middle_of(const struct tile_rays *tile)
{
    return tile->passes / 2;
}

/* What of the light comes to the pixels, by each colour's own rays. */
static void trace_own(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      struct tile_room *room)
{
    struct tile_shared *shared = room->shared;
    const struct film_samples *samples = &room->samples;
    for (size_t wavelength = 0; wavelength < tile->passes; wavelength++) {
        const struct spare_pass *pass = &tile->pass[wavelength];
        trace(tile, plan, block, wavelength, room);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            double *own = shared->own[cell_of(plan, samples->x[i], samples->y[i]).pixel];
            count_ray(i, room);
            for (size_t k = pass->begin; k < pass->end && arrives(room, i); k++) {
                own[k] += pass->share * samples->weight[i];
            }
        }
    }
}

/* Points of pixels become points of all that any colour shows there. */
static void move_points(const struct film_plan *plan, struct tile_room *room,
                        struct cell cells[RAYS_BLOCK])
{
    const struct fringes *fringes = room->fringes;
    struct film_samples *samples = &room->samples;
    const double wide = plan->width / TILE_ACROSS, high = plan->height / TILE_DOWN;
    const double more_x = (fringes->high[0] - fringes->low[0]) / wide;
    const double more_y = (fringes->high[1] - fringes->low[1]) / high;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        cells[i] = cell_of(plan, samples->x[i], samples->y[i]);
        const double x = samples->x[i] - (plan->left + (double)cells[i].column * wide);
        const double y = samples->y[i] - (plan->bottom + (double)cells[i].row * high);
        samples->x[i] += fringes->low[0] + more_x * x;
        samples->y[i] += fringes->low[1] + more_y * y;
    }
}

/* Does a ray of the middle show what one of this wavelength does, of the same pixel? */
static bool shows_same(const struct film_plan *plan, const struct tile_room *room, size_t i,
                       const struct cell *cell, size_t wavelength)
{
    const double across = (room->samples.x[i] - plan->left) / plan->width;
    const double up = (room->samples.y[i] - plan->bottom) / plan->height;
    const double x = across - fringes_moved(room->fringes, wavelength, 0, across, up) / plan->width;
    const double y = up - fringes_moved(room->fringes, wavelength, 1, across, up) / plan->height;
    const double column = TILE_ACROSS * x - (double)cell->column;
    const double row = TILE_DOWN * y - (double)cell->row;
    return column >= 0 && column < 1 && row >= 0 && row < 1;
}

/* What a ray of the middle adds for a wavelength. */
static void add_shared(const struct spare_pass *pass, size_t pixel, double weight,
                       const double *light, bool is_same, struct tile_shared *shared)
{
    for (size_t k = pass->begin; k < pass->end; k++) {
        const double w = pass->share * weight;
        shared->nearby[pixel][k] += w;
        shared->light_of[pixel][k] += w * light[k];
        if (is_same) {
            shared->seen[pixel][k] += w;
            shared->light[pixel][k] += w * light[k];
        }
    }
}

/* A block of points: rays of the middle, for all channels. */
static void sum_shared(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                       struct tile_room *room)
{
    static const struct lanes lanes = {TILE_CHANNELS, {0, 1, 2}};
    struct cell cells[RAYS_BLOCK];
    trace_own(tile, plan, block, room);
    move_points(plan, room, cells);
    lens_film_start(tile->film, &room->samples, room->rays.blocks);
    lens_film_trace(tile->film, middle_of(tile), &room->samples, &room->rays);
    look(tile, block, &lanes, room);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double weight = room->samples.weight[i];
        for (size_t w = 0; w < tile->passes && arrives(room, i); w++) {
            add_shared(&tile->pass[w], cells[i].pixel, weight, room->light[i],
                       shows_same(plan, room, i, &cells[i], w), room->shared);
        }
    }
}

/*
 * A round is complete: of each pixel and colour the light that its own rays bring from a white
 * scene, times the mean of what the shared rays show that look where these do. Means of few are
 * off by as much as weights and light have to do with each other over their number: rounds are as
 * long as all before them.
 */
static void complete_round(struct tile_room *room)
{
    struct tile_shared *shared = room->shared;
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        for (size_t k = 0; k < TILE_CHANNELS; k++) {
            const double own = shared->own[i][k];
            if (shared->seen[i][k] > 0) {
                room->sums[i][k] += own * shared->light[i][k] / shared->seen[i][k];
            } else if (shared->nearby[i][k] > 0) {
                room->sums[i][k] += own * shared->light_of[i][k] / shared->nearby[i][k];
            }
        }
    }
    memset(shared, 0, sizeof *shared);
}

bool tile_rays_share(const struct tile_rays *tile, const struct film_plan *plan,
                     struct tile_room *room)
{
    const struct fringes_question question = {
        tile->film,
        tile->passes,
        middle_of(tile),
        {plan->width / TILE_ACROSS, plan->height / TILE_DOWN}};
    if (tile->may_share && tile->subject.view != NULL && !tile_rays_in_bands(tile)) {
        room->fringes = fringes_find(&question, plan, room->fringes_room);
    }
    return room->fringes != NULL;
}

/* -------- tiles -------- */

void tile_rays_sum(const struct tile_rays *tile, const struct film_plan *plan, size_t begin,
                   size_t end, struct tile_room *room)
{
    assert(!tile->in_strands || end <= (size_t)1 << tile->bits);
    if (room->fringes != NULL) {
        for (uint32_t block = (uint32_t)begin; block < end; block++) {
            sum_shared(tile, plan, block, room);
        }
        if (end >= FIRST_ROUND && (end & (end - 1)) == 0) {
            complete_round(room);
        }
        return;
    }
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

/* Digits 0 .. 3 in an order by chance. */
static void shuffle(uint32_t word, unsigned char digits[4])
{
    for (uint32_t left = 4; left > 0; left--) {
        const uint32_t taken = word % left, digit = digits[taken];
        word /= left;
        digits[taken] = digits[left - 1];
        digits[left - 1] = (unsigned char)digit;
    }
}

/*
 * Pixels along a curve that fills squares: those that follow each other, whose points complement
 * each other, are neighbours. The quarters of each square come in an order by chance, or it would
 * show as a pattern of the whole picture.
 */
static void order_cells(uint64_t seed, size_t number, unsigned char cells[RAYS_BLOCK])
{
    enum { NODES = 44 }; /* both halves; then quarters of squares of 8, 4 and 2 pixels */
    unsigned char order[NODES][4];
    for (uint32_t k = 0; k < NODES; k += 4) {
        const struct random_words words = random_words(RANDOM_CELLS, seed, number, k);
        for (uint32_t j = 0; j < 4; j++) {
            memcpy(order[k + j], (const unsigned char[]){0, 1, 2, 3}, 4);
            shuffle(words.w[j], order[k + j]);
        }
    }
    const size_t half = order[0][0] % 2;
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const size_t eight = order[1 + i / 64][i / 16 % 4], four = order[3 + i / 16][i / 4 % 4],
                     two = order[11 + i / 4][i % 4];
        const size_t column = (i / 64 ^ half) * 8 + eight % 2 * 4 + four % 2 * 2 + two % 2;
        const size_t row = eight / 2 * 4 + four / 2 * 2 + two / 2;
        cells[i] = (unsigned char)(row * TILE_ACROSS + column);
    }
}

void tile_rays_begin(const struct tile_rays *tile, size_t number, struct film_plan *plan,
                     struct tile_room *room)
{
    const struct view *view = tile->subject.view;
    memset(room->sums, 0, sizeof room->sums);
    room->fringes = NULL;
    memset(room->shared, 0, sizeof *room->shared);
    plan->sobol = tile->film_points;
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        plan->scrambling[k] = sobol_scrambling(tile->seed, number, k);
    }
    room->when = sobol_scrambling(tile->seed, number, FILM_DIMENSIONS);
    room->hero = sobol_scrambling(tile->seed, number, HERO_DIMENSION);
    if (tile->in_strands) {
        order_cells(tile->seed, number, room->cells);
    }
    if (view != NULL) {
        points_sequence_open(view->points, tile->seed, (uint32_t)number, &room->sequence);
    }
}
