/* camera/photograph/metering.c - the mean light on a film: by rays from it, and by rays to what shines. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/metering.h"

#include "base/constants.h"
#include "base/random.h"
#include "light/colour.h"

#include <math.h>
#include <string.h>

/* Blocks of rays from the film, rays to lights, and parts of both whose means differ: each with as
   many blocks as the most bands have sets, or sets would count as an error. */
enum { BLOCKS = 128, LOOKS = 4096, PARTS = 8 };
/* Of strands that have points for all of them. */
enum { BITS = 8 };
_Static_assert(BLOCKS / PARTS >= BANDS_MOST / BANDS_LANES, "each part meets all bands");
_Static_assert(BLOCKS + LOOKS / RAYS_BLOCK <= 1 << BITS, "a block of its own for each");
/* So many times as dense count rays from the film as they are: they are spread more evenly. */
static const double EVENER = 4;
/* Distances from the axis at which is known what arrives, and blocks of rays that tell it. */
enum { PLACES = 33, PLACE_BLOCKS = 4 };

/* What of the film sees where, and how much light comes from there. */
struct sight {
    const struct metering_question *question;
    size_t count;
    double angle[PLACES];  /* of the chief ray and the axis, growing, rad */
    double radius[PLACES]; /* where on the film it begins, mm */
    double light[PLACES];  /* E/L there, sr */
    double density;        /* that rays from the film count with beside those to lights, per sr */
    struct lights lights;  /* without discs far away, each of which is looked at by itself */
};

/* False: directions do not grow with the place, as in lenses that are telecentric in the scene. */
static bool open_sight(const struct metering_question *question, struct tile_scratch *scratch,
                       struct sight *sight)
{
    const struct lens_film *film = question->rays->film;
    const double within = 0.99; /* of where light arrives */
    const double end = fmin(film->corner, within * film->lit);
    const struct ray_block *block = scratch->rays.blocks;
    *sight = (struct sight){.question = question, .count = PLACES};
    if (!lens_is_round(film->models[0].system->lens)) {
        return false;
    }
    /* is all the film at work at the same times, or the scene at rest? */
    const struct tile_rays *rays = question->rays;
    const struct shutter *shutter = rays->film->shutter;
    if (rays->duration > 0 && shutter != NULL && shutter->kind != SHUTTER_GLOBAL) {
        return false;
    }
    for (size_t i = 0; i < PLACES; i++) {
        const double at[2] = {end * (double)i / (PLACES - 1), 0};
        sight->radius[i] = at[0];
        sight->light[i] =
            question->scale * tile_rays_light(question->rays, at, PLACE_BLOCKS, scratch);
        lens_film_chief(film, i == 0 ? (const double[2]){1e-9 * end, 0} : at, &scratch->samples,
                        &scratch->rays);
        sight->angle[i] = i == 0 ? 0 : atan2(hypot(block->p[0], block->q[0]), -block->r[0]);
        if (block->lost[0] != 0 || (i > 0 && !(sight->angle[i] > sight->angle[i - 1] + 1e-9))) {
            return false;
        }
    }
    const double middle = sight->radius[1] / sight->angle[1];
    sight->density = EVENER * (double)(BLOCKS * RAYS_BLOCK) / LOOKS * middle * middle /
                     (question->width * question->height);
    return end > 0;
}

/* Mean light on the film over illuminance across a direction, of the lens's own coordinates. */
static double metering_share_of(const struct sight *sight, struct vector way)
{
    const struct metering_question *question = sight->question;
    const double aside = hypot(way.x, way.y), angle = atan2(aside, -way.z);
    size_t i = 1;
    while (i < sight->count && sight->angle[i] < angle) {
        i++;
    }
    if (i == sight->count) {
        return 0;
    }
    const double step = sight->angle[i] - sight->angle[i - 1];
    const double part = (angle - sight->angle[i - 1]) / step;
    const double slope = (sight->radius[i] - sight->radius[i - 1]) / step;
    const double radius = sight->radius[i - 1] + part * step * slope;
    const double light = sight->light[i - 1] + part * (sight->light[i] - sight->light[i - 1]);
    const double x = aside > 0 ? radius * way.x / aside : 0;
    const double y = aside > 0 ? radius * way.y / aside : 0;
    if (fabs(x) > question->width / 2 || fabs(y) > question->height / 2) {
        return 0;
    }
    const double area = slope * (aside > 1e-9 ? radius / aside : slope); /* dA/dw */
    return light * area / (question->width * question->height);
}

/* Add the light of one thing that shines to the mean of the film. */
static void add_look(const struct sight *sight, uint32_t index, struct tile_scratch *scratch,
                     double sums[TILE_CHANNELS])
{
    const struct tile_rays *rays = sight->question->rays;
    const struct view *view = rays->subject.view;
    struct sampler points =
        sampler_of(&scratch->sequence, BLOCKS + index / RAYS_BLOCK, index % RAYS_BLOCK);
    double u[3];
    struct lanes lanes;
    struct light_sample sample;
    for (int i = 0; i < 3; i++) {
        u[i] = sampler_next(&points);
    }
    const double time = rays->duration * (sampler_next(&points) - 0.5);
    const struct scene_pose pose = scene_pose_at(&view->camera, time);
    /* bands that a ray is looked at in, and how many times as many there are */
    const struct bands *bands = view->bands;
    lanes.count = bands->count < BANDS_LANES ? bands->count : BANDS_LANES;
    for (size_t k = 0; k < lanes.count; k++) {
        lanes.band[k] = (index + k * bands->count / lanes.count) % bands->count;
    }
    const double times = (double)bands->count / (double)lanes.count;
    if (!lights_sample(&sight->lights, pose.at, time, u, &lanes, &sample) || sample.is_point) {
        return;
    }
    const double share = metering_share_of(sight, frame_in(&pose.turned, sample.direction));
    if (!(share > 0) || !path_is_unoccluded(view->path, pose.at, time, &sample)) {
        return;
    }
    const double weight = path_power_heuristic(sample.pdf, sight->density);
    for (size_t lane = 0; lane < lanes.count; lane++) {
        const double light = weight * times * share * sample.light.of[lane] / sample.pdf;
        for (size_t k = 0; k < TILE_CHANNELS; k++) {
            sums[k] += light * view->bands->rgb[lanes.band[lane]][k];
        }
    }
}

