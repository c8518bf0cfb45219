/* tests/stress/family_quadratures.c - printed errors of clipped pupils against true ones. */
/* SPDX-License-Identifier: MIT */
#include "image_trial.h"

#include "analysis/image/mtf.h"
#include "analysis/rays/illumination.h"
#include "analysis/rays/spot.h"
#include "analysis/waves/wavefront.h"
#include "trace/dispatch.h"

#include <math.h>
#include <string.h>

/*
 * Sums over what is clear of a stop by arithmetic of our own: along arms from its middle, each up
 * to where rays end, Gauss's points of r^2. Corners make of the arms' rule one of the second order:
 * half as many, with fewer points, say how far it is off.
 */
enum { ARMS = 720, ALONG = 24, COARSE = 16, LOOKS = 12, HALVINGS = 34 };

struct star {
    const struct aim *aim;
    const struct system *clipped; /* with paths, to the image plane */
    struct arena *arena;
    double middle[2];
    double edge[ARMS]; /* radii of the stop */
};

static void star_direction(int arm, double way[2])
{
    const double angle = 2 * acos(-1) * (arm + 0.3) / ARMS;
    way[0] = cos(angle);
    way[1] = sin(angle);
}

/* Rays through points of the stop to the image; false: one cannot be aimed. */
static bool star_trace(const struct star *star, const struct pupil_point *points, size_t count,
                       struct rays *rays)
{
    *rays = rays_new(star->arena, count);
    if (aim_rays(star->aim, points, count, rays) != count) {
        return false;
    }
    image_aim_closer(star->aim, points, count, rays, star->arena);
    rays_trace(star->clipped, rays, NULL);
    return true;
}

static bool star_is_clear(const struct rays *rays, size_t i)
{
    return ray_block_status(&rays->blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) == RAY_OK;
}

/* The middle of what is clear; false: hardly anything is. */
static bool star_find_middle(struct star *star)
{
    enum { SIDE = 24 };
    struct pupil_point points[SIDE * SIDE];
    struct rays rays;
    size_t count = 0, clear = 0;
    double sum[2] = {0, 0};
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = (2.0 * (i % SIDE) + 1) / SIDE - 1, y = (2.0 * (i / SIDE) + 1) / SIDE - 1;
        if (x * x + y * y < 1) {
            points[count++] = (struct pupil_point){x, y, 1};
        }
    }
    if (!star_trace(star, points, count, &rays)) {
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        if (star_is_clear(&rays, i)) {
            sum[0] += points[i].x;
            sum[1] += points[i].y;
            clear++;
        }
    }
    star->middle[0] = sum[0] / (double)clear;
    star->middle[1] = sum[1] / (double)clear;
    return clear > 20;
}

/* How far it is along an arm to the rim of the stop. */
static double star_reach(const struct star *star, int arm)
{
    const double *m = star->middle;
    double way[2];
    star_direction(arm, way);
    const double b = m[0] * way[0] + m[1] * way[1];
    return sqrt(b * b + 1 - m[0] * m[0] - m[1] * m[1]) - b;
}

static struct pupil_point star_point(const struct star *star, int arm, double r, double weight)
{
    double way[2];
    star_direction(arm, way);
    return (struct pupil_point){star->middle[0] + r * way[0], star->middle[1] + r * way[1], weight};
}

/* Where light ends on each arm; false: it comes again behind that, or is not to be found. */
static bool star_find_edges(struct star *star)
{
    struct pupil_point *points = ARENA_ARRAY(star->arena, ARMS * LOOKS, struct pupil_point);
    double low[ARMS], high[ARMS];
    struct rays rays;
    const double within = 1 - 1e-9; /* the stop's own rim is clear */
    for (int i = 0; i < ARMS * LOOKS; i++) {
        const double share = within * (i % LOOKS) / (LOOKS - 1);
        points[i] = star_point(star, i / LOOKS, share * star_reach(star, i / LOOKS), 1);
    }
    if (!star_trace(star, points, (size_t)ARMS * LOOKS, &rays)) {
        return false;
    }
    for (int arm = 0; arm < ARMS; arm++) {
        int clear = 0;
        const size_t first = (size_t)(arm * LOOKS);
        while (clear < LOOKS && star_is_clear(&rays, first + (size_t)clear)) {
            clear++;
        }
        for (int k = clear; k < LOOKS; k++) {
            if (clear == 0 || star_is_clear(&rays, first + (size_t)k)) {
                return false;
            }
        }
        const double reach = star_reach(star, arm), step = within * reach / (LOOKS - 1);
        low[arm] = clear == LOOKS ? reach : (clear - 1) * step;
        high[arm] = clear == LOOKS ? reach : clear * step;
    }
    for (int turn = 0; turn < HALVINGS; turn++) {
        for (int arm = 0; arm < ARMS; arm++) {
            points[arm] = star_point(star, arm, (low[arm] + high[arm]) / 2, 1);
        }
        if (!star_trace(star, points, ARMS, &rays)) {
            return false;
        }
        for (int arm = 0; arm < ARMS; arm++) {
            const double middle = (low[arm] + high[arm]) / 2;
            *(star_is_clear(&rays, (size_t)arm) ? &low[arm] : &high[arm]) = middle;
        }
    }
    memcpy(star->edge, low, sizeof star->edge);
    return true;
}

