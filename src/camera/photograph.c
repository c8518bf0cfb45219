/* camera/photograph.c - tiles of a film, each with its own points, in any order. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph.h"

#include "base/parallel.h"
#include "camera/lens_film.h"
#include "camera/subject.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

enum { ACROSS = PHOTOGRAPH_ACROSS, DOWN = PHOTOGRAPH_DOWN, PIXELS = PHOTOGRAPH_PIXELS };
/* Of a channel, between two pauses: about a second. */
enum { SLICE_RAYS = 1 << 22 };
_Static_assert(PIXELS == (int)RAYS_BLOCK, "a block of points for a tile");

struct work {
    const struct photograph_question *question;
    const struct lens_film *film;
    struct card card;
    struct subject subject;
    struct image *image;
    unsigned char *done; /* of each tile */
    size_t first;        /* tile of the slice that is taken */
    struct arena *arena;
    atomic_ullong *counts;     /* PHOTOGRAPH_COUNTS of them */
    const struct spare *spare; /* null: all is traced */
    double unit;               /* of means, in errors that are asked for */
    double scale;              /* (n'/n)^2, n of the scene */
    size_t passes;             /* one a wavelength, or one for all where nothing disperses */
    const struct spare_pass *pass;
    struct sobol when; /* the dimension after those of the film */
};

/* What one thread traces in. */
struct room {
    struct film_samples samples;
    struct rays rays;
    subject_light light;
    double times[RAYS_BLOCK]; /* when each ray comes, s; all 0 where nothing needs it */
    uint32_t when;            /* the tile's scrambling of them */
    double sums[PIXELS][PHOTOGRAPH_CHANNELS], half[PIXELS][PHOTOGRAPH_CHANNELS];
    uint64_t counts[PHOTOGRAPH_COUNTS];
    struct spare_room *spare;
};

