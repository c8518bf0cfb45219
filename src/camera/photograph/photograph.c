/* camera/photograph/photograph.c - what there is to see, and its tiles in slices or stages. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/photograph.h"

#include "camera/photograph/metering.h"
#include "camera/photograph/tile_work.h"
#include "light/colour.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/* Of a channel, between two pauses: about a second. */
enum { SLICE_RAYS = 1 << 22 };

/* -------- which tiles -------- */

static struct tile_grid tiling_for(const struct photograph_question *question)
{
    return tiling_of(question->columns, question->rows, question->crop);
}

size_t photograph_tiles(const struct photograph_question *question)
{
    const struct tile_grid tiling = tiling_for(question);
    return tiling.across * tiling.down;
}

void photograph_tile(const struct photograph_question *question, const struct image *image,
                     size_t tile, enum tile_way way,
                     float pixels[PHOTOGRAPH_PIXELS][PHOTOGRAPH_CHANNELS])
{
    const struct tile_grid tiling = tiling_for(question);
    tiling_copy(&tiling, image, tile, way, pixels);
}

static size_t count_missing(const struct tile_work *work)
{
    size_t missing = 0;
    for (size_t i = 0; i < work->tiling.across * work->tiling.down; i++) {
        missing += work->done[i] == 0;
    }
    return missing;
}

/* -------- what the picture is of -------- */

/* The card, as large as the film sees, or as high as it is wide; or the relief that it shows. */
static bool open_card(struct tile_work *work, struct tile_scratch *scratch, struct card *card,
                      struct arena *arena, struct error *error)
{
    const struct photograph_question *question = work->question;
    const double w = question->film.width / 2, h = question->film.height / 2;
    const struct image *shape = card->picture != NULL ? card->picture : question->depths.map;
    const double proportion = shape != NULL ? image_proportion(shape) : w / h;
    if (card->width == 0) {
        const double from[3][2] = {{w, 0}, {0, h}, {w, h}};
        for (int i = 0; i < 3; i++) {
            double at[2];
            /*
             * how far out on the card a point of the film looks, through the middle of what is
             * clear, mm
             */
            lens_film_chief(work->rays.film, from[i], &scratch->samples, &scratch->rays);
            if (!subject_meets(scratch->rays.blocks, 0, work->question->card.distance, at)) {
                at[0] = at[1] = 0;
            }
            const double needed = 2 * fmax(fabs(at[0]), proportion * fabs(at[1]));
            card->width = fmax(card->width, needed);
        }
    }
    card->height = card->height == 0 ? card->width / proportion : card->height;
    if (!(card->width > 0 && isfinite(card->width))) {
        fail(error, ERROR_DOMAIN,
             "how much of the card at %.6g mm the film sees is not known: no ray from its borders "
             "passes the middle of the pupil to it",
             card->distance);
        return error_hint(error, "give {field width}");
    }
    const struct setup *setup = question->film.setup;
    if (question->depths.map == NULL) {
        work->rays.subject = subject_card(card);
        return true;
    }
    struct depth_card *relief = ARENA_NEW(arena, struct depth_card);
    work->rays.subject = subject_relief(relief);
    const struct depth_card_question asked = {.depths = question->depths.map,
                                              .name = question->depths.name,
                                              .hidden = question->depths.hidden,
                                              .card = *card,
                                              .is_endless = question->card.width == 0,
                                              .sensor = setup->first.length + setup->image,
                                              .pupil = setup->first.entrance_pupil,
                                              .radius = fabs(setup->first.entrance_diameter) / 2};
    return depth_card_open(&asked, arena, relief, error);
}