/* What the truth is of: means over the stop, and the light as a sum. */
struct star_truth {
    double rms, light, waves; /* mm, sr, wavelengths */
    bool is_folded; /* behind the lens: rays are turned over in places of the stop, or nearly so */
};

/* Sums over the points. */
static void star_add(const struct pupil_point *points, const struct rays *rays,
                     const struct rays *beside, double h, const double *waves,
                     struct star_truth *truth)
{
    long double weight = 0, sums[6] = {0}, light = 0;
    double least = INFINITY, most = -INFINITY; /* of areas */
    const double origin[2] = {rays->blocks->x[0], rays->blocks->y[0]};
    for (size_t at = 0; at < rays->count; at++) {
        const struct ray_block *block = &rays->blocks[at / RAYS_BLOCK];
        const double x = block->x[at % RAYS_BLOCK] - origin[0];
        const double y = block->y[at % RAYS_BLOCK] - origin[1];
        const double w = points[at].weight,
                     all[6] = {x, y, x * x, y * y, waves[at], waves[at] * waves[at]};
        double p[4], q[4];
        for (size_t k = 0; k < 4; k++) {
            p[k] = beside->blocks[(4 * at + k) / RAYS_BLOCK].p[(4 * at + k) % RAYS_BLOCK];
            q[k] = beside->blocks[(4 * at + k) / RAYS_BLOCK].q[(4 * at + k) % RAYS_BLOCK];
        }
        weight += (long double)w;
        const double turned = (p[0] - p[1]) * (q[2] - q[3]) - (q[0] - q[1]) * (p[2] - p[3]);
        light += (long double)(w * fabs(turned));
        least = fmin(least, turned);
        most = fmax(most, turned);
        for (int k = 0; k < 6; k++) {
            sums[k] += (long double)(w * all[k]);
        }
    }
    for (int k = 0; k < 6; k++) {
        sums[k] /= weight;
    }
    truth->rms = sqrt((double)(sums[2] - sums[0] * sums[0] + sums[3] - sums[1] * sums[1]));
    truth->waves = sqrt((double)(sums[5] - sums[4] * sums[4]));
    truth->is_folded =
        fmin(fabs(least), fabs(most)) < 0.1 * fmax(fabs(least), fabs(most)) || least * most < 0;
    truth->light = (double)light / (4 * h * h);
}

/* By every `step`th arm and so many points along it; false: rays about the points are lost. */
static bool star_sums(const struct star *star, const struct wavefront_source *source, int step,
                      int along, struct star_truth *truth)
{
    const double h = 1e-4; /* radii of the stop */
    double x[ALONG], w[ALONG];
    const int count = ARMS / step * along;
    const size_t all = (size_t)count;
    struct pupil_point *points = ARENA_ARRAY(star->arena, all, struct pupil_point);
    struct pupil_point *near = ARENA_ARRAY(star->arena, 4 * all, struct pupil_point);
    double *waves = ARENA_ARRAY(star->arena, all, double);
    struct rays rays, beside;
    image_legendre(along, x, w);
    for (int i = 0; i < count; i++) {
        const int arm = i / along * step;
        const double edge = star->edge[arm];
        const double weight = acos(-1) * step / ARMS * edge * edge * w[i % along];
        points[i] = star_point(star, arm, edge * sqrt(x[i % along]), weight);
        for (int k = 0; k < 4; k++) {
            const double off = k % 2 == 0 ? h : -h;
            near[4 * i + k] = (struct pupil_point){points[i].x + (k < 2 ? off : 0),
                                                   points[i].y + (k < 2 ? 0 : off), 1};
        }
    }
    if (!star_trace(star, points, all, &rays) || !star_trace(star, near, 4 * all, &beside)) {
        return false;
    }
    for (int i = 0; i < count; i++) {
        const struct ray ray = rays_get(&rays, (size_t)i, star->clipped->index_last);
        if (ray.status != RAY_OK) {
            return false;
        }
        waves[i] = (source->zero - opd_path(&source->reference.opd, &ray)) * source->waves;
    }
    star_add(points, &rays, &beside, h, waves, truth);
    return true;
}

/* -------- what is printed -------- */

