/* analysis/mtf.c - contrast of the image of a field, by waves or by rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/mtf.h"

#include "base/constants.h"
#include "base/turns.h"

#include <math.h>

enum { FIRST_RAYS = 200, MOST_RAYS = 1 << 17 };

/* A complex sum for each direction, and what a perfect pupil has. */
struct sums {
    double re[MTF_DIRECTIONS], im[MTF_DIRECTIONS], perfect[MTF_DIRECTIONS], light;
};

bool mtf_open(const struct mtf_question *question, struct arena *arena, struct mtf_source *source,
              struct error *error)
{
    *source = (struct mtf_source){.question = question};
    if (!exit_pupils_open(&question->bundle, arena, &source->pupils, error)) {
        return false;
    }
    if (source->pupils.reference.is_angular) {
        return fail(error, ERROR_DOMAIN,
                    "the image lies infinitely far away: its lines have no frequency in mm");
    }
    const size_t count = source->pupils.lights.count;
    source->rules = overlap_rules_new(arena);
    source->lines = ARENA_ARRAY(arena, count * MTF_DIRECTIONS, struct exit_lines);
    source->fronts = ARENA_ARRAY(arena, count * MTF_DIRECTIONS, struct exit_front);
    wave_section(question->bundle.field, source->along[MTF_TANGENTIAL]);
    source->along[MTF_SAGITTAL][0] = source->along[MTF_TANGENTIAL][1];
    source->along[MTF_SAGITTAL][1] = 0.0 - source->along[MTF_TANGENTIAL][0];
    for (size_t i = 0; i < count * MTF_DIRECTIONS; i++) {
        const struct exit_pupil *pupil = &source->pupils.list[i / MTF_DIRECTIONS];
        const size_t k = i % MTF_DIRECTIONS;
        double range[2];
        exit_lines_find(pupil, source->along[k], arena, &source->lines[i]);
        exit_front_find(pupil, &source->lines[i], question->error, arena, &source->fronts[i]);
        exit_pupil_range(pupil, source->along[k], range);
        source->cutoff[k] =
            fmax(source->cutoff[k], (range[1] - range[0]) * pupil->n * pupil->waves);
    }
    return true;
}

/* One wavelength by waves. */
static void add_waves(const struct mtf_source *source, size_t g, double frequency,
                      struct sums *sums, struct mtf *mtf)
{
    const struct exit_pupil *pupil = &source->pupils.list[g];
    const struct overlap_question question = {.shift = frequency / (pupil->waves * pupil->n),
                                              .error = source->question->error,
                                              .only_perfect = source->question->by_rays};
    const double weight = exit_pupil_weight(pupil);
    sums->light += weight * pupil->energy;
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        const struct overlap sum =
            overlap_find(&source->fronts[g * MTF_DIRECTIONS + k], source->rules, &question);
        sums->re[k] += weight * sum.re;
        sums->im[k] += weight * sum.im;
        sums->perfect[k] += weight * sum.perfect;
        mtf->error = fmax(mtf->error, sum.error / pupil->energy);
        mtf->has_converged = mtf->has_converged && sum.has_converged;
    }
}

/* One wavelength by rays; its perfect sums stay as they are. */
static bool add_rays(const struct mtf_source *source, size_t g, size_t rays, double frequency,
                     struct arena *arena, struct sums *sums, struct error *error)
{
    const struct wave_light *light = &source->pupils.lights.list[g];
    const double unit = exit_pupil_weight(&source->pupils.list[g]);
    struct bundle bundle;
    light->source.region->in_beam = false;
    const bool traced =
        bundle_trace(&light->source, rays, light->system->places, arena, &bundle, error);
    for (size_t i = 0; traced && i < bundle.count; i++) {
        const struct ray_block *block = &bundle.rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK;
        const double weight = unit * bundle.points[i].weight;
        if (ray_block_status(block, lane) != RAY_OK) {
            continue;
        }
        const double off[2] = {block->x[lane] - source->pupils.reference.centre[0],
                               block->y[lane] - source->pupils.reference.centre[1]};
        sums->light += weight;
        for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
            double c, s;
            const double x = off[0] * source->along[k][0] + off[1] * source->along[k][1];
            turns_of(-frequency * x, &c, &s);
            sums->re[k] += weight * c;
            sums->im[k] += weight * s;
        }
    }
    return traced;
}

static bool sum_rays(const struct mtf_source *source, size_t rays, double frequency,
                     struct arena *arena, struct sums *sums, struct error *error)
{
    const struct arena_mark mark = arena_mark(arena);
    *sums = (struct sums){.light = 0};
    bool traced = true;
    for (size_t g = 0; g < source->pupils.lights.count && traced; g++) {
        traced = add_rays(source, g, rays, frequency, arena, sums, error);
    }
    arena_reset(arena, mark);
    return traced;
}

static bool find_by_rays(const struct mtf_source *source, double frequency, struct arena *arena,
                         struct sums *sums, struct mtf *mtf, struct error *error)
{
    struct sums finer;
    mtf->has_converged = false;
    if (!sum_rays(source, FIRST_RAYS, frequency, arena, sums, error)) {
        return false;
    }
    for (size_t rays = 2 * FIRST_RAYS; rays <= MOST_RAYS && !mtf->has_converged; rays *= 2) {
        if (!sum_rays(source, rays, frequency, arena, &finer, error)) {
            return false;
        }
        mtf->error = 1e-12;
        for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
            const double change = hypot(finer.re[k] / finer.light - sums->re[k] / sums->light,
                                        finer.im[k] / finer.light - sums->im[k] / sums->light);
            mtf->error = fmax(mtf->error, 2 * change);
        }
        *sums = finer;
        mtf->has_converged = mtf->error <= source->question->error;
    }
    return true;
}

/* The light and the overlap are two integrals, whose rounding differs. NaN stays. */
static double share_of(double part, double light)
{
    return part > light ? 1 : part / light;
}

bool mtf_find(const struct mtf_source *source, double frequency, struct arena *arena,
              struct mtf *mtf, struct error *error)
{
    struct sums waves = {.light = 0};
    *mtf = (struct mtf){.has_converged = true, .error = 1e-12};
    for (size_t g = 0; g < source->pupils.lights.count; g++) {
        if (source->pupils.lights.list[g].weight > 0) {
            add_waves(source, g, frequency, &waves, mtf);
        }
    }
    struct sums sums = waves;
    if (source->question->by_rays && !find_by_rays(source, frequency, arena, &sums, mtf, error)) {
        return false;
    }
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        mtf->contrast[k] = share_of(hypot(sums.re[k], sums.im[k]), sums.light);
        mtf->limit[k] = share_of(waves.perfect[k], waves.light);
        /* of nothing, and of what symmetry makes real */
        const bool is_real = fabs(sums.im[k]) < 1e-9 * sums.light;
        mtf->phase[k] = !(mtf->contrast[k] > 1e-9) ? (double)NAN
                        : is_real                  ? (sums.re[k] < 0 ? PI : 0)
                                                   : atan2(sums.im[k], sums.re[k]);
    }
    return true;
}
