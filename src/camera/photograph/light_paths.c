/* camera/photograph/light_paths.c - light tracing: rays from small emitters through the lens. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/light_paths.h"

#include "base/constants.h"
#include "base/parallel.h"
#include "camera/photograph/lamp_rays.h"

#include <math.h>
#include <stdatomic.h>

enum {
    EMITTERS_MOST = 10000,
    GRID = 32,           /* rays of a look across the rectangle */
    LOOKS_MOST = 6,      /* until a rectangle fits */
    RAYS_LEAST = 1024,   /* of a lamp */
    RAYS_ENOUGH = 16384, /* if there are few lamps */
    RAYS_OF_ALL = 1 << 22,
    RAYS_MOST = 1 << 26,
    OF_TIMED = 64, /* samples of a picture that ends in time, as far as they count here */
    BLOCKS_A_PIECE = 16
};

/* Sequences of tiles are numbered from 0. */
static const uint64_t first_sequence = (uint64_t)1 << 40;

/* -------- which emitters, and their rectangles -------- */

/* What a look at a rectangle has found. */
struct lamp_image {
    size_t columns[GRID], rows[GRID]; /* rays that arrive, by the cell they go through */
    size_t arrived;
    double flux;            /* mm^2 sr of all that arrive, over luminance */
    double sent;            /* the same of all */
    double mean[2], cov[3]; /* of where they arrive, mm and mm^2: xx, yy, xy */
};

/* A grid of rays, each cell's to another part of the emitter and at another time. */
static void lamp_explore(const struct lamps *lamps, const struct lamp *lamp, struct lamp_rays *rays,
                         struct lamp_image *view)
{
    /* the fractions of multiples of these numbers fill a cube evenly: powers of 1/1.2207440846 */
    static const double steps[3] = {0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
    double sum[2] = {0}, squares[3] = {0};
    *view = (struct lamp_image){.arrived = 0};
    for (size_t block = 0; block < GRID * GRID / RAYS_BLOCK; block++) {
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const size_t k = block * RAYS_BLOCK + i;
            rays->u[U_PLACE][i] = ((double)(k % GRID) + 0.5) / GRID;
            rays->u[U_PLACE + 1][i] = ((double)(k / GRID) + 0.5) / GRID;
            for (int j = 0; j < 3; j++) {
                const double turn = 0.5 + (double)k * steps[j];
                rays->u[U_EMITTER + j][i] = turn - floor(turn);
            }
        }
        lamp_start(lamps, lamp, rays);
        lamp_trace(lamps, 0, rays);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            view->sent += rays->sent[i] / (GRID * GRID);
            if (lamp_arrives(lamps, rays, i)) {
                const size_t k = block * RAYS_BLOCK + i;
                const double x = rays->rays.blocks->x[i], y = rays->rays.blocks->y[i];
                view->columns[k % GRID]++;
                view->rows[k / GRID]++;
                view->arrived++;
                view->flux += rays->flux[i] / (GRID * GRID);
                sum[0] += x;
                sum[1] += y;
                squares[0] += x * x;
                squares[1] += y * y;
                squares[2] += x * y;
            }
        }
    }
    const double count = fmax(1, (double)view->arrived);
    for (int k = 0; k < 2; k++) {
        view->mean[k] = sum[k] / count;
        view->cov[k] = fmax(0, squares[k] / count - view->mean[k] * view->mean[k]);
    }
    view->cov[2] = squares[2] / count - view->mean[0] * view->mean[1];
}

/* The part of a side that is lit, with a cell around it; false: light comes up to an end of it. */
static bool lamp_narrow(const size_t cells[GRID], double *low, double *high)
{
    size_t first = 0, last = GRID - 1;
    while (first < GRID && cells[first] == 0) {
        first++;
    }
    while (last > first && cells[last] == 0) {
        last--;
    }
    const double cell = (*high - *low) / GRID;
    const bool is_within = first > 0 && last < GRID - 1;
    const double from = *low;
    *low = from + ((double)first - 1) * cell;
    *high = from + ((double)last + 2) * cell;
    return is_within;
}

