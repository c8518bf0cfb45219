/* camera/photograph/tile_work.c - rays of a tile until they are enough, or the time is over. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tile_work.h"

#include <math.h>
#include <string.h>

/* Blocks of rays until somebody may end them: 0.2 to 20 ms. */
enum { ENDED_EVERY = 8 };

/* What one thread works in. */
struct tile_work_scratch {
    struct tile_scratch *tile;
    double half[TILE_PIXELS][TILE_CHANNELS];
    double lamps[TILE_PIXELS][TILE_CHANNELS];      /* what these add to the means, lx/scale */
    double half_lamps[TILE_PIXELS][TILE_CHANNELS]; /* what half of their rays says of that */
    struct ray_reuse_scratch *reuse;
};

/* -------- rays of a tile -------- */

/* As tile_rays_sum; false: it is over, and the sums are of some of them. */
static bool sum(const struct tile_work *work, const struct film_plan *plan, size_t begin,
                size_t end, struct tile_work_scratch *scratch)
{
    for (size_t i = begin; i < end; i += ENDED_EVERY) {
        /* is the picture to end here? */
        const struct photograph_question *question = work->question;
        if (i > begin && (!watch_ask(question->watch) ||
                          (work->is_timed && question->is_over(question->clock)))) {
            return false;
        }
        const size_t last = i + ENDED_EVERY < end ? i + ENDED_EVERY : end;
        tile_rays_sum(&work->rays, plan, i, last, scratch->tile);
    }
    return true;
}

/* What lamps add to the pixels of a tile by rays of their own, in the unit of means of sums. */
static void tile_work_lamps(const struct tile_work *work, size_t tile,
                            double (*of)(const struct light_paths *, size_t, size_t),
                            double lamps[TILE_PIXELS][TILE_CHANNELS])
{
    const struct image_area *crop = &work->tiling.crop;
    size_t column, row;
    tiling_begin(&work->tiling, tile, &column, &row);
    memset(lamps, 0, sizeof(double[TILE_PIXELS][TILE_CHANNELS]));
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        const size_t x = column + i % TILE_ACROSS - crop->left;
        const size_t y = row + i / TILE_ACROSS - crop->top;
        for (size_t k = 0; k < TILE_CHANNELS && x < crop->width && y < crop->height; k++) {
            lamps[i][k] = of(work->light, y * crop->width + x, k) / work->scale;
        }
    }
}

/*
 * How far the halves of a tile are from each other, as a multiple of the error asked for.
 *
 * Given     lamps  that the first half has: all of the light of lamps leaves the error of the other
 *                  rays alone, of which more may help
 */
static double tile_work_error_of(const struct tile_work *work, struct tile_work_scratch *scratch,
                                 double samples, double (*lamps)[TILE_CHANNELS])
{
    enum { COUNT = TILE_PIXELS * TILE_CHANNELS };
    const double *first = (const double *)scratch->half;
    const double *both = (const double *)scratch->tile->sums;
    double first_lit[COUNT], both_lit[COUNT];
    if (work->light != NULL) {
        for (size_t i = 0; i < COUNT; i++) {
            const size_t pixel = i / TILE_CHANNELS, k = i % TILE_CHANNELS;
            first_lit[i] = first[i] + samples * lamps[pixel][k];
            both_lit[i] = both[i] + 2 * samples * scratch->lamps[pixel][k];
        }
        first = first_lit;
        both = both_lit;
    }
    return work->question->view != NULL
               ? convergence_relative(&work->goal, first, both, COUNT, samples)
               : work->unit * convergence_halves(first, both, COUNT, samples);
}

/* What a tile comes to; it is taken already if that needs none of its rays. */
static enum ray_reuse_way work_way_of(const struct tile_work *work, const struct film_plan *plan,
                                      struct tile_work_scratch *scratch)
{
    struct tile_scratch *tile = scratch->tile;
    const size_t samples = work->question->samples;
    enum ray_reuse_way way = RAY_REUSE_TRACED;
    if (work->reuse != NULL) {
        way = ray_reuse_take(work->reuse, plan, samples, scratch->reuse, tile->counts, tile->sums);
    }
    return way == RAY_REUSE_TRACED && samples >= TILE_FEW_SAMPLES &&
                   tile_colours_share(&work->rays, plan, tile)
               ? RAY_REUSE_SHARED
               : way;
}