/* Is a value no farther from the truth than it says, and than the truth is known? */
static void judge(struct trial *trial, const char *what, double value, double error,
                  const double truth[2], double rounding)
{
    if (!isfinite(truth[0])) {
        trial_skip(trial); /* rays that miss the reference have no wave front */
        return;
    }
    const double doubt = 2 * fabs(truth[0] - truth[1]) + rounding;
    const double off = fabs(value - truth[0]);
    trial_verdict(trial, off <= error + doubt,
                  "%s %.12g, truth %.12g: off by %.3g, printed error %.3g, doubt %.3g", what, value,
                  truth[0], off, error, doubt);
}

/* Contrast has its own finer answer as truth. */
static void judge_contrast(struct trial *trial, const struct bundle_question *bundle, double error)
{
    const double frequency = trial_magnitude(trial, 1, 100);
    trial->about =
        arena_printf(&trial->arena, "%sfrequency %.17g error %g\n", trial->about, frequency, error);
    struct mtf found[2];
    for (int i = 0; i < 2; i++) {
        const struct mtf_question question = {.bundle = *bundle, .error = i == 0 ? error : 1e-8};
        struct mtf_source *source = ARENA_NEW(&trial->arena, struct mtf_source);
        struct error why = {0};
        if (!mtf_open(&question, &trial->arena, source, &why) ||
            !mtf_find(source, frequency, &trial->arena, &found[i], &why) ||
            isnan(found[i].contrast[0]) || isnan(found[i].contrast[1])) {
            return; /* too rough for waves */
        }
    }
    for (int k = 0; k < MTF_DIRECTIONS; k++) {
        const double truth[2] = {found[1].contrast[k], found[1].contrast[k]};
        judge(trial, k == MTF_TANGENTIAL ? "tangential contrast" : "sagittal contrast",
              found[0].contrast[k], found[0].error, truth, found[1].error + 1e-13);
    }
}

void try_clipped(struct trial *trial)
{
    static struct image_trial one;
    static struct star star;
    struct error error = {0};
    struct aim aim;
    struct beam beam;
    struct star_truth truth[2];
    if (!image_trial_open(trial, trial_between(trial, 0.3, 8), trial_chance(trial, 0.8), &one)) {
        trial_skip(trial);
        return;
    }
    const struct setup *setup = &one.setup;
    const struct bundle_question bundle = {
        .setup = setup, .field = &setup->fields[0].point, .clip = true};
    const double asked = trial_magnitude(trial, 1e-7, 1e-2);
    const struct spot_question spots = {
        .bundle = bundle, .error = asked, .no_radius = true, .energy = (double)NAN};
    const struct wavefront_question fronts = {.bundle = bundle, .error = asked};
    const struct system *open = setup_system(setup, 0, SETUP_OPEN, &error);
    const struct system *clipped = setup_system(setup, 0, SETUP_CLIPPED, &error);
    star.clipped = setup_system(setup, 0, SETUP_CLIPPED | SETUP_IMAGE | SETUP_PATH, &error);
    star.aim = &aim;
    star.arena = &trial->arena;
    struct wavefront_source *source = ARENA_NEW(&trial->arena, struct wavefront_source);
    if (open == NULL || clipped == NULL || star.clipped == NULL ||
        !setup_beam(setup, bundle.field, &beam, &error) ||
        !aim_open(open, &beam, &trial->arena, &aim, &error) || !star_find_middle(&star) ||
        !star_find_edges(&star) || !wavefront_open(&fronts, &trial->arena, source, &error) ||
        !star_sums(&star, source, 1, ALONG, &truth[0]) ||
        !star_sums(&star, source, 2, COARSE, &truth[1])) {
        trial_skip(trial); /* dark, or not one piece about its middle */
        return;
    }
    struct spot spot;
    struct wavefront front;
    if (trial_verdict(trial, spot_find(&spots, &trial->arena, &spot, &error), "%s",
                      error.message)) {
        judge(trial, "spot", spot.rms, spot.error, (double[2]){truth[0].rms, truth[1].rms},
              1e-9 * truth[0].rms + 1e-12);
    }
    if (trial_verdict(trial, wavefront_find(source, false, &trial->arena, &front, &error), "%s",
                      error.message)) {
        judge(trial, "wave front", front.rms, front.error,
              (double[2]){truth[0].waves, truth[1].waves}, 1e-9 * truth[0].waves + 1e-8);
    }
    const struct illumination_question lights = {
        .clipped = clipped, .open = open, .beam = &beam, .first = &setup->first, .error = asked};
    const struct illumination light = illumination_of_field(&lights, &trial->arena);
    if (truth[0].is_folded) {
        trial_skip(trial); /* neither sum is of something smooth */
    } else {
        judge(trial, "light", light.value, light.error, (double[2]){truth[0].light, truth[1].light},
              1e-6 * truth[0].light + 1e-30);
    }
    judge_contrast(trial, &bundle, fmax(asked, 1e-7));
}