/* What need not be traced; a table of light costs less than a hundredth of the picture. */
static void open_reuse(struct tile_work *work, const struct card *card, struct arena *arena)
{
    const struct photograph_question *question = work->question;
    const struct view *view = question->view;
    const unsigned none = 1U << SKIP_UNIFORM | (view == NULL ? 1U << SKIP_BLUR : 0);
    const size_t rays = question->columns * question->rows * question->samples;
    if (question->samples < TILE_FEW_SAMPLES || (question->kept & none) == none ||
        work->stages != NULL) {
        return;
    }
    struct ray_reuse *reuse = ARENA_NEW(arena, struct ray_reuse);
    *reuse = (struct ray_reuse){.film = work->rays.film,
                                .card = card,
                                .relief = work->rays.subject.relief,
                                .view = view,
                                .passes = work->rays.passes,
                                .pass = work->rays.pass,
                                .kept = question->kept,
                                .watch = question->watch};
    if (view != NULL) {
        reuse->backdrop = backdrop_open(view->path->world, view->path->lights);
        /* are there tiles of a scene that are worth looking for? */
        const struct backdrop *backdrop = &reuse->backdrop;
        enum { FEW_RAYS = 1 << 18 };
        if (tile_rays_in_bands(&work->rays) || scene_place_moves(&work->question->view->camera) ||
            backdrop->has_views || (!backdrop->is_dark && rays < FEW_RAYS)) {
            return;
        }
    }
    /* an error is one of all tiles' rays */
    reuse->kept |= question->error > 0 ? 1U << SKIP_BLUR : 0;
    work->reuse = reuse;
    ray_reuse_open(reuse, rays > 1U << 22 ? 32 : 8, arena);
}

double photograph_share(const struct photograph *photograph, enum depth_card_sight sight)
{
    double all = 0;
    for (int i = 0; i < DEPTH_CARD_SIGHTS; i++) {
        all += (double)photograph->counts[i];
    }
    return all > 0 ? (double)photograph->counts[sight] / all : 0;
}

static size_t photograph_most_of(size_t a, size_t b)
{
    return a > b ? a : b;
}

/* What all threads have counted so far. */
static void read_counts(const struct tile_work *work, struct photograph *photograph)
{
    for (int i = 0; i < PHOTOGRAPH_COUNTS; i++) {
        photograph->counts[i] = atomic_load(&work->counts[i]);
    }
}

/* Stage after stage, until all tiles are done or the time is over. */
static void take_stages(struct tile_work *work, struct arena *arena, struct photograph *photograph)
{
    const struct photograph_question *question = work->question;
    const size_t tiles = work->tiling.across * work->tiling.down;
    struct parallel *parallel = arena_array(arena, 1, sizeof *parallel);
    parallel->threads = question->threads;
    for (size_t n = 0; n < question->samples && !watch_is_ended(question->watch);
         n = n > 0 ? 2 * n : CONVERGENCE_LEAST) {
        work->is_timed = n > 0;
        if (n == 0 || !question->is_over(question->clock)) {
            parallel_pieces(parallel, tiles, 4, tile_work_take, work);
        }
    }
    parallel_free(parallel);
    read_counts(work, photograph);
    photograph->reached[0] = question->samples;
    for (size_t i = 0; i < tiles; i++) {
        const struct tile_stage *stage = &work->stages[i];
        if (stage->samples > 0) { /* it is lit */
            const size_t least = photograph->reached[0], reached = stage->samples;
            photograph->reached[0] = least < reached ? least : reached;
            photograph->reached[1] = photograph_most_of(photograph->reached[1], stage->samples);
        }
        if (stage->samples > CONVERGENCE_LEAST && question->error > 0) {
            convergence_add(photograph->counts + PHOTOGRAPH_CONVERGENCE, stage->error,
                            stage->samples);
        }
    }
}

/* All tiles that are wanted, in slices where somebody wants to see how far they are. */
static void take_all(struct tile_work *work, struct arena *arena, struct photograph *photograph)
{
    const struct photograph_question *question = work->question;
    const size_t tiles = work->tiling.across * work->tiling.down;
    struct parallel *parallel = arena_array(arena, 1, sizeof *parallel);
    const size_t of_rays = SLICE_RAYS / (TILE_PIXELS * question->samples);
    const size_t least = 4 * (size_t)(question->threads > 1 ? question->threads : 1);
    const size_t slice = question->pause == NULL ? tiles : photograph_most_of(of_rays, least);
    parallel->threads = question->threads;
    for (; work->first < tiles && !watch_is_ended(question->watch); work->first += slice) {
        const size_t left = tiles - work->first;
        parallel_pieces(parallel, left < slice ? left : slice, 4, tile_work_take, work);
        read_counts(work, photograph);
        if (question->pause != NULL) {
            question->pause(question->pauser, photograph);
        }
    }
    parallel_free(parallel);
}