/* Fit the rectangle of a lamp; false: none of its rays is found to come to the film. */
static bool lamp_fit(const struct lamps *lamps, struct lamp *lamp, struct lamp_rays *rays,
                     struct lamp_image *view)
{
    static const double well = 0.4; /* of the rays arrive: another look would not pay */
    for (int look = 0; look < LOOKS_MOST; look++) {
        lamp_explore(lamps, lamp, rays, view);
        if (view->arrived == 0) {
            return false;
        }
        if (look > 0 && (double)view->arrived > well * GRID * GRID &&
            view->columns[0] + view->columns[GRID - 1] + view->rows[0] + view->rows[GRID - 1] ==
                0) {
            return true;
        }
        const bool is_wide = lamp_narrow(view->columns, &lamp->low[0], &lamp->high[0]);
        const bool is_high = lamp_narrow(view->rows, &lamp->low[1], &lamp->high[1]);
        if (look == LOOKS_MOST - 2 && is_wide && is_high) {
            lamp_explore(lamps, lamp, rays, view);
            return view->columns[0] + view->columns[GRID - 1] + view->rows[0] +
                       view->rows[GRID - 1] ==
                   0;
        }
    }
    return false;
}

/*
 * Pixels of its image, as an ellipse of the spread with which rays arrive, and a pixel's width
 * around.
 */
static double lamp_pixels(const struct lamps *lamps, const struct lamp_image *view)
{
    const double spread = sqrt(fmax(0, view->cov[0] * view->cov[1] - view->cov[2] * view->cov[2]));
    const double side = sqrt(4 * PI * spread / (lamps->pixel[0] * lamps->pixel[1]));
    return (side + 1) * (side + 1);
}

/* What of the lens stands before all of its light: a plane, and half of the rectangle's side. */
static bool lamp_begin(const struct lamps *lamps, struct lamp *lamp)
{
    const struct photograph_question *question = lamps->question;
    const struct view *view = lamps->rays->subject.view;
    const struct setup *setup = question->film.setup;
    const struct surface *front = &setup->lens->surfaces[0];
    const double pupil = setup->first.entrance_pupil;
    const double radius = fabs(setup->first.entrance_diameter);
    const double side = front->has_diameter ? fabs(front->diameter.value.hi) / 2 : 2 * radius;
    double tangent = 0;
    lamp->plane = isfinite(pupil) ? pupil : 0;
    /* the steepest of its ways, when it is nearest */
    enum { TIMES = 9 };
    for (int i = 0; i < TIMES; i++) {
        const double time = lamps->begin + (lamps->end - lamps->begin) * i / (TIMES - 1);
        const struct scene_pose camera = scene_pose_at(&view->camera, time);
        struct vector to = {0};
        double around = 0;
        if (lamp->distant != NULL) {
            to = frame_in(&camera.turned, lamp->distant->direction);
            around = lamp->distant->radius;
        } else {
            const struct scene *scene = view->path->lights->scene;
            const struct scene_thing *thing = &scene->things[lamp->thing];
            const struct emitter emitter = {lamp->thing, 0};
            around = emitter_bounds(scene, &emitter).radius;
            to = frame_in(&camera.turned,
                          vector_minus(scene_pose_at(&thing->where, time).at, camera.at));
            to.z += view->pupil;
            if (to.z + around >= fmin(0, lamp->plane)) {
                lamp->plane = fmin(0, lamp->plane);
                if (to.z + around >= 0) {
                    return false;
                }
                lamp->plane = 0;
            }
        }
        if (!(to.z + around < 0)) {
            return false;
        }
        tangent = fmax(tangent, (hypot(to.x, to.y) + around) / -(to.z + around));
    }
    const double half = fmax(radius, side) + fabs(lamp->plane) * tangent;
    for (int k = 0; k < 2; k++) {
        lamp->low[k] = -half;
        lamp->high[k] = half;
    }
    return isfinite(half) && half > 0;
}