/* All samples of a tile, by its place in the frame; returns how many, 0: it is over before. */
static size_t sum_tile(const struct tile_work *work, struct film_plan *plan, size_t tile,
                       struct tile_stage *stage, struct tile_work_scratch *scratch)
{
    const struct photograph_question *question = work->question;
    tile_rays_begin(&work->rays, tile, plan, scratch->tile);
    const enum ray_reuse_way way = work_way_of(work, plan, scratch);
    if (way == RAY_REUSE_ENDED) {
        return 0;
    }
    scratch->tile->counts[PHOTOGRAPH_WAYS + way] += stage == NULL || stage->samples == 0;
    if (stage != NULL) {
        /* one stage more, from what there is */
        const size_t before = stage->samples, samples = before > 0 ? 2 * before : CONVERGENCE_LEAST;
        memcpy(scratch->tile->sums, stage->sums, sizeof stage->sums);
        memcpy(scratch->half, stage->sums, sizeof stage->sums);
        if (!sum(work, plan, before, samples, scratch)) {
            return 0;
        }
        memcpy(stage->sums, scratch->tile->sums, sizeof stage->sums);
        stage->samples = samples;
        stage->error = before > 0 && work->question->error > 0
                           ? tile_work_error_of(work, scratch, (double)before, scratch->half_lamps)
                           : INFINITY;
        return samples;
    }
    if (way == RAY_REUSE_SHARP || way == RAY_REUSE_EVEN) {
        return question->samples;
    }
    if (question->error > 0) {
        /* twice as many samples again and again, until the error is reached */
        const double least = small_emitters_samples(&work->small, &work->rays, plan, scratch->tile);
        size_t samples = CONVERGENCE_LEAST / 2;
        double error = INFINITY;
        bool is_whole = sum(work, plan, 0, samples, scratch);
        for (; is_whole && (!(error <= 1) || (double)samples < least) &&
               samples < work->question->samples;
             samples *= 2) {
            memcpy(scratch->half, scratch->tile->sums, sizeof scratch->half);
            is_whole = sum(work, plan, samples, 2 * samples, scratch);
            error = tile_work_error_of(work, scratch, (double)samples, scratch->lamps);
        }
        error = tile_work_error_of(work, scratch, (double)samples / 2, scratch->half_lamps);
        convergence_add(scratch->tile->counts + PHOTOGRAPH_CONVERGENCE, error, samples);
        return is_whole ? samples : 0;
    }
    return sum(work, plan, 0, question->samples, scratch) ? question->samples : 0;
}

/* -------- tiles -------- */

/* Tile `tile` of the crop; its points are those of its place in the frame. False: it is over
   before. */
static bool take_tile(const struct tile_work *work, size_t tile, struct tile_work_scratch *scratch)
{
    const struct tile_grid *tiling = &work->tiling;
    float pixels[TILE_PIXELS][TILE_CHANNELS];
    size_t column, row;
    tiling_begin(tiling, tile, &column, &row);
    /* the film is upside down: the upper left of the picture lies at +x, -y */
    const struct photograph_question *question = work->question;
    const double across = question->film.width / (double)question->columns;
    const double down = question->film.height / (double)question->rows;
    struct film_plan plan = {.left =
                                 question->film.width / 2 - (double)(column + TILE_ACROSS) * across,
                             .bottom = (double)row * down - question->film.height / 2,
                             .width = TILE_ACROSS * across,
                             .height = TILE_DOWN * down};
    /* does light reach any of it? */
    const double largest = work->rays.film->region.largest;
    const double x = fmax(0, fmax(plan.left, -plan.left - plan.width));
    const double y = fmax(0, fmax(plan.bottom, -plan.bottom - plan.height));
    if (!(x * x + y * y <= largest * largest)) {
        return true;
    }
    struct tile_stage *stage = work->stages != NULL ? &work->stages[tile] : NULL;
    if (work->light != NULL) {
        tile_work_lamps(work, tile, light_paths_at, scratch->lamps);
    }
    if (work->light != NULL && question->error > 0) {
        tile_work_lamps(work, tile, light_paths_half_at, scratch->half_lamps);
    }
    const size_t samples = sum_tile(
        work, &plan, row / TILE_DOWN * tiling->frame + column / TILE_ACROSS, stage, scratch);
    if (samples == 0) {
        return false;
    }
    for (size_t k = 0; k < TILE_PIXELS; k++) {
        for (size_t channel = 0; channel < TILE_CHANNELS; channel++) {
            pixels[k][channel] =
                (float)(work->scale * (scratch->tile->sums[k][channel] / (double)samples +
                                       scratch->lamps[k][channel]));
        }
    }
    tiling_copy(tiling, work->image, tile, TILE_TO_PICTURE, pixels);
    return true;
}

/* The same, of which nothing stays, nor is counted, if it is over before. */
static bool try_tile(const struct tile_work *work, size_t tile, struct tile_work_scratch *scratch)
{
    uint64_t counts[PHOTOGRAPH_COUNTS];
    memcpy(counts, scratch->tile->counts, sizeof counts);
    const bool is_whole = take_tile(work, tile, scratch);
    if (!is_whole) {
        memcpy(scratch->tile->counts, counts, sizeof counts);
    }
    return is_whole;
}

/* Is there time for another stage of a tile that has had one? */
static bool tile_work_goes_on(const struct tile_work *work, size_t tile)
{
    const struct photograph_question *question = work->question;
    const struct tile_stage *stage = work->stages != NULL ? &work->stages[tile] : NULL;
    return stage != NULL && stage->samples > 0 && stage->samples < question->samples &&
           !(stage->error <= 1) && !question->is_over(question->clock);
}

void tile_work_take(void *context, const struct parallel_piece *piece)
{
    const struct tile_work *work = context;
    struct watch *watch = work->question->watch;
    const struct arena_mark mark = arena_mark(piece->arena);
    const size_t passes = work->rays.passes;
    struct arena *arena = piece->arena;
    struct tile_work_scratch *scratch = ARENA_NEW(arena, struct tile_work_scratch);
    scratch->tile = tile_scratch_new(passes, arena);
    scratch->reuse = ray_reuse_scratch_new(passes, arena);
    for (size_t i = piece->begin; i < piece->end && !watch_is_ended(watch); i++) {
        const size_t tile = work->first + i;
        if (work->done[tile] == 0) {
            if (try_tile(work, tile, scratch)) {
                work->done[tile] = 1;
                watch_add(watch, TILE_PIXELS);
            }
        } else if (tile_work_goes_on(work, tile)) {
            try_tile(work, tile, scratch);
        }
    }
    for (int i = 0; i < PHOTOGRAPH_COUNTS; i++) {
        atomic_fetch_add(&work->counts[i], scratch->tile->counts[i]);
    }
    arena_reset(piece->arena, mark);
}
