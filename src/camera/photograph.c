/* camera/photograph.c - tiles of a film, each with its own points, in any order. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph.h"

#include "base/parallel.h"
#include "camera/lens_film.h"
#include "camera/metering.h"
#include "camera/tile_rays.h"
#include "light/colour.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

enum { ACROSS = TILE_ACROSS, DOWN = TILE_DOWN, PIXELS = TILE_PIXELS };
/* Of a channel, between two pauses: about a second. */
enum { SLICE_RAYS = 1 << 22 };
/* Blocks of rays until somebody may end them: 0.2 to 20 ms. */
enum { ENDED_EVERY = 8 };
/* Rays of a pixel that pay for a look at what need not be traced. */
enum { FEW_SAMPLES = 8 };

struct work {
    const struct photograph_question *question;
    const struct lens_film *film;
    struct card card;
    struct tile_rays rays;
    struct image *image;
    unsigned char *done; /* of each tile */
    size_t first;        /* tile of the slice that is taken */
    struct arena *arena;
    atomic_ullong *counts;        /* PHOTOGRAPH_COUNTS of them */
    const struct spare *spare;    /* null: all is traced */
    double unit;                  /* of means, in errors that are asked for */
    double scale;                 /* (n'/n)^2, n of the scene */
    struct convergence_goal goal; /* of scenes */
    struct stage *stages;         /* of tiles, where somebody waits; else null */
    bool is_timed;                /* all tiles have had the first of them */
};

/* How far a tile has come. */
struct stage {
    double sums[PIXELS][PHOTOGRAPH_CHANNELS];
    double error; /* as a multiple of the one asked for */
    size_t samples;
};

/* What one thread works in. */
struct room {
    struct tile_room *tile;
    double half[PIXELS][PHOTOGRAPH_CHANNELS];
    struct spare_room *spare;
};

static struct room *room_of(size_t passes, struct arena *arena)
{
    struct room *room = ARENA_NEW(arena, struct room);
    room->tile = tile_room_new(passes, arena);
    room->spare = spare_room_new(passes, arena);
    return room;
}

static size_t least_of(size_t a, size_t b)
{
    return a < b ? a : b;
}