/* The share of rays from the film, over the image of a lamp, that meet its emitter. */
static double lamp_share(const struct lamps *lamps, const struct lamp_image *view, double pixels,
                         struct tile_scratch *scratch)
{
    const double area = pixels * lamps->pixel[0] * lamps->pixel[1];
    const double index = lamps->models[0].system->index_last / lamps->models[0].system->index_first;
    enum { BLOCKS = 4 };
    const double light = index * index * tile_rays_light(lamps->rays, view->mean, BLOCKS, scratch);
    return light > 0 ? view->flux / (area * light) : 1;
}

/* So many rays, a power of two of blocks. */
static size_t lamp_blocks(const struct lamps *lamps, const struct lamp_image *view, double pixels,
                          size_t candidates)
{
    const struct photograph_question *question = lamps->question;
    const double per_pixel = 8;
    double samples = (double)question->samples;
    if (question->error > 0) {
        /* the noise within a disc, measured, is 0.28 samples^-0.6; half of the error may be so */
        samples = fmin(samples, fmax(CONVERGENCE_LEAST, pow(0.56 / question->error, 1 / 0.6)));
    } else if (question->is_over != NULL) {
        samples = fmin(samples, OF_TIMED);
    }
    const double passing = (double)view->arrived / (GRID * GRID);
    const double enough = fmin(RAYS_ENOUGH, RAYS_OF_ALL / (double)candidates);
    const double wanted = fmax(per_pixel * samples * pixels, fmax(RAYS_LEAST, enough)) / passing;
    size_t blocks = RAYS_LEAST / RAYS_BLOCK;
    while ((double)(blocks * RAYS_BLOCK) < fmin(wanted, RAYS_MOST)) {
        blocks *= 2;
    }
    return blocks;
}

/* A thing that is one lamp of one colour and light. */
static bool may_send(const struct lights *lights, size_t thing)
{
    const struct scene_thing *it = &lights->scene->things[thing];
    const bool is_shape = it->shape == SHAPE_DISC || it->shape == SHAPE_CARD ||
                          it->shape == SHAPE_SPHERE || it->shape == SHAPE_BOX;
    return is_shape && it->picture == NULL && lights->first[thing] != SCENE_NONE;
}

/*
 * Does a lens keep etendue, or areas of heights and slopes? An ideal lens with distortion keeps
 * neither, nor do ideal lenses between real ones.
 */
static bool keeps_flux(const struct film_question *film, const struct system *system,
                       bool *is_ideal)
{
    const struct lens *lens = film->setup->lens;
    bool has_ideal = false, has_real = false, has_distortion = false;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        has_ideal = has_ideal || surface->kind == SURFACE_THICK;
        has_real = has_real || surface->kind == SURFACE_REFLECT ||
                   (surface->kind == SURFACE_REFRACT && system->n[i].hi != system->n[i + 1].hi);
        for (int k = 0; k < 3 && surface->kind == SURFACE_THICK; k++) {
            has_distortion = has_distortion || surface->distortion[k].value.hi != 0;
        }
    }
    *is_ideal = film->model == MODEL_PARAXIAL || has_ideal;
    return film->model != MODEL_PINHOLE && !has_distortion &&
           (film->model == MODEL_PARAXIAL || !(has_ideal && has_real));
}

static struct lamps lamps_of(const struct photograph_question *question,
                             const struct tile_rays *rays, const struct light_paths *light)
{
    struct lamps lamps = {.question = question,
                          .rays = rays,
                          .models = light->models,
                          .is_ideal = light->is_ideal,
                          .begin = -rays->duration / 2,
                          .end = rays->duration / 2,
                          .pixel = {question->film.width / (double)question->columns,
                                    question->film.height / (double)question->rows}};
    if (rays->film->shutter != NULL) {
        double span[2];
        lens_film_span(rays->film, span);
        lamps.begin = span[0];
        lamps.end = span[1];
    }
    return lamps;
}

static double lamp_luminance(const struct scene *scene, const struct lamp *lamp)
{
    return lamp->distant != NULL ? lamp->distant->luminance
                                 : scene->materials[scene->things[lamp->thing].material].luminance;
}