/* What there is to see, and what an error is of. */
static bool open_scene(struct tile_work *work, struct tile_scratch *scratch, struct arena *arena,
                       struct photograph *photograph, struct error *error)
{
    static const double least = 1e-300; /* of what is divided by */
    const struct photograph_question *question = work->question;
    work->rays.subject = subject_scene(question->view);
    const struct metering_question metering = {&work->rays, question->film.width,
                                               question->film.height, work->scale};
    struct metered metered;
    metering_take(&metering, arena, scratch, &metered);
    memcpy(photograph->mean, metered.mean, sizeof metered.mean);
    photograph->mean_error = metered.error;
    photograph->is_metered_directly = metered.is_direct;
    const double white = isnan(question->white)
                             ? question->white_of_mean * colour_luminance(photograph->mean)
                             : question->white;
    work->goal = (struct convergence_goal){question->error, fmax(white / work->scale, least)};
    struct light_paths *light = ARENA_NEW(arena, struct light_paths);
    if (!light_paths_open(question, &work->rays, scratch, arena, light, error)) {
        return false;
    }
    if (light->count > 0) {
        work->light = light;
        light_paths_send(question, &work->rays, arena, light);
        photograph->lamps = light->count;
        photograph->lamp_rays = light->blocks * RAYS_BLOCK;
        work->rays.subject = subject_scene(&light->view);
    }
    if (question->error > 0) {
        work->small = small_emitters_open(work->rays.subject.view, arena);
    }
    return true;
}

bool photograph_take(const struct photograph_question *question, struct arena *arena,
                     struct photograph *photograph, struct error *error)
{
    const double distance = question->card.distance;
    struct lens_film film;
    if (question->view == NULL && !(distance > 0 && isfinite(distance))) {
        return fail(error, ERROR_DOMAIN, "the card lies %s",
                    distance > 0 ? "at infinity: it needs a {distance}" : "within the lens");
    }
    if (!lens_film_open(&question->film, arena, &film, error)) {
        return false;
    }
    const struct tile_grid tiling = tiling_for(question);
    const size_t tiles = tiling.across * tiling.down;
    *photograph = (struct photograph){.image = {.width = tiling.crop.width,
                                                .height = tiling.crop.height,
                                                .channels = PHOTOGRAPH_CHANNELS},
                                      .card = question->card,
                                      .largest = film.lit,
                                      .corner = film.corner};
    const double n = film.region.index / film.models[0].system->index_last;
    struct tile_work work = {.question = question,
                             .tiling = tiling,
                             .image = &photograph->image,
                             .counts = ARENA_ARRAY(arena, PHOTOGRAPH_COUNTS, atomic_ullong),
                             .scale = n * n};
    tile_rays_open(question, &film, arena, &work.rays);
    photograph->passes = work.rays.passes;
    if (question->is_over != NULL) {
        work.stages = ARENA_ARRAY(arena, tiles, struct tile_stage);
    }
    struct tile_scratch *scratch = tile_scratch_new(work.rays.passes, arena);
    if (question->view != NULL) {
        if (!open_scene(&work, scratch, arena, photograph, error)) {
            return false;
        }
    } else if (!open_card(&work, scratch, &photograph->card, arena, error)) {
        return false;
    }
    open_reuse(&work, &photograph->card, arena);
    if (!image_new(&photograph->image, arena, error)) {
        return false;
    }
    work.done = question->done != NULL ? question->done : ARENA_ARRAY(arena, tiles, unsigned char);
    /* where the film has a pupil, which its pole has */
    enum { BLOCKS = 256 };
    const double *at = work.rays.film->region.pole;
    photograph->reference = work.scale * tile_rays_light(&work.rays, at, BLOCKS, scratch);
    memcpy(photograph->reference_at, at, sizeof photograph->reference_at);
    if (!(photograph->reference > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "the film takes no light at %.4g mm from its middle, where white is measured",
                    hypot(at[0], at[1]));
    }
    work.unit = work.scale / (photograph->reference * question->error);
    watch_begin(question->watch, "pixels", TILE_PIXELS * count_missing(&work));
    if (work.stages != NULL) {
        take_stages(&work, arena, photograph);
    } else {
        take_all(&work, arena, photograph);
    }
    photograph->is_incomplete = count_missing(&work) > 0;
    return true;
}