static struct room *room_of(size_t passes, struct arena *arena)
{
    struct room *room = ARENA_NEW(arena, struct room);
    room->rays = rays_new(arena, RAYS_BLOCK);
    room->spare = spare_room_new(passes, arena);
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

/* What the wavelengths of the question are for. */
static const struct spare_pass *passes_of(const struct photograph_question *question, size_t passes,
                                          struct arena *arena)
{
    const struct setup *setup = question->film.setup;
    const size_t parts = question->is_coloured && passes > 1 ? PHOTOGRAPH_CHANNELS : 1;
    const size_t waves = passes / parts, channels = PHOTOGRAPH_CHANNELS / parts;
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

/* Start and trace block `block` of a plan. */
static void trace_plan(const struct lens_film *film, const struct film_plan *plan, uint32_t block,
                       size_t wavelength, struct room *room)
{
    film_rays_plan(plan, block, SET_BEST, &room->samples);
    lens_film_start(film, &room->samples, room->rays.blocks);
    lens_film_trace(film, wavelength, &room->samples, &room->rays);
}

/* When the rays of a block come: evenly within the time that each has, the middle of all at 0. */
static void time_rays(const struct work *work, uint32_t block, struct room *room)
{
    const double duration = work->question->duration;
    if (duration > 0) {
        sobol_points(&work->when, room->when, block, room->times);
        const double *begin = room->samples.begin, *end = room->samples.end;
        const bool is_shut = work->film->shutter != NULL;
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            room->times[i] = is_shut ? begin[i] + room->times[i] * (end[i] - begin[i])
                                     : duration * (room->times[i] - 0.5);
        }
    }
}

/* -------- which tiles -------- */

/* Of the frame, those that the crop lies in. */
struct tiling {
    struct image_area crop;
    size_t frame;     /* tiles across the frame */
    size_t left, top; /* the first one's column and row among them */
    size_t across, down;
};

static struct tiling tiling_of(const struct photograph_question *question)
{
    struct tiling tiling = {.crop = question->crop,
                            .frame = (question->columns + ACROSS - 1) / ACROSS};
    if (tiling.crop.width == 0) {
        tiling.crop = (struct image_area){0, 0, question->columns, question->rows};
    }
    const struct image_area *crop = &tiling.crop;
    tiling.left = crop->left / ACROSS;
    tiling.top = crop->top / DOWN;
    tiling.across = (crop->left + crop->width + ACROSS - 1) / ACROSS - tiling.left;
    tiling.down = (crop->top + crop->height + DOWN - 1) / DOWN - tiling.top;
    return tiling;
}

size_t photograph_tiles(const struct photograph_question *question)
{
    const struct tiling tiling = tiling_of(question);
    return tiling.across * tiling.down;
}

/* Where a tile of the crop begins in the frame: column and row of pixels. */
static void begin_of(const struct tiling *tiling, size_t tile, size_t *column, size_t *row)
{
    *column = (tiling->left + tile % tiling->across) * ACROSS;
    *row = (tiling->top + tile / tiling->across) * DOWN;
}

void photograph_tile(const struct photograph_question *question, const struct image *image,
                     size_t tile, enum photograph_way way,
                     float pixels[PHOTOGRAPH_PIXELS][PHOTOGRAPH_CHANNELS])
{
    const struct tiling tiling = tiling_of(question);
    const struct image_area *crop = &tiling.crop;
    size_t column, row;
    begin_of(&tiling, tile, &column, &row);
    for (size_t k = 0; k < PIXELS; k++) {
        const size_t x = column + k % ACROSS, y = row + k / ACROSS;
        const bool is_within = x >= crop->left && x < crop->left + crop->width && y >= crop->top &&
                               y < crop->top + crop->height;
        float *in_picture =
            is_within ? image_row(image, y - crop->top) + (x - crop->left) * PHOTOGRAPH_CHANNELS
                      : NULL;
        for (size_t channel = 0; channel < PHOTOGRAPH_CHANNELS; channel++) {
            if (way == TILE_FROM_PICTURE) {
                pixels[k][channel] = is_within ? in_picture[channel] : 0;
            } else if (is_within) {
                in_picture[channel] = pixels[k][channel];
            }
        }
    }
}

/* -------- a tile -------- */

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
static void add_ray(const struct film_plan *plan, const struct spare_pass *pass, size_t i,
                    struct room *room)
{
    const struct film_samples *samples = &room->samples;
    const double across = (samples->x[i] - plan->left) / plan->width * ACROSS;
    const double down = (samples->y[i] - plan->bottom) / plan->height * DOWN;
    const size_t column = (size_t)fmin(across, ACROSS - 1), row = (size_t)fmin(down, DOWN - 1);
    double *sums = room->sums[row * ACROSS + (ACROSS - 1 - column)];
    const double *light = room->light[i];
    const bool is_sent = samples->weight[i] > 0; /* from a lit place, and taken by the pixel */
    room->counts[PHOTOGRAPH_TRACED] += is_sent;
    room->counts[PHOTOGRAPH_PASSED] += is_sent && room->rays.blocks->lost[i] == 0;
    for (size_t channel = pass->begin; channel < pass->end; channel++) {
        sums[channel] += pass->share * samples->weight[i] * light[channel];
    }
}

/* Sums of weights times light, a pixel and channel each: blocks of points more. */
static void sum_blocks(const struct work *work, const struct film_plan *plan, size_t begin,
                       size_t end, struct room *room)
{
    /* the same points for all channels: what is left of noise is grey */
    for (size_t pass = 0; pass < work->passes; pass++) {
        for (uint32_t block = (uint32_t)begin; block < end; block++) {
            trace_plan(work->film, plan, block, pass, room);
            time_rays(work, block, room);
            const struct subject_rays rays = {room->rays.blocks, room->samples.weight, room->times};
            work->subject.look(&work->subject, &rays, room->counts, room->light);
            for (size_t i = 0; i < RAYS_BLOCK; i++) {
                add_ray(plan, &work->pass[pass], i, room);
            }
        }
    }
}

/* Twice as many samples again and again, until the error is reached; returns how many. */
static size_t sum_until(const struct work *work, const struct film_plan *plan, struct room *room)
{
    size_t samples = CONVERGENCE_LEAST / 2;
    double error = INFINITY;
    sum_blocks(work, plan, 0, samples, room);
    for (; error > 1 && samples < work->question->samples; samples *= 2) {
        memcpy(room->half, room->sums, sizeof room->half);
        sum_blocks(work, plan, samples, 2 * samples, room);
        error =
            work->unit * convergence_halves((const double *)room->half, (const double *)room->sums,
                                            PIXELS * PHOTOGRAPH_CHANNELS, (double)samples);
    }
    convergence_add(room->counts + PHOTOGRAPH_CONVERGENCE, error, samples);
    return samples;
}

/* All samples of a tile, by its place in the frame; returns how many. */
static size_t sum_tile(const struct work *work, struct film_plan *plan, size_t tile,
                       struct room *room)
{
    const struct photograph_question *question = work->question;
    memset(room->sums, 0, sizeof room->sums);
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        plan->scrambling[k] = sobol_scrambling(question->seed, tile, k);
    }
    room->when = sobol_scrambling(question->seed, tile, FILM_DIMENSIONS);
    const struct spare_tile spared = {plan, ACROSS, DOWN, question->samples};
    const enum spare_way way = work->spare != NULL
                                   ? spare_take(work->spare, &spared, room->spare, room->sums)
                                   : SPARE_TRACED;
    room->counts[PHOTOGRAPH_WAYS + way]++;
    if (way != SPARE_TRACED) {
        return question->samples;
    }
    if (question->error > 0) {
        return sum_until(work, plan, room);
    }
    sum_blocks(work, plan, 0, question->samples, room);
    return question->samples;
}