/* Add the suns and stars: each by a ray, or few of them by more. */
static void add_discs(const struct sight *sight, uint32_t part, double mean[TILE_CHANNELS])
{
    const struct tile_rays *rays = sight->question->rays;
    const struct view *view = rays->subject.view;
    const struct distant_lights *discs = &view->path->lights->distant;
    const size_t each = discs->count > 0 ? 1 + LOOKS / PARTS / discs->count : 0;
    for (size_t i = 0; i < each * discs->count; i++) {
        const struct distant_light *disc = &discs->all[i / each];
        const struct random_pair pair = random_pair(rays->seed, i, part);
        const double u[2] = {pair.u, pair.v};
        const double step = (double)(i % each) + random_pair(rays->seed, i, PARTS + part).u;
        const double time = rays->duration * (step / (double)each - 0.5);
        const struct scene_pose pose = scene_pose_at(&view->camera, time);
        const struct light_sample sample = {.direction = distant_light_direction(disc, u),
                                            .distance = INFINITY};
        const double share = metering_share_of(sight, frame_in(&pose.turned, sample.direction));
        if (!(share > 0) || !path_is_unoccluded(view->path, pose.at, time, &sample)) {
            continue;
        }
        const double sine = sin(disc->radius);
        const double light = share * disc->luminance * PI * sine * sine / (double)each;
        for (size_t b = 0; b < view->bands->count; b++) {
            for (size_t k = 0; k < TILE_CHANNELS; k++) {
                mean[k] += light * disc->unit->of[b] * view->bands->rgb[b][k];
            }
        }
    }
}

/* One of the parts; rays knows of the others that look for lights. */
static void take_part(const struct metering_question *question, const struct tile_rays *rays,
                      const struct film_plan *plan, const struct sight *sight, uint32_t part,
                      struct tile_scratch *scratch, double mean[TILE_CHANNELS])
{
    const size_t blocks = BLOCKS / PARTS, looks = LOOKS / PARTS;
    double looked[TILE_CHANNELS] = {0};
    memset(scratch->sums, 0, sizeof scratch->sums);
    tile_rays_sum(rays, plan, part * blocks, (part + 1) * blocks, scratch);
    for (size_t i = 0; sight != NULL && i < looks; i++) {
        add_look(sight, (uint32_t)(part * looks + i), scratch, looked);
    }
    for (size_t k = 0; k < TILE_CHANNELS; k++) {
        double sum = 0;
        for (size_t i = 0; i < TILE_PIXELS; i++) {
            sum += scratch->sums[i][k];
        }
        mean[k] = question->scale * sum / (double)(blocks * RAYS_BLOCK) + looked[k] / (double)looks;
    }
    if (sight != NULL) {
        add_discs(sight, part, mean);
    }
}

void metering_take(const struct metering_question *question, struct arena *arena,
                   struct tile_scratch *scratch, struct metered *metered)
{
    struct tile_rays rays = *question->rays;
    struct view view = *rays.subject.view;
    struct path path = *view.path;
    struct film_plan plan = {.sobol = rays.film->sobol,
                             .left = -question->width / 2,
                             .bottom = -question->height / 2,
                             .width = question->width,
                             .height = question->height};
    struct sight sight;
    const bool has_sight = open_sight(question, scratch, &sight);
    uint64_t counts[PHOTOGRAPH_COUNTS];
    double luminances[PARTS], sum = 0, squares = 0;
    memcpy(counts, scratch->counts, sizeof counts);
    sight.lights = *path.lights;
    sight.lights.distant = (struct distant_lights){.count = 0};
    path.seen = has_sight ? &sight.lights : NULL;
    path.pdf = sight.density;
    view.path = &path;
    /* points of its own, whose blocks do not repeat, however many samples the picture has */
    tile_rays_open_points(&rays, BITS);
    view.points = sampler_table_new(view.points->first, BITS, arena);
    rays.subject = subject_scene(&view);
    tile_rays_begin(&rays, 0, &plan, scratch);
    *metered = (struct metered){.is_direct = has_sight};
    for (uint32_t part = 0; part < PARTS; part++) {
        double mean[TILE_CHANNELS];
        take_part(question, &rays, &plan, has_sight ? &sight : NULL, part, scratch, mean);
        for (size_t k = 0; k < TILE_CHANNELS; k++) {
            metered->mean[k] += mean[k] / PARTS;
        }
        luminances[part] = colour_luminance(mean);
        sum += luminances[part];
    }
    for (int part = 0; part < PARTS; part++) {
        const double away = luminances[part] - sum / PARTS;
        squares += away * away;
    }
    memcpy(scratch->counts, counts, sizeof counts);
    const double variance = squares / (PARTS - 1);
    metered->error = sum > 0 ? sqrt(variance * PARTS) / sum : 0;
}
