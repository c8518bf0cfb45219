/* camera/photograph.c - tiles of a film, each with its own points, in any order. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph.h"

#include "base/parallel.h"
#include "camera/lens_film.h"

#include <math.h>
#include <string.h>

/* Pixels of a tile: of 128 points of a net in base 2 each has one. */
enum { ACROSS = 16, DOWN = 8, PIXELS = ACROSS * DOWN };
_Static_assert(PIXELS == (int)RAYS_BLOCK, "a block of points for a tile");

struct work {
    const struct photograph_question *question;
    const struct lens_film *film;
    struct card card;
    struct image *image;
    size_t tiles_across, tiles;
    double scale;  /* (n'/n)^2, n of the scene */
    size_t passes; /* one for all channels where nothing disperses, or one a channel */
};

/* What one thread traces in. */
struct room {
    struct film_samples samples;
    struct rays rays;
    double sums[PIXELS][PHOTOGRAPH_CHANNELS];
};

static struct room *room_of(struct arena *arena)
{
    struct room *room = ARENA_NEW(arena, struct room);
    room->rays = rays_new(arena, RAYS_BLOCK);
    return room;
}

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

/* Start and trace block `block` of a plan. */
static void trace_plan(const struct lens_film *film, const struct film_plan *plan, uint32_t block,
                       size_t wavelength, struct room *room)
{
    film_rays_plan(plan, block, SET_BEST, &room->samples);
    film_rays_start(&film->region, &room->samples, SET_BEST, room->rays.blocks);
    rays_trace(film->systems[wavelength], &room->rays, NULL);
}

/* Where a ray that has left the lens meets the card; false: it never does. */
static bool meet(const struct ray_block *rays, size_t i, double distance, double at[2])
{
    const double way = (-distance - rays->z[i]) / rays->r[i];
    at[0] = rays->x[i] + way * rays->p[i];
    at[1] = rays->y[i] + way * rays->q[i];
    return rays->lost[i] == 0 && way > 0;
}

/* -------- tiles -------- */

/* The film is upside down: the upper left of the picture lies at +x, -y. */
static struct film_plan plan_of(const struct work *work, size_t column, size_t row)
{
    const struct photograph_question *question = work->question;
    const double across = question->film.width / (double)question->columns;
    const double down = question->film.height / (double)question->rows;
    return (struct film_plan){.sobol = work->film->sobol,
                              .left = question->film.width / 2 - (double)(column + ACROSS) * across,
                              .bottom = (double)row * down - question->film.height / 2,
                              .width = ACROSS * across,
                              .height = DOWN * down};
}

/* Does light reach any of it? */
static bool is_lit(const struct film_plan *plan, double largest)
{
    const double x = fmax(0, fmax(plan->left, -plan->left - plan->width));
    const double y = fmax(0, fmax(plan->bottom, -plan->bottom - plan->height));
    return x * x + y * y <= largest * largest;
}

/* What one ray brings to its pixel. */
static void add_ray(const struct work *work, const struct film_plan *plan, size_t pass, size_t i,
                    struct room *room)
{
    const struct film_samples *samples = &room->samples;
    const double across = (samples->x[i] - plan->left) / plan->width * ACROSS;
    const double down = (samples->y[i] - plan->bottom) / plan->height * DOWN;
    const size_t column = (size_t)fmin(across, ACROSS - 1), row = (size_t)fmin(down, DOWN - 1);
    double at[2], *sums = room->sums[row * ACROSS + (ACROSS - 1 - column)];
    if (!meet(room->rays.blocks, i, work->card.distance, at)) {
        return;
    }
    const struct card_light light = card_look(&work->card, at[0], at[1]);
    const size_t end = work->passes == 1 ? PHOTOGRAPH_CHANNELS : pass + 1;
    for (size_t channel = pass; channel < end; channel++) {
        sums[channel] += samples->weight[i] * (double)light.of[channel];
    }
}

/* Sums of weights times light, a pixel and channel each. */
static void sum_tile(const struct work *work, struct film_plan *plan, size_t tile,
                     struct room *room)
{
    const struct photograph_question *question = work->question;
    memset(room->sums, 0, sizeof room->sums);
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        plan->scrambling[k] = sobol_scrambling(question->seed, tile, k);
    }
    /* the same points for all channels: what is left of noise is grey */
    for (size_t pass = 0; pass < work->passes; pass++) {
        for (uint32_t block = 0; block < question->samples; block++) {
            trace_plan(work->film, plan, block, pass, room);
            for (size_t i = 0; i < RAYS_BLOCK; i++) {
                add_ray(work, plan, pass, i, room);
            }
        }
    }
}

static void take_tile(const struct work *work, size_t tile, struct room *room)
{
    const struct photograph_question *question = work->question;
    const size_t column = tile % work->tiles_across * ACROSS;
    const size_t row = tile / work->tiles_across * DOWN;
    struct film_plan plan = plan_of(work, column, row);
    if (!is_lit(&plan, work->film->region.largest)) {
        return;
    }
    sum_tile(work, &plan, tile, room);
    for (size_t k = 0; k < PIXELS; k++) {
        const size_t x = column + k % ACROSS, y = row + k / ACROSS;
        if (x >= question->columns || y >= question->rows) {
            continue;
        }
        float *pixel = image_row(work->image, y) + x * PHOTOGRAPH_CHANNELS;
        for (size_t channel = 0; channel < PHOTOGRAPH_CHANNELS; channel++) {
            pixel[channel] =
                (float)(work->scale * room->sums[k][channel] / (double)question->samples);
        }
    }
}

