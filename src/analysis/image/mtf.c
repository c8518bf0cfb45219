/* analysis/image/mtf.c - contrast of the image of a field, by waves or by rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/mtf.h"

#include "base/constants.h"

#include <math.h>
#include <string.h>

/* A complex sum for each direction, and what a perfect pupil has. */
struct mtf_sums {
    double re[MTF_DIRECTIONS], im[MTF_DIRECTIONS], perfect[MTF_DIRECTIONS], light;
};

/* The pupils; by rays it does without where there are no optical paths. */
static bool mtf_open_pupils(struct mtf_source *source, struct arena *arena, struct error *error)
{
    const struct mtf_question *question = source->question;
    struct exit_pupils *pupils = &source->pupils;
    if (!exit_pupils_open(&question->bundle, arena, pupils, error)) {
        if (!question->by_rays || pupils->reference.no_opd == NULL) {
            return false;
        }
        error->code = ERROR_NONE;
        pupils->list = NULL;
        pupils->islands = bundle_islands(&pupils->lights.list[0].source, arena);
    }
    return !pupils->reference.is_angular ||
           fail(error, ERROR_DOMAIN,
                "the image lies infinitely far away: its lines have no frequency in mm");
}

static void find_fronts(struct mtf_source *source, struct arena *arena)
{
    const size_t count = source->pupils.lights.count;
    source->rules = overlap_rules_new(arena);
    source->lines = ARENA_ARRAY(arena, count * MTF_DIRECTIONS, struct exit_lines);
    source->fronts = ARENA_ARRAY(arena, count * MTF_DIRECTIONS, struct exit_front);
    for (size_t i = 0; i < count * MTF_DIRECTIONS; i++) {
        const struct exit_pupil *pupil = &source->pupils.list[i / MTF_DIRECTIONS];
        const size_t k = i % MTF_DIRECTIONS;
        double range[2];
        if (k >= source->directions) {
            source->fronts[i] = source->fronts[i - 1];
            source->off[k] = source->off[k - 1];
            source->cutoff[k] = source->cutoff[k - 1];
            continue;
        }
        exit_lines_find(pupil, source->along[k], arena, &source->lines[i]);
        exit_front_find(pupil, &source->lines[i], source->question->error, arena,
                        &source->fronts[i]);
        const double off = source->fronts[i].off;
        const bool counts = source->pupils.lights.list[i / MTF_DIRECTIONS].weight > 0;
        source->off[k] =
            counts ? fmax(source->off[k], isnan(off) ? INFINITY : off) : source->off[k];
        exit_pupil_range(pupil, source->along[k], range);
        source->cutoff[k] =
            fmax(source->cutoff[k], (range[1] - range[0]) * pupil->n * pupil->waves);
    }
}

/* Is the image of a field the same in all directions? */
static bool is_alike_about(const struct lens *lens, const struct field_point *field)
{
    return lens_is_round(lens) &&
           (field->kind == FIELD_NONE || !(hypot(field->value[0], field->value[1]) > 0));
}

bool mtf_open(const struct mtf_question *question, struct arena *arena, struct mtf_source *source,
              struct error *error)
{
    *source = (struct mtf_source){.question = question};
    if (!mtf_open_pupils(source, arena, error)) {
        return false;
    }
    source->directions = is_alike_about(question->bundle.setup->lens, question->bundle.field)
                             ? MTF_TANGENTIAL + 1
                             : MTF_DIRECTIONS;
    wave_section(question->bundle.field, source->along[MTF_TANGENTIAL]);
    source->along[MTF_SAGITTAL][0] = source->along[MTF_TANGENTIAL][1];
    source->along[MTF_SAGITTAL][1] = 0.0 - source->along[MTF_TANGENTIAL][0];
    if (question->by_rays) {
        source->rays = ARENA_NEW(arena, struct mtf_rays);
        source->rays->lights = source->pupils.lights;
        memcpy(source->rays->along, source->along, sizeof source->along);
        memcpy(source->rays->centre, source->pupils.reference.centre, sizeof source->rays->centre);
    }
    if (source->pupils.list != NULL) {
        find_fronts(source, arena);
    } else {
        source->cutoff[0] = source->cutoff[1] = NAN;
    }
    return true;
}

