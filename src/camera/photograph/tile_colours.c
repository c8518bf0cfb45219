/* camera/photograph/tile_colours.c - weights of each colour's rays, times what those of the middle show. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tile_colours.h"

#include "camera/photograph/tile_block.h"
#include "camera/photograph/tile_cell.h"

#include <string.h>

typedef double channels[TILE_PIXELS][TILE_CHANNELS];

/* Of the pixels of a tile, by channel, since the last round was complete. */
struct round {
    channels own;              /* weights of a colour's own rays, which arrive */
    channels seen, light;      /* of shared ones that show what these do; and times light */
    channels nearby, light_of; /* the same of all shared ones: where there are none of these */
};

struct tile_colours {
    struct lateral_colour_room *fringes;
    struct round round;
};

struct tile_colours *tile_colours_new(size_t passes, struct arena *arena)
{
    struct tile_colours *colours = ARENA_NEW(arena, struct tile_colours);
    colours->fringes = lateral_colour_room_new(passes, arena);
    return colours;
}

void tile_colours_begin(struct tile_room *room)
{
    room->fringes = NULL;
    memset(&room->colours->round, 0, sizeof room->colours->round);
}

/* Samples of a round, whose weights are compared, and of all rounds before it. */
enum { FIRST_ROUND = 8 };

static size_t tile_colours_middle_of(const struct tile_rays *tile)
{
    return tile->passes / 2;
}

/* What of the light comes to the pixels, by each colour's own rays. */
static void trace_own(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                      struct tile_room *room)
{
    struct round *round = &room->colours->round;
    const struct film_samples *samples = &room->samples;
    for (size_t wavelength = 0; wavelength < tile->passes; wavelength++) {
        const struct ray_reuse_pass *pass = &tile->pass[wavelength];
        tile_block_trace(tile, plan, block, wavelength, room);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            double *own = round->own[tile_cell_of(plan, samples->x[i], samples->y[i]).pixel];
            tile_block_count(i, room);
            for (size_t k = pass->begin; k < pass->end && tile_block_arrives(room, i); k++) {
                own[k] += pass->share * samples->weight[i];
            }
        }
    }
}

/* Points of pixels become points of all that any colour shows there. */
static void move_points(const struct film_plan *plan, struct tile_room *room,
                        struct tile_cell cells[RAYS_BLOCK])
{
    const struct lateral_colour *fringes = room->fringes;
    struct film_samples *samples = &room->samples;
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
static bool shows_same(const struct film_plan *plan, const struct tile_room *room, size_t i,
                       const struct tile_cell *cell, size_t wavelength)
{
    const double across = (room->samples.x[i] - plan->left) / plan->width;
    const double up = (room->samples.y[i] - plan->bottom) / plan->height;
    const double x =
        across - lateral_colour_moved(room->fringes, wavelength, 0, across, up) / plan->width;
    const double y =
        up - lateral_colour_moved(room->fringes, wavelength, 1, across, up) / plan->height;
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

/* A block of points: rays of the middle, for all channels. */
static void sum_shared(const struct tile_rays *tile, const struct film_plan *plan, uint32_t block,
                       struct tile_room *room)
{
    static const struct lanes lanes = {TILE_CHANNELS, {0, 1, 2}};
    struct tile_cell cells[RAYS_BLOCK];
    trace_own(tile, plan, block, room);
    move_points(plan, room, cells);
    lens_film_start(tile->film, &room->samples, room->rays.blocks);
    lens_film_trace(tile->film, tile_colours_middle_of(tile), &room->samples, &room->rays);
    tile_block_look(tile, block, &lanes, room);
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        const double weight = room->samples.weight[i];
        for (size_t w = 0; w < tile->passes && tile_block_arrives(room, i); w++) {
            add_shared(&tile->pass[w], cells[i].pixel, weight, room->light[i],
                       shows_same(plan, room, i, &cells[i], w), &room->colours->round);
        }
    }
}

/* A round is complete: sums receive what it brought. */
static void complete_round(struct tile_room *room)
{
    struct round *round = &room->colours->round;
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        for (size_t k = 0; k < TILE_CHANNELS; k++) {
            const double own = round->own[i][k];
            if (round->seen[i][k] > 0) {
                room->sums[i][k] += own * round->light[i][k] / round->seen[i][k];
            } else if (round->nearby[i][k] > 0) {
                room->sums[i][k] += own * round->light_of[i][k] / round->nearby[i][k];
            }
        }
    }
    memset(round, 0, sizeof *round);
}

bool tile_colours_share(const struct tile_rays *tile, const struct film_plan *plan,
                        struct tile_room *room)
{
    const struct lateral_colour_question question = {
        tile->film,
        tile->passes,
        tile_colours_middle_of(tile),
        {plan->width / TILE_ACROSS, plan->height / TILE_DOWN}};
    if (tile->may_share && tile->subject.view != NULL && !tile_rays_in_bands(tile)) {
        room->fringes = lateral_colour_find(&question, plan, room->colours->fringes);
    }
    return room->fringes != NULL;
}

void tile_colours_sum(const struct tile_rays *tile, const struct film_plan *plan, size_t begin,
                      size_t end, struct tile_room *room)
{
    for (uint32_t block = (uint32_t)begin; block < end; block++) {
        sum_shared(tile, plan, block, room);
    }
    if (end >= FIRST_ROUND && (end & (end - 1)) == 0) {
        complete_round(room);
    }
}