static void take_tiles(void *context, const struct parallel_piece *piece)
{
    const struct work *work = context;
    struct watch *watch = work->question->watch;
    const struct arena_mark mark = arena_mark(piece->arena);
    struct room *room = room_of(piece->arena);
    for (size_t tile = piece->begin; tile < piece->end && !watch_is_ended(watch); tile++) {
        take_tile(work, tile, room);
        watch_add(watch, PIXELS);
    }
    arena_reset(piece->arena, mark);
}

/* -------- what the picture is of -------- */

/* How far out on the card a point of the film looks, through the middle of what is clear, mm. */
static void look_through(const struct work *work, double x, double y, struct room *room,
                         double at[2])
{
    const struct lens_film *film = work->film;
    const double share = fmin(1, 0.999 * film->region.largest / hypot(x, y));
    memset(&room->samples, 0, sizeof room->samples);
    room->samples.x[0] = share * x;
    room->samples.y[0] = share * y;
    room->samples.v[0] = film->region.has_hole ? 0.5 : 0; /* not at the edge of a hole */
    film_rays_start(&film->region, &room->samples, SET_BEST, room->rays.blocks);
    rays_trace(film->systems[0], &room->rays, NULL);
    if (!meet(room->rays.blocks, 0, work->card.distance, at)) {
        at[0] = at[1] = 0;
    }
}

/* As large as the film sees, or as high as it is wide. */
static bool size_card(const struct work *work, struct room *room, struct card *card,
                      struct error *error)
{
    const struct photograph_question *question = work->question;
    const double w = question->film.width / 2, h = question->film.height / 2;
    const double proportion = card->picture != NULL
                                  ? (double)card->picture->width / (double)card->picture->height
                                  : w / h;
    if (card->width == 0) {
        const double from[3][2] = {{w, 0}, {0, h}, {w, h}};
        for (int i = 0; i < 3; i++) {
            double at[2];
            look_through(work, from[i][0], from[i][1], room, at);
            const double needed = 2 * fmax(fabs(at[0]), proportion * fabs(at[1]));
            card->width = fmax(card->width, needed);
        }
    }
    card->height = card->height == 0 ? card->width / proportion : card->height;
    return (card->width > 0 && isfinite(card->width)) ||
           fail(error, ERROR_DOMAIN, "no light from the card at %.6g mm reaches the film",
                card->distance);
}

/* E/L in the middle of the film, of the first channel's wavelength. */
static double axis_light(const struct work *work, struct room *room)
{
    enum { BLOCKS = 256 };
    const struct lens_film *film = work->film;
    const struct film_plan plan = {.sobol = film->sobol, .scrambling = {1, 2, 3, 4}};
    double sum = 0;
    for (uint32_t block = 0; block < BLOCKS; block++) {
        trace_plan(film, &plan, block, 0, room);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            sum += room->rays.blocks->lost[i] == 0 ? room->samples.weight[i] : 0;
        }
    }
    return work->scale * sum / (BLOCKS * RAYS_BLOCK);
}

static bool check_card(const struct photograph_question *question, struct error *error)
{
    const double distance = question->card.distance;
    return (distance > 0 && isfinite(distance)) ||
           fail(error, ERROR_DOMAIN, "the card lies %s",
                distance > 0 ? "at infinity: it needs a {distance}" : "within the lens");
}

bool photograph_take(const struct photograph_question *question, struct arena *arena,
                     struct photograph *photograph, struct error *error)
{
    struct lens_film film;
    if (!check_card(question, error) || !lens_film_open(&question->film, arena, &film, error)) {
        return false;
    }
    *photograph = (struct photograph){.image = {.width = question->columns,
                                                .height = question->rows,
                                                .channels = PHOTOGRAPH_CHANNELS},
                                      .card = question->card,
                                      .largest = film.region.largest,
                                      .corner = film.corner};
    const size_t wavelengths = question->film.setup->wavelength_count;
    const double n = film.region.index / film.systems[0]->index_last;
    struct work work = {.question = question,
                        .film = &film,
                        .card = question->card,
                        .image = &photograph->image,
                        .scale = n * n,
                        .passes = is_alike(&film, wavelengths) ? 1 : PHOTOGRAPH_CHANNELS,
                        .tiles_across = (question->columns + ACROSS - 1) / ACROSS};
    struct room *room = room_of(arena);
    if (!size_card(&work, room, &photograph->card, error) ||
        !image_new(&photograph->image, arena, error)) {
        return false;
    }
    work.card = photograph->card;
    work.tiles = work.tiles_across * ((question->rows + DOWN - 1) / DOWN);
    photograph->axis = axis_light(&work, room);
    watch_begin(question->watch, "pixels", question->columns * question->rows);
    struct parallel *parallel = ARENA_NEW(arena, struct parallel);
    parallel->threads = question->threads;
    parallel_pieces(parallel, work.tiles, 4, take_tiles, &work);
    parallel_free(parallel);
    photograph->is_incomplete = watch_is_ended(question->watch);
    return true;
}
