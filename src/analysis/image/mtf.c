/* analysis/image/mtf.c - modulation transfer function of a field, diffraction or geometric. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/mtf.h"

#include "base/constants.h"
#include "base/instruction_set.h"

#include <math.h>

/* A complex sum for each direction, and what a perfect pupil has. */
struct mtf_sums {
    double re[MTF_DIRECTIONS], im[MTF_DIRECTIONS], perfect[MTF_DIRECTIONS], light;
};

/* -------- by rays -------- */

enum { FIRST_RAYS = 200, LEVELS = 10, LANES = MTF_RAYS_LANES };

/* Rays of all wavelengths, and where they arrive from the reference in two directions, mm. */
struct mtf_rays_level {
    size_t count; /* a multiple of the lanes; those at the end weigh 0 */
    double *places[2], *weights, light;
};

/* Traced when a frequency first wants them, for all frequencies: each has twice those before. */
struct mtf_rays {
    struct mtf_rays_level levels[LEVELS];
    size_t count;
};

/* The rays of one wavelength at the end of a level. */
static bool mtf_rays_add_light(const struct mtf_source *source, const struct wave_light *light,
                               size_t count, struct arena *arena, struct mtf_rays_level *level,
                               struct error *error)
{
    const double unit = wave_light_weight(light);
    struct bundle bundle;
    light->source.region->in_beam = false;
    if (!bundle_trace(&light->source, count, light->system->places, arena, &bundle, error)) {
        return false;
    }
    const size_t room = level->count + bundle.count + LANES;
    double *before[] = {level->places[0], level->places[1], level->weights};
    double **lists[] = {&level->places[0], &level->places[1], &level->weights};
    for (int k = 0; k < 3; k++) {
        *lists[k] = ARENA_ARRAY(arena, room, double);
        for (size_t i = 0; i < level->count; i++) {
            (*lists[k])[i] = before[k][i];
        }
    }
    for (size_t i = 0; i < bundle.count; i++) {
        const struct ray_block *block = &bundle.rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK;
        if (ray_block_status(block, lane) != RAY_OK) {
            continue;
        }
        const double *centre = source->pupils.reference.centre;
        const double off[2] = {block->x[lane] - centre[0], block->y[lane] - centre[1]};
        const double weight = unit * bundle.points[i].weight;
        for (int k = 0; k < 2; k++) {
            level->places[k][level->count] =
                off[0] * source->along[k][0] + off[1] * source->along[k][1];
        }
        level->weights[level->count++] = weight;
        level->light += weight;
    }
    level->count += (LANES - level->count % LANES) % LANES; /* these weigh 0 */
    return true;
}

/*
 * The mean of exp(-2 pi i frequency x), by energy: rays doubled from 200 to 102400 until twice the
 * last change is below the error that is wanted. Errors as bundle_trace.
 */
static bool mtf_rays_find(const struct mtf_source *source, double frequency, struct arena *arena,
                          struct mtf_sums *sums, struct mtf *mtf, struct error *error)
{
    *sums = (struct mtf_sums){.light = 1};
    mtf->has_converged = false;
    for (size_t l = 0; l < LEVELS && !mtf->has_converged; l++) {
        struct mtf_rays_level *level = &source->rays->levels[l];
        if (l == source->rays->count) {
            const size_t rays = (size_t)FIRST_RAYS << l;
            *level = (struct mtf_rays_level){.count = 0};
            for (size_t g = 0; g < source->pupils.lights.count; g++) {
                const struct wave_light *light = &source->pupils.lights.list[g];
                if (light->weight > 0 &&
                    !mtf_rays_add_light(source, light, rays, arena, level, error)) {
                    return false;
                }
            }
            source->rays->count++;
        }
        double worst = 1e-12;
        for (int k = 0; k < 2; k++) {
            double sum[2] = {0};
            KERNEL_FOR(SET_BEST, kernel_mtf_rays)
            (level->places[k], level->weights, level->count, -frequency, sum);
            const double re = sum[0] / level->light, im = sum[1] / level->light;
            worst = fmax(worst, 2 * hypot(re - sums->re[k], im - sums->im[k]));
            sums->re[k] = re;
            sums->im[k] = im;
        }
        mtf->error = l > 0 ? worst : INFINITY;
        mtf->has_converged = mtf->error <= source->question->error;
    }
    return true;
}

/* -------- diffraction MTF -------- */

static void find_fronts(struct mtf_source *source, struct arena *arena)
{
    const size_t count = source->pupils.lights.count;
    source->rules = gauss_rules_new(arena);
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
        if (source->pupils.lights.list[i / MTF_DIRECTIONS].weight > 0) {
            source->off[k] = isnan(off) ? INFINITY : fmax(source->off[k], off);
        }
        exit_pupil_range(pupil, source->along[k], range);
        source->cutoff[k] =
            fmax(source->cutoff[k], (range[1] - range[0]) * pupil->n * pupil->waves);
    }
}