/* One wavelength by waves. */
static void mtf_add_waves(const struct mtf_source *source, size_t g, double frequency,
                          struct mtf_sums *sums, struct mtf *mtf)
{
    const struct exit_pupil *pupil = &source->pupils.list[g];
    struct overlap_question question = {.shift = frequency / (pupil->waves * pupil->n),
                                        .error = source->question->error};
    const double weight = exit_pupil_weight(pupil);
    sums->light += weight * pupil->energy;
    for (size_t k = 0; k < source->directions; k++) {
        if (!overlap_is_known(source->off[k])) {
            sums->re[k] = sums->im[k] = sums->perfect[k] = NAN;
            mtf->error = INFINITY;
            mtf->has_converged = false;
            continue;
        }
        /* where a wavelength has none before, there is none of all together */
        question.only_perfect = source->question->by_rays || isnan(sums->re[k]);
        const struct overlap sum =
            overlap_find(&source->fronts[g * MTF_DIRECTIONS + k], source->rules, &question);
        sums->re[k] += weight * sum.re;
        sums->im[k] += weight * sum.im;
        sums->perfect[k] += weight * sum.perfect;
        mtf->error = fmax(mtf->error, sum.error / pupil->energy);
        mtf->has_converged = mtf->has_converged && sum.has_converged;
    }
}

static bool mtf_find_by_rays(const struct mtf_source *source, double frequency, struct arena *arena,
                             struct mtf_sums *sums, struct mtf *mtf, struct error *error)
{
    struct mtf_rays_sums rays;
    if (!mtf_rays_find(source->rays, frequency, source->question->error, arena, &rays, error)) {
        return false;
    }
    memcpy(sums->re, rays.re, sizeof sums->re);
    memcpy(sums->im, rays.im, sizeof sums->im);
    sums->light = 1;
    mtf->error = rays.error;
    mtf->has_converged = rays.has_converged;
    return true;
}

/* The light and the overlap are two integrals, whose rounding differs. NaN stays. */
static double mtf_share_of(double part, double light)
{
    return part > light ? 1 : part / light;
}

bool mtf_find(const struct mtf_source *source, double frequency, struct arena *arena,
              struct mtf *mtf, struct error *error)
{
    struct mtf_sums waves = {.light = 0};
    *mtf = (struct mtf){.has_converged = true, .error = 1e-12};
    for (size_t g = 0; g < source->pupils.lights.count && source->pupils.list != NULL; g++) {
        if (source->pupils.lights.list[g].weight > 0) {
            mtf_add_waves(source, g, frequency, &waves, mtf);
        }
    }
    for (size_t k = source->directions; k < MTF_DIRECTIONS; k++) {
        waves.re[k] = waves.re[0];
        waves.im[k] = waves.im[0];
        waves.perfect[k] = waves.perfect[0];
    }
    struct mtf_sums sums = waves;
    if (source->rays != NULL && !mtf_find_by_rays(source, frequency, arena, &sums, mtf, error)) {
        return false;
    }
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        mtf->contrast[k] = mtf_share_of(hypot(sums.re[k], sums.im[k]), sums.light);
        mtf->limit[k] = mtf_share_of(waves.perfect[k], waves.light);
        /* of nothing, and of what symmetry makes real */
        const bool is_real = fabs(sums.im[k]) < 1e-9 * sums.light;
        mtf->phase[k] = !(mtf->contrast[k] > 1e-9) ? (double)NAN
                        : is_real                  ? (sums.re[k] < 0 ? PI : 0)
                                                   : atan2(sums.im[k], sums.re[k]);
    }
    return true;
}