/* Those who look for lamps, and what they have found. */
struct lamp_search {
    const struct lamps *lamps;
    struct lamp_rays *rays;
    struct tile_scratch *scratch;
    size_t candidates;
    struct lamp *found;
    size_t count, blocks;
    double flux; /* lm, or lx mm^2 */
};

/* Try one; true: it is small, its rectangle is known, and so it is found. */
static bool lamp_try(struct lamp_search *search, size_t thing, const struct distant_light *distant)
{
    static const double small = 0.25;
    const struct lamps *lamps = search->lamps;
    struct lamp lamp = {.thing = thing, .distant = distant, .begin = search->blocks};
    struct lamp_image image;
    if (!lamp_begin(lamps, &lamp) || !lamp_fit(lamps, &lamp, search->rays, &image)) {
        return false;
    }
    const double pixels = lamp_pixels(lamps, &image);
    if (!(lamp_share(lamps, &image, pixels, search->scratch) < small)) {
        return false;
    }
    lamp.blocks = lamp_blocks(lamps, &image, pixels, search->candidates);
    lamp.sequence = first_sequence + search->count;
    search->found[search->count++] = lamp;
    search->blocks += lamp.blocks;
    search->flux +=
        image.sent * lamp_luminance(lamps->rays->subject.view->path->lights->scene, &lamp);
    return true;
}

bool light_paths_open(const struct photograph_question *question, const struct tile_rays *rays,
                      struct tile_scratch *scratch, struct arena *arena, struct light_paths *light,
                      struct error *error)
{
    const struct view *view = rays->subject.view;
    const struct lights *lights = view->path->lights;
    const struct scene *scene = lights->scene;
    size_t count = lights->distant.count;
    *light = (struct light_paths){.path = *view->path, .view = *view};
    for (size_t i = 0; i < scene->thing_count; i++) {
        count += may_send(lights, i) ? 1 : 0;
    }
    if (count == 0 || count > EMITTERS_MOST ||
        !keeps_flux(&question->film, rays->film->models[0].system, &light->is_ideal) ||
        skip_is_kept(question->kept, SKIP_LAMPS)) {
        return true;
    }
    light->models = lens_film_models(&question->film, SETUP_IMAGE, arena, error);
    if (light->models == NULL) {
        return false;
    }
    const struct lamps lamps = lamps_of(question, rays, light);
    struct lamp_search search = {.lamps = &lamps,
                                 .rays = lamp_rays_new(arena),
                                 .scratch = scratch,
                                 .candidates = count,
                                 .found = ARENA_ARRAY(arena, count, struct lamp)};
    /* what is seen along rays from the film: copies without the light that is sent */
    struct lights *seen = ARENA_NEW(arena, struct lights);
    struct distant_light *discs = ARENA_ARRAY(arena, lights->distant.count, struct distant_light);
    bool *is_left_out = ARENA_ARRAY(arena, scene->thing_count, bool);
    for (size_t i = 0; i < lights->distant.count; i++) {
        discs[i] = lights->distant.all[i];
        if (lamp_try(&search, SCENE_NONE, &lights->distant.all[i])) {
            discs[i].luminance = 0;
        }
    }
    for (size_t i = 0; i < scene->thing_count; i++) {
        is_left_out[i] = may_send(lights, i) && lamp_try(&search, i, NULL);
    }
    *seen = *lights;
    seen->distant.all = discs;
    light->path.seen = seen;
    light->path.pdf = INFINITY;
    light->path.is_left_out = is_left_out;
    light->view.path = &light->path;
    light->lamps = search.found;
    light->count = search.count;
    light->blocks = search.blocks;
    /* all light in one pixel is 2^56 steps: room for what a grid of rays has missed, and for
       channels brighter than their luminance */
    light->step = search.flux / (lamps.pixel[0] * lamps.pixel[1]) * 0x1p-56;
    return true;
}

/* -------- sending -------- */