bool mtf_open(const struct mtf_question *question, struct arena *arena, struct mtf_source *source,
              struct error *error)
{
    *source = (struct mtf_source){.question = question};
    /* The pupils; by rays it does without where there are no optical paths. */
    struct exit_pupils *pupils = &source->pupils;
    if (!exit_pupils_open(&question->bundle, arena, pupils, error)) {
        if (!question->by_rays || pupils->reference.no_opd == NULL) {
            return false;
        }
        error->code = ERROR_NONE;
        pupils->list = NULL;
        pupils->islands = bundle_islands(&pupils->lights.list[0].source, arena);
    }
    if (pupils->reference.is_angular) {
        return fail(error, ERROR_DOMAIN,
                    "the image lies infinitely far away: its lines have no frequency in mm");
    }
    const struct field_point *field = question->bundle.field;
    const bool on_axis =
        field->kind == FIELD_NONE || !(hypot(field->value[0], field->value[1]) > 0);
    /* the image of a field on the axis of a round lens is the same in all directions */
    source->directions = lens_is_round(question->bundle.setup->lens) && on_axis ? MTF_TANGENTIAL + 1
                                                                                : MTF_DIRECTIONS;
    wave_section(question->bundle.field, source->along[MTF_TANGENTIAL]);
    source->along[MTF_SAGITTAL][0] = source->along[MTF_TANGENTIAL][1];
    source->along[MTF_SAGITTAL][1] = 0.0 - source->along[MTF_TANGENTIAL][0];
    source->rays = question->by_rays ? ARENA_NEW(arena, struct mtf_rays) : NULL;
    if (source->pupils.list != NULL) {
        find_fronts(source, arena);
    } else {
        source->cutoff[0] = source->cutoff[1] = NAN;
    }
    return true;
}

/* The diffraction MTF at one wavelength. */
static void mtf_add_waves(const struct mtf_source *source, size_t g, double frequency,
                          struct mtf_sums *sums, struct mtf *mtf)
{
    const struct exit_pupil *pupil = &source->pupils.list[g];
    const double shift = frequency / (pupil->waves * pupil->n);
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
        const bool only_perfect = source->question->by_rays || isnan(sums->re[k]);
        const struct overlap sum =
            overlap_find(&source->fronts[g * MTF_DIRECTIONS + k], source->rules, shift,
                         source->question->error, only_perfect);
        sums->re[k] += weight * sum.re;
        sums->im[k] += weight * sum.im;
        sums->perfect[k] += weight * sum.perfect;
        mtf->error = fmax(mtf->error, sum.error / pupil->energy);
        mtf->has_converged = mtf->has_converged && sum.has_converged;
    }
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
    if (source->rays != NULL && !mtf_rays_find(source, frequency, arena, &sums, mtf, error)) {
        return false;
    }
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        mtf->contrast[k] = mtf_share_of(hypot(sums.re[k], sums.im[k]), sums.light);
        mtf->limit[k] = mtf_share_of(waves.perfect[k], waves.light);
        /* of nothing, and of what symmetry makes real */
        const bool is_real = fabs(sums.im[k]) < 1e-9 * sums.light;
        mtf->phase[k] = atan2(is_real ? 0 : sums.im[k], sums.re[k]);
        if (!(mtf->contrast[k] > 1e-9)) {
            mtf->phase[k] = NAN;
        }
    }
    return true;
}

/* -------- square bars -------- */

double mtf_square_pixels(double frequency, double pitch)
{
    const double x = isnan(pitch) ? 0 : PI * frequency * pitch;
    return x > 0 ? sin(x) / x : 1;
}

bool mtf_square_find(const struct mtf_source *source, double frequency, double pitch,
                     struct arena *arena, struct mtf *mtf, struct error *error)
{
    enum { HARMONICS = 128 };
    double sums[MTF_DIRECTIONS] = {0}, limits[MTF_DIRECTIONS] = {0}, off = 0;
    const double cutoff = fmax(source->cutoff[0], source->cutoff[1]);
    const double turned = mtf_square_pixels(frequency, pitch) < 0 ? -1 : 1;
    struct mtf first;
    if (!mtf_find(source, frequency, arena, &first, error)) {
        return false;
    }
    *mtf = first;
    for (int k = 0; k < HARMONICS && frequency > 0; k++) {
        const double n = 2 * k + 1;
        struct mtf here = first;
        if (source->rays == NULL && n * frequency > cutoff) {
            break;
        }
        if (k > 0 && !mtf_find(source, n * frequency, arena, &here, error)) {
            return false;
        }
        const double sign = k % 2 == 0 ? 1 : -1;
        double left = 4 / PI * sign / n * turned * mtf_square_pixels(n * frequency, pitch);
        if (k == HARMONICS - 1) {
            left /= 2; /* the sum lies between the last and the one before */
        }
        for (size_t d = 0; d < MTF_DIRECTIONS; d++) {
            const double phase = isnan(here.phase[d]) || isnan(first.phase[d])
                                     ? 0
                                     : here.phase[d] - n * first.phase[d];
            sums[d] += left * here.contrast[d] * cos(phase);
            limits[d] += left * here.limit[d];
        }
        off += fabs(left) * here.error;
    }
    for (size_t d = 0; d < MTF_DIRECTIONS && frequency > 0; d++) {
        mtf->contrast[d] = sums[d];
        mtf->limit[d] = limits[d];
        mtf->error = off;
        mtf->has_converged = off <= 4 * source->question->error; /* of 4/pi (1 + 1/3 + 1/5 ...) */
    }
    return true;
}