static size_t most_of(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* -------- which tiles -------- */

static struct tiling tiling_for(const struct photograph_question *question)
{
    return tiling_of(question->columns, question->rows, question->crop);
}

size_t photograph_tiles(const struct photograph_question *question)
{
    const struct tiling tiling = tiling_for(question);
    return tiling.across * tiling.down;
}

void photograph_tile(const struct photograph_question *question, const struct image *image,
                     size_t tile, enum tile_way way,
                     float pixels[PHOTOGRAPH_PIXELS][PHOTOGRAPH_CHANNELS])
{
    const struct tiling tiling = tiling_for(question);
    tiling_copy(&tiling, image, tile, way, pixels);
}

/* -------- a tile -------- */

/* The film is upside down: the upper left of the picture lies at +x, -y. */
static struct film_plan plan_of(const struct work *work, size_t column, size_t row)
{
    const struct photograph_question *question = work->question;
    const double across = question->film.width / (double)question->columns;
    const double down = question->film.height / (double)question->rows;
    return (struct film_plan){.left = question->film.width / 2 - (double)(column + ACROSS) * across,
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

/* Is the picture to end here? */
static bool is_over(const struct work *work)
{
    const struct photograph_question *question = work->question;
    return !watch_ask(question->watch) || (work->is_timed && question->is_over(question->clock));
}

/* As tile_rays_sum; false: it is over, and the sums are of some of them. */
static bool sum(const struct work *work, const struct film_plan *plan, size_t begin, size_t end,
                struct room *room)
{
    for (size_t i = begin; i < end; i += ENDED_EVERY) {
        if (i > begin && is_over(work)) {
            return false;
        }
        tile_rays_sum(&work->rays, plan, i, least_of(i + ENDED_EVERY, end), room->tile);
    }
    return true;
}

/* How far the halves of a tile are from each other, as a multiple of the error asked for. */
static double error_of(const struct work *work, const struct room *room, double samples)
{
    const double *first = (const double *)room->half, *both = (const double *)room->tile->sums;
    const size_t count = PIXELS * PHOTOGRAPH_CHANNELS;
    return work->question->view != NULL
               ? convergence_relative(&work->goal, first, both, count, samples)
               : work->unit * convergence_halves(first, both, count, samples);
}

/* Twice as many samples again and again, until the error is reached; returns how many, 0: it is
   over before. */
static size_t sum_until(const struct work *work, const struct film_plan *plan, struct room *room)
{
    size_t samples = CONVERGENCE_LEAST / 2;
    double error = INFINITY;
    bool is_whole = sum(work, plan, 0, samples, room);
    for (; is_whole && error > 1 && samples < work->question->samples; samples *= 2) {
        memcpy(room->half, room->tile->sums, sizeof room->half);
        is_whole = sum(work, plan, samples, 2 * samples, room);
        error = error_of(work, room, (double)samples);
    }
    convergence_add(room->tile->counts + PHOTOGRAPH_CONVERGENCE, error, samples);
    return is_whole ? samples : 0;
}

/* One stage more, from what there is; returns how many samples there are then, 0: it is over
   before. */
static size_t sum_stage(const struct work *work, const struct film_plan *plan, struct stage *stage,
                        struct room *room)
{
    const size_t before = stage->samples, samples = before > 0 ? 2 * before : CONVERGENCE_LEAST;
    memcpy(room->tile->sums, stage->sums, sizeof stage->sums);
    memcpy(room->half, stage->sums, sizeof stage->sums);
    if (!sum(work, plan, before, samples, room)) {
        return 0;
    }
    memcpy(stage->sums, room->tile->sums, sizeof stage->sums);
    stage->samples = samples;
    stage->error =
        before > 0 && work->question->error > 0 ? error_of(work, room, (double)before) : INFINITY;
    return samples;
}

/* Has it come as far as it may? */
static bool is_last_stage(const struct work *work, const struct stage *stage)
{
    return stage->samples >= work->question->samples || stage->error <= 1;
}

/* What a tile comes to; it is taken already if that needs none of its rays. */
static enum spare_way way_of(const struct work *work, const struct film_plan *plan,
                             struct room *room)
{
    struct tile_room *tile = room->tile;
    const size_t samples = work->question->samples;
    const struct spare_tile spared = {plan, ACROSS, DOWN, samples};
    enum spare_way way = SPARE_TRACED;
    if (work->spare != NULL) {
        way = spare_take(work->spare, &spared, room->spare, tile->counts, tile->sums);
    }
    return way == SPARE_TRACED && samples >= FEW_SAMPLES && tile_rays_share(&work->rays, plan, tile)
               ? SPARE_SHARED
               : way;
}

/* All samples of a tile, by its place in the frame; returns how many, 0: it is over before. */
static size_t sum_tile(const struct work *work, struct film_plan *plan, size_t tile,
                       struct stage *stage, struct room *room)
{
    const struct photograph_question *question = work->question;
    tile_rays_begin(&work->rays, tile, plan, room->tile);
    const enum spare_way way = way_of(work, plan, room);
    if (way == SPARE_ENDED) {
        return 0;
    }
    room->tile->counts[PHOTOGRAPH_WAYS + way] += stage == NULL || stage->samples == 0;
    if (stage != NULL) {
        return sum_stage(work, plan, stage, room);
    }
    if (way == SPARE_SHARP || way == SPARE_EVEN) {
        return question->samples;
    }
    if (question->error > 0) {
        return sum_until(work, plan, room);
    }
    return sum(work, plan, 0, question->samples, room) ? question->samples : 0;
}

/* Tile `tile` of the crop; its points are those of its place in the frame. False: it is over
   before. */
static bool take_tile(const struct work *work, size_t tile, struct room *room)
{
    const struct photograph_question *question = work->question;
    const struct tiling tiling = tiling_for(question);
    float pixels[PIXELS][PHOTOGRAPH_CHANNELS];
    size_t column, row;
    tiling_begin(&tiling, tile, &column, &row);
    struct film_plan plan = plan_of(work, column, row);
    if (!is_lit(&plan, work->film->region.largest)) {
        return true;
    }
    struct stage *stage = work->stages != NULL ? &work->stages[tile] : NULL;
    const size_t samples =
        sum_tile(work, &plan, row / DOWN * tiling.frame + column / ACROSS, stage, room);
    if (samples == 0) {
        return false;
    }
    for (size_t k = 0; k < PIXELS; k++) {
        for (size_t channel = 0; channel < PHOTOGRAPH_CHANNELS; channel++) {
            pixels[k][channel] =
                (float)(work->scale * room->tile->sums[k][channel] / (double)samples);
        }
    }
    photograph_tile(question, work->image, tile, TILE_TO_PICTURE, pixels);
    return true;
}

/* The same, of which nothing stays, nor is counted, if it is over before. */
static bool try_tile(const struct work *work, size_t tile, struct room *room)
{
    uint64_t counts[PHOTOGRAPH_COUNTS];
    memcpy(counts, room->tile->counts, sizeof counts);
    const bool is_whole = take_tile(work, tile, room);
    if (!is_whole) {
        memcpy(room->tile->counts, counts, sizeof counts);
    }
    return is_whole;
}

/* Is there time for another stage of a tile that has had one? */
static bool goes_on(const struct work *work, size_t tile)
{
    const struct photograph_question *question = work->question;
    return work->stages != NULL && work->stages[tile].samples > 0 &&
           !is_last_stage(work, &work->stages[tile]) && !question->is_over(question->clock);
}

static void take_tiles(void *context, const struct parallel_piece *piece)
{
    const struct work *work = context;
    struct watch *watch = work->question->watch;
    const struct arena_mark mark = arena_mark(piece->arena);
    struct room *room = room_of(work->rays.passes, piece->arena);
    for (size_t i = piece->begin; i < piece->end && !watch_is_ended(watch); i++) {
        const size_t tile = work->first + i;
        if (work->done[tile] == 0) {
            if (try_tile(work, tile, room)) {
                work->done[tile] = 1;
                watch_add(watch, PIXELS);
            }
        } else if (goes_on(work, tile)) {
            try_tile(work, tile, room);
        }
    }
    for (int i = 0; i < PHOTOGRAPH_COUNTS; i++) {
        atomic_fetch_add(&work->counts[i], room->tile->counts[i]);
    }
    arena_reset(piece->arena, mark);
}

static size_t count_missing(const struct work *work, size_t tiles)
{
    size_t missing = 0;
    for (size_t i = 0; i < tiles; i++) {
        missing += work->done[i] == 0;
    }
    return missing;
}

/* -------- what the picture is of -------- */

/* How far out on the card a point of the film looks, through the middle of what is clear, mm. */
static void look_through(const struct work *work, const double from[2], struct room *room,
                         double at[2])
{
    lens_film_chief(work->film, from, &room->tile->samples, &room->tile->rays);
    if (!subject_meets(room->tile->rays.blocks, 0, work->card.distance, at)) {
        at[0] = at[1] = 0;
    }
}

/* As large as the film sees, or as high as it is wide. */
static bool size_card(const struct work *work, struct room *room, struct card *card,
                      struct error *error)
{
    const struct photograph_question *question = work->question;
    const double w = question->film.width / 2, h = question->film.height / 2;
    const struct image *shape = card->picture != NULL ? card->picture : question->depths.map;
    const double proportion = shape != NULL ? image_proportion(shape) : w / h;
    if (card->width == 0) {
        const double from[3][2] = {{w, 0}, {0, h}, {w, h}};
        for (int i = 0; i < 3; i++) {
            double at[2];
            look_through(work, from[i], room, at);
            const double needed = 2 * fmax(fabs(at[0]), proportion * fabs(at[1]));
            card->width = fmax(card->width, needed);
        }
    }
    card->height = card->height == 0 ? card->width / proportion : card->height;
    return (card->width > 0 && isfinite(card->width)) ||
           fail(error, ERROR_DOMAIN, "no light from the card at %.6g mm reaches the film",
                card->distance);
}

/* E/L in the middle of the film, of the first wavelength or, of many bands, a middle one. */
static double axis_light(const struct work *work, struct room *room)
{
    enum { BLOCKS = 256 };
    const struct lens_film *film = work->film;
    const struct film_plan plan = {.sobol = film->sobol, .scrambling = {1, 2, 3, 4}};
    const size_t wavelength = tile_rays_in_bands(&work->rays) ? work->rays.passes / 2 : 0;
    struct film_samples *samples = &room->tile->samples;
    struct rays *rays = &room->tile->rays;
    double sum = 0;
    for (uint32_t block = 0; block < BLOCKS; block++) {
        film_rays_plan(&plan, block, SET_BEST, samples);
        lens_film_start(film, samples, rays->blocks);
        lens_film_trace(film, wavelength, samples, rays);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            sum += rays->blocks->lost[i] == 0 ? samples->weight[i] : 0;
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

/* The card, or the relief that it shows. */
static bool open_subject(struct work *work, struct arena *arena, struct error *error)
{
    const struct photograph_question *question = work->question;
    const struct setup *setup = question->film.setup;
    if (question->depths.map == NULL) {
        work->rays.subject = subject_card(&work->card);
        return true;
    }
    struct relief *relief = ARENA_NEW(arena, struct relief);
    work->rays.subject = subject_relief(relief);
    const struct relief_question asked = {.depths = question->depths.map,
                                          .name = question->depths.name,
                                          .hidden = question->depths.hidden,
                                          .card = work->card,
                                          .is_endless = question->card.width == 0,
                                          .sensor = setup->first.length + setup->image,
                                          .pupil = setup->first.entrance_pupil,
                                          .radius = fabs(setup->first.entrance_diameter) / 2};
    return relief_open(&asked, arena, relief, error);
}

/* Are there tiles of a scene that are worth looking for? */
static bool may_see_backdrop(const struct work *work, const struct backdrop *backdrop, size_t rays)
{
    enum { FEW_RAYS = 1 << 18 };
    return !tile_rays_in_bands(&work->rays) && !scene_place_moves(&work->question->view->camera) &&
           !backdrop->has_views && (backdrop->is_dark || rays >= FEW_RAYS);
}

/* What need not be traced; a table of light costs less than a hundredth of the picture. */
static void open_spare(struct work *work, struct arena *arena)
{
    const struct photograph_question *question = work->question;
    const struct view *view = question->view;
    const unsigned none = 1U << SKIP_UNIFORM | (view == NULL ? 1U << SKIP_BLUR : 0);
    const size_t rays = question->columns * question->rows * question->samples;
    if (question->samples < FEW_SAMPLES || (question->kept & none) == none ||
        work->stages != NULL) {
        return;
    }
    struct spare *spare = ARENA_NEW(arena, struct spare);
    *spare = (struct spare){.film = work->film,
                            .card = &work->card,
                            .relief = work->rays.subject.relief,
                            .view = view,
                            .passes = work->rays.passes,
                            .pass = work->rays.pass,
                            .kept = question->kept,
                            .watch = question->watch};
    if (view != NULL) {
        spare->backdrop = backdrop_open(view->path->world, view->path->lights);
        if (!may_see_backdrop(work, &spare->backdrop, rays)) {
            return;
        }
    }
    /* an error is one of all tiles' rays */
    spare->kept |= question->error > 0 ? 1U << SKIP_BLUR : 0;
    work->spare = spare;
    spare_open(spare, rays > 1U << 22 ? 32 : 8, arena);
}

double photograph_luminance(const double light[PHOTOGRAPH_CHANNELS])
{
    const struct colour rgb = {{light[0], light[1], light[2]}};
    return colour_turned(&colour_xyz_of_srgb, rgb).part[1];
}

double photograph_share(const struct photograph *photograph, enum relief_sight sight)
{
    double all = 0;
    for (int i = 0; i < RELIEF_SIGHTS; i++) {
        all += (double)photograph->counts[i];
    }
    return all > 0 ? (double)photograph->counts[sight] / all : 0;
}

/* Stage after stage, until all tiles are done or the time is over. */
static void take_stages(struct work *work, size_t tiles, struct photograph *photograph)
{
    const struct photograph_question *question = work->question;
    struct parallel *parallel = arena_array(work->arena, 1, sizeof *parallel);
    parallel->threads = question->threads;
    for (size_t n = 0; n < question->samples && !watch_is_ended(question->watch);
         n = n > 0 ? 2 * n : CONVERGENCE_LEAST) {
        work->is_timed = n > 0;
        if (n == 0 || !question->is_over(question->clock)) {
            parallel_pieces(parallel, tiles, 4, take_tiles, work);
        }
    }
    parallel_free(parallel);
    for (int i = 0; i < PHOTOGRAPH_COUNTS; i++) {
        photograph->counts[i] = atomic_load(&work->counts[i]);
    }
    photograph->reached[0] = question->samples;
    for (size_t i = 0; i < tiles; i++) {
        const struct stage *stage = &work->stages[i];
        if (stage->samples > 0) { /* it is lit */
            photograph->reached[0] = least_of(photograph->reached[0], stage->samples);
            photograph->reached[1] = most_of(photograph->reached[1], stage->samples);
        }
        if (stage->samples > CONVERGENCE_LEAST && question->error > 0) {
            convergence_add(photograph->counts + PHOTOGRAPH_CONVERGENCE, stage->error,
                            stage->samples);
        }
    }
}

/* All tiles that are wanted, in slices where somebody wants to see how far they are. */
static void take_all(struct work *work, size_t tiles, struct photograph *photograph)
{
    const struct photograph_question *question = work->question;
    struct parallel *parallel = arena_array(work->arena, 1, sizeof *parallel);
    const size_t of_rays = SLICE_RAYS / (PIXELS * question->samples);
    const size_t least = 4 * (size_t)(question->threads > 1 ? question->threads : 1);
    const size_t slice = question->pause == NULL ? tiles : of_rays > least ? of_rays : least;
    parallel->threads = question->threads;
    for (; work->first < tiles && !watch_is_ended(question->watch); work->first += slice) {
        const size_t left = tiles - work->first;
        parallel_pieces(parallel, left < slice ? left : slice, 4, take_tiles, work);
        for (int i = 0; i < PHOTOGRAPH_COUNTS; i++) {
            photograph->counts[i] = atomic_load(&work->counts[i]);
        }
        if (question->pause != NULL) {
            question->pause(question->pauser, photograph);
        }
    }
    parallel_free(parallel);
}

/* What there is to see, and what an error is of. */
static void open_scene(struct work *work, struct room *room, struct photograph *photograph)
{
    static const double least = 1e-300; /* of what is divided by */
    const struct photograph_question *question = work->question;
    work->rays.subject = subject_scene(question->view);
    const struct metering_question metering = {&work->rays, question->film.width,
                                               question->film.height, work->scale};
    struct metered metered;
    metering_take(&metering, work->arena, room->tile, &metered);
    memcpy(photograph->mean, metered.mean, sizeof metered.mean);
    photograph->mean_error = metered.error;
    const double white = isnan(question->white)
                             ? question->white_of_mean * photograph_luminance(photograph->mean)
                             : question->white;
    work->goal = (struct convergence_goal){question->error, fmax(white / work->scale, least)};
    open_spare(work, work->arena);
}

static bool open_card(struct work *work, struct room *room, struct photograph *photograph,
                      struct error *error)
{
    if (!size_card(work, room, &photograph->card, error)) {
        return false;
    }
    work->card = photograph->card;
    if (!open_subject(work, work->arena, error)) {
        return false;
    }
    open_spare(work, work->arena);
    return true;
}

bool photograph_take(const struct photograph_question *question, struct arena *arena,
                     struct photograph *photograph, struct error *error)
{
    struct lens_film film;
    if ((question->view == NULL && !check_card(question, error)) ||
        !lens_film_open(&question->film, arena, &film, error)) {
        return false;
    }
    const struct tiling tiling = tiling_for(question);
    const size_t tiles = tiling.across * tiling.down;
    *photograph = (struct photograph){.image = {.width = tiling.crop.width,
                                                .height = tiling.crop.height,
                                                .channels = PHOTOGRAPH_CHANNELS},
                                      .card = question->card,
                                      .largest = film.lit,
                                      .corner = film.corner};
    const double n = film.region.index / film.systems[0]->index_last;
    struct work work = {.question = question,
                        .film = &film,
                        .card = question->card,
                        .image = &photograph->image,
                        .arena = arena,
                        .counts = ARENA_ARRAY(arena, PHOTOGRAPH_COUNTS, atomic_ullong),
                        .scale = n * n};
    tile_rays_open(question, &film, arena, &work.rays);
    photograph->passes = work.rays.passes;
    if (question->is_over != NULL) {
        work.stages = ARENA_ARRAY(arena, tiles, struct stage);
    }
    struct room *room = room_of(work.rays.passes, arena);
    if (question->view != NULL) {
        open_scene(&work, room, photograph);
    } else if (!open_card(&work, room, photograph, error)) {
        return false;
    }
    if (!image_new(&photograph->image, arena, error)) {
        return false;
    }
    work.done = question->done != NULL ? question->done : ARENA_ARRAY(arena, tiles, unsigned char);
    photograph->axis = axis_light(&work, room);
    work.unit = work.scale / (photograph->axis * question->error);
    watch_begin(question->watch, "pixels", PIXELS * count_missing(&work, tiles));
    (work.stages != NULL ? take_stages : take_all)(&work, tiles, photograph);
    photograph->is_incomplete = count_missing(&work, tiles) > 0;
    return true;
}