/* Radiance of a lamp in these lanes. */
static struct radiance lamp_radiance(const struct lamps *lamps, const struct lamp *lamp,
                                     const struct lanes *lanes)
{
    static const double middle[2] = {0.5, 0.5}; /* it is the same everywhere */
    struct radiance radiance = {{0}};
    if (lamp->distant == NULL) {
        materials_shine(&lamps->rays->subject.view->path->lights->materials, lamp->thing, middle,
                        lanes, &radiance);
    }
    for (size_t k = 0; k < lanes->count && lamp->distant != NULL; k++) {
        radiance.of[k] = lamp->distant->luminance * lamp->distant->unit->of[lanes->band[k]];
    }
    return radiance;
}

/* Does nothing stand between the lens and the emitter? */
static bool lamp_is_free(const struct lamps *lamps, struct lamp_rays *rays, size_t i)
{
    if (rays->is_free[i] == UNKNOWN) {
        const struct path *path = lamps->rays->subject.view->path;
        const bool is_free = path_is_unoccluded(path, rays->front[i], rays->times[i], &rays->to[i]);
        rays->is_free[i] = is_free ? FREE : BLOCKED;
    }
    return rays->is_free[i] == FREE;
}

/* All lamps on their way: what threads share. */
struct lamp_sending {
    struct lamps lamps;
    struct light_paths *light;
    struct sobol sobol[U_COUNT];
};

/* Add what a traced block brings to the channels of a pass, `share` of its light. */
static void lamp_splat(const struct lamp_sending *sending, const struct lamp *lamp, uint32_t block,
                       const struct lanes *lanes, const struct ray_reuse_pass *pass,
                       struct lamp_rays *rays)
{
    const struct lamps *lamps = &sending->lamps;
    const struct light_paths *light = sending->light;
    const struct film_question *film = &lamps->question->film;
    const struct view *view = lamps->rays->subject.view;
    const struct image_area *crop = &light->tiling.crop;
    const struct radiance radiance = lamp_radiance(lamps, lamp, lanes);
    const double count = (double)(lamp->blocks * RAYS_BLOCK);
    const double each = pass->share / (count * lamps->pixel[0] * lamps->pixel[1] * light->step);
    double by[TILE_CHANNELS] = {0};
    for (size_t lane = 0; lane < lanes->count; lane++) {
        for (size_t k = pass->begin; k < pass->end; k++) {
            by[k] += each * radiance.of[lane] * view->bands->rgb[lanes->band[lane]][k];
        }
    }
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        if (!lamp_arrives(lamps, rays, i)) {
            continue;
        }
        /* the film is upside down: the upper left of the picture lies at +x, -y */
        const double right = (film->width / 2 - rays->rays.blocks->x[i]) / lamps->pixel[0];
        const double down = (film->height / 2 + rays->rays.blocks->y[i]) / lamps->pixel[1];
        const size_t column = (size_t)right - crop->left, row = (size_t)down - crop->top;
        if (column >= crop->width || row >= crop->height || !lamp_is_free(lamps, rays, i)) {
            continue;
        }
        const size_t at = (row * crop->width + column) * TILE_CHANNELS;
        for (size_t k = pass->begin; k < pass->end; k++) {
            const uint64_t steps = (uint64_t)llrint(rays->flux[i] * by[k]);
            atomic_fetch_add_explicit(&light->sums[at + k], steps, memory_order_relaxed);
            if (light->halves != NULL && block < lamp->blocks / 2) {
                atomic_fetch_add_explicit(&light->halves[at + k], steps, memory_order_relaxed);
            }
        }
    }
}