/* Tile `tile` of the crop; its points are those of its place in the frame. */
static void take_tile(const struct work *work, size_t tile, struct room *room)
{
    const struct photograph_question *question = work->question;
    const struct tiling tiling = tiling_of(question);
    float pixels[PIXELS][PHOTOGRAPH_CHANNELS];
    size_t column, row;
    begin_of(&tiling, tile, &column, &row);
    struct film_plan plan = plan_of(work, column, row);
    if (!is_lit(&plan, work->film->region.largest)) {
        return;
    }
    const size_t samples = sum_tile(work, &plan, row / DOWN * tiling.frame + column / ACROSS, room);
    for (size_t k = 0; k < PIXELS; k++) {
        for (size_t channel = 0; channel < PHOTOGRAPH_CHANNELS; channel++) {
            pixels[k][channel] = (float)(work->scale * room->sums[k][channel] / (double)samples);
        }
    }
    photograph_tile(question, work->image, tile, TILE_TO_PICTURE, pixels);
}

static void take_tiles(void *context, const struct parallel_piece *piece)
{
    const struct work *work = context;
    struct watch *watch = work->question->watch;
    const struct arena_mark mark = arena_mark(piece->arena);
    struct room *room = room_of(work->passes, piece->arena);
    for (size_t i = piece->begin; i < piece->end && !watch_is_ended(watch); i++) {
        const size_t tile = work->first + i;
        if (work->done[tile] == 0) {
            take_tile(work, tile, room);
            work->done[tile] = 1;
            watch_add(watch, PIXELS);
        }
    }
    for (int i = 0; i < RELIEF_SIGHTS; i++) {
        room->counts[i] += spare_room_sights(room->spare)[i];
    }
    for (int i = 0; i < PHOTOGRAPH_COUNTS; i++) {
        atomic_fetch_add(&work->counts[i], room->counts[i]);
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
static void look_through(const struct work *work, double x, double y, struct room *room,
                         double at[2])
{
    const struct lens_film *film = work->film;
    const double share = fmin(1, 0.999 * film->region.largest / hypot(x, y));
    memset(&room->samples, 0, sizeof room->samples);
    room->samples.x[0] = share * x;
    room->samples.y[0] = share * y;
    room->samples.v[0] = film->region.has_hole ? 0.5 : 0; /* not at the edge of a hole */
    film->aim(film, &room->samples, room->rays.blocks);
    rays_trace(film->systems[0], &room->rays, NULL);
    if (!subject_meets(room->rays.blocks, 0, work->card.distance, at)) {
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
    const double proportion = shape != NULL ? (double)shape->width / (double)shape->height : w / h;
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

/* The card, or the relief that it shows. */
static bool open_subject(struct work *work, struct arena *arena, struct error *error)
{
    const struct photograph_question *question = work->question;
    const struct setup *setup = question->film.setup;
    if (question->depths.map == NULL) {
        work->subject = subject_card(&work->card);
        return true;
    }
    struct relief *relief = ARENA_NEW(arena, struct relief);
    work->subject = subject_relief(relief);
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

/* What need not be traced; a table of light costs less than a hundredth of the picture. */
static void open_spare(struct work *work, struct arena *arena)
{
    enum { FEW_SAMPLES = 8 };
    const struct photograph_question *question = work->question;
    const unsigned none = 1U << SKIP_BLUR | 1U << SKIP_UNIFORM;
    const size_t rays = question->columns * question->rows * question->samples;
    if (question->samples < FEW_SAMPLES || (question->kept & none) == none) {
        return;
    }
    struct spare *spare = ARENA_NEW(arena, struct spare);
    *spare = (struct spare){.film = work->film,
                            .card = &work->card,
                            .relief = work->subject.relief,
                            .passes = work->passes,
                            .pass = work->pass,
                            .kept = question->kept};
    /* an error is one of all tiles' rays */
    spare->kept |= question->error > 0 ? 1U << SKIP_BLUR : 0;
    work->spare = spare;
    spare_open(spare, rays > 1U << 22 ? 32 : 8, arena);
}

double photograph_share(const struct photograph *photograph, enum relief_sight sight)
{
    double all = 0;
    for (int i = 0; i < RELIEF_SIGHTS; i++) {
        all += (double)photograph->counts[i];
    }
    return all > 0 ? (double)photograph->counts[sight] / all : 0;
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

bool photograph_take(const struct photograph_question *question, struct arena *arena,
                     struct photograph *photograph, struct error *error)
{
    struct lens_film film;
    if (!check_card(question, error) || !lens_film_open(&question->film, arena, &film, error)) {
        return false;
    }
    const struct tiling tiling = tiling_of(question);
    const size_t tiles = tiling.across * tiling.down;
    *photograph = (struct photograph){.image = {.width = tiling.crop.width,
                                                .height = tiling.crop.height,
                                                .channels = PHOTOGRAPH_CHANNELS},
                                      .card = question->card,
                                      .largest = film.lit,
                                      .corner = film.corner};
    const size_t wavelengths = question->film.setup->wavelength_count;
    const bool as_one = wavelengths == 1 ||
                        ((question->kept & 1U << SKIP_COLOUR) == 0 && is_alike(&film, wavelengths));
    const size_t passes = as_one ? 1 : wavelengths;
    const double n = film.region.index / film.systems[0]->index_last;
    struct work work = {.question = question,
                        .film = &film,
                        .card = question->card,
                        .image = &photograph->image,
                        .arena = arena,
                        .counts = ARENA_ARRAY(arena, PHOTOGRAPH_COUNTS, atomic_ullong),
                        .scale = n * n,
                        .passes = passes};
    photograph->passes = passes;
    work.pass = passes_of(question, work.passes, arena);
    sobol_open(FILM_DIMENSIONS, &work.when);
    struct room *room = room_of(work.passes, arena);
    if (!size_card(&work, room, &photograph->card, error) ||
        !image_new(&photograph->image, arena, error)) {
        return false;
    }
    work.card = photograph->card;
    if (!open_subject(&work, arena, error)) {
        return false;
    }
    open_spare(&work, arena);
    work.done = question->done != NULL ? question->done : ARENA_ARRAY(arena, tiles, unsigned char);
    photograph->axis = axis_light(&work, room);
    work.unit = work.scale / (photograph->axis * question->error);
    watch_begin(question->watch, "pixels", PIXELS * count_missing(&work, tiles));
    take_all(&work, tiles, photograph);
    photograph->is_incomplete = count_missing(&work, tiles) > 0;
    return true;
}