/* A block of a lamp in all its wavelengths. */
static void lamp_send(const struct lamp_sending *sending, const struct lamp *lamp, uint32_t block,
                      struct lamp_rays *rays)
{
    const struct lamps *lamps = &sending->lamps;
    const struct tile_rays *tile = lamps->rays;
    for (uint32_t k = 0; k < U_COUNT; k++) {
        const uint32_t scrambling = sobol_scrambling(tile->seed, lamp->sequence, k);
        sobol_points(&sending->sobol[k], scrambling, block, rays->u[k]);
    }
    lamp_start(lamps, lamp, rays);
    const struct bands *bands = tile->subject.view->bands;
    struct lanes lanes = {0};
    if (!tile_rays_in_bands(tile)) {
        for (size_t pass = 0; pass < tile->passes; pass++) {
            lanes.count = 0;
            for (size_t k = tile->pass[pass].begin; k < tile->pass[pass].end; k++) {
                lanes.band[lanes.count++] = k;
            }
            lamp_trace(lamps, pass, rays);
            lamp_splat(sending, lamp, block, &lanes, &tile->pass[pass], rays);
        }
        return;
    }
    /* four bands far apart, so that a power of two of blocks has all of them evenly */
    const struct ray_reuse_pass all = {0, TILE_CHANNELS, (double)bands->count / BANDS_LANES};
    const uint32_t scrambling = sobol_scrambling(tile->seed, lamp->sequence, U_COUNT);
    const double hero = sobol_point(&sending->sobol[0], scrambling, block);
    for (size_t lane = 0; lane < BANDS_LANES; lane++) {
        const size_t band = (size_t)((double)bands->count * (((double)lane + hero) / BANDS_LANES));
        if (tile->passes > 1) {
            lanes = (struct lanes){1, {band}};
            lamp_trace(lamps, band, rays);
            lamp_splat(sending, lamp, block, &lanes, &all, rays);
        } else {
            lanes.band[lanes.count++] = band;
        }
    }
    if (tile->passes == 1) {
        lamp_trace(lamps, 0, rays);
        lamp_splat(sending, lamp, block, &lanes, &all, rays);
    }
}

static void lamps_send(void *context, const struct parallel_piece *piece)
{
    const struct lamp_sending *sending = context;
    const struct light_paths *light = sending->light;
    const struct arena_mark mark = arena_mark(piece->arena);
    struct lamp_rays *rays = lamp_rays_new(piece->arena);
    struct watch *watch = sending->lamps.question->watch;
    const struct lamp *lamp = light->lamps;
    for (size_t i = piece->begin; i < piece->end && watch_add(watch, RAYS_BLOCK); i++) {
        while (i >= lamp->begin + lamp->blocks) {
            lamp++;
        }
        lamp_send(sending, lamp, (uint32_t)(i - lamp->begin), rays);
    }
    arena_reset(piece->arena, mark);
}

void light_paths_send(const struct photograph_question *question, const struct tile_rays *rays,
                      struct arena *arena, struct light_paths *light)
{
    struct lamp_sending sending = {.lamps = lamps_of(question, rays, light), .light = light};
    struct parallel *parallel = ARENA_NEW(arena, struct parallel);
    light->tiling = tiling_of(question->columns, question->rows, question->crop);
    const size_t count = light->tiling.crop.width * light->tiling.crop.height * TILE_CHANNELS;
    light->sums = ARENA_ARRAY(arena, count, _Atomic uint64_t);
    light->halves = question->error > 0 ? ARENA_ARRAY(arena, count, _Atomic uint64_t) : NULL;
    for (uint32_t k = 0; k < U_COUNT; k++) {
        sobol_open(k, &sending.sobol[k]);
    }
    parallel->threads = question->threads;
    watch_begin(question->watch, "rays of lamps", light->blocks * RAYS_BLOCK);
    parallel_pieces(parallel, light->blocks, BLOCKS_A_PIECE, lamps_send, &sending);
    parallel_free(parallel);
}

static double light_paths_lx(const struct light_paths *light, _Atomic uint64_t *sum)
{
    return light->step * (double)(int64_t)atomic_load_explicit(sum, memory_order_relaxed);
}

double light_paths_at(const struct light_paths *light, size_t pixel, size_t channel)
{
    return light_paths_lx(light, &light->sums[pixel * TILE_CHANNELS + channel]);
}

double light_paths_half_at(const struct light_paths *light, size_t pixel, size_t channel)
{
    return 2 * light_paths_lx(light, &light->halves[pixel * TILE_CHANNELS + channel]);
}
