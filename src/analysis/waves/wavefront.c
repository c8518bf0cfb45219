/* analysis/waves/wavefront.c - the wave front of a field against its reference. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/wavefront.h"

#include "base/constants.h"
#include "base/linear.h"
#include "base/turns.h"
#include "trace/dispatch.h"

#include <math.h>

enum { FIRST_RAYS = 130, MOST_RAYS = 1 << 17, RAYS_A_TERM = 8 };

/* What rounding of paths leaves, wavelengths. */
static const double least = 1e-9;
/* Rays at the edge lie so far within it that rounding does not clip them. */
static const double edge = 1 - 1e-12;

bool wavefront_open(const struct wavefront_question *question, struct arena *arena,
                    struct wavefront_source *source, struct error *error)
{
    *source = (struct wavefront_source){.question = question};
    if (!wave_open(&question->bundle, arena, &source->lights, error) ||
        !wave_reference_find(&source->lights, question->about, arena, &source->reference, error)) {
        return false;
    }
    const struct wave_light *light = &source->lights.list[0];
    source->zero = opd_path(&source->reference.opd, &light->chief);
    source->waves = 1000 / light->wavelength;
    return source->reference.no_opd == NULL ||
           fail(error, ERROR_DOMAIN, "%s", source->reference.no_opd);
}

/* W of a ray that arrives, wavelengths; NaN: it is lost, or misses the reference sphere. */
static double wave_of(const struct wavefront_source *source, const struct rays *rays, size_t i)
{
    const struct ray ray = rays_get(rays, i, source->lights.list[0].system->index_last);
    return ray.status == RAY_OK
               ? (source->zero - opd_path(&source->reference.opd, &ray)) * source->waves
               : (double)NAN;
}

/* Values with their weights. */
struct wavefront_values {
    double *waves;
    const struct pupil_point *points;
    size_t count, arms, rings; /* as a bundle has them */
    double clear;
    double missed; /* share of the light that arrives and misses the reference sphere */
};

static bool wavefront_find_values(const struct wavefront_source *source, size_t rays,
                                  struct arena *arena, struct wavefront_values *values,
                                  struct error *error)
{
    const struct bundle_source *from = &source->lights.list[0].source;
    struct bundle bundle;
    if (!bundle_trace(from, rays, from->system->places, arena, &bundle, error)) {
        return false;
    }
    *values = (struct wavefront_values){.waves = ARENA_ARRAY(arena, bundle.count, double),
                                        .points = bundle.points,
                                        .count = bundle.count,
                                        .arms = bundle.arms,
                                        .rings = bundle.rings,
                                        .clear = bundle.clear};
    double arrived = 0, missed = 0;
    for (size_t i = 0; i < bundle.count; i++) {
        values->waves[i] = wave_of(source, &bundle.rays, i);
        if (ray_block_status(&bundle.rays.blocks[i / RAYS_BLOCK], i % RAYS_BLOCK) == RAY_OK) {
            arrived += bundle.points[i].weight;
            missed += isnan(values->waves[i]) ? bundle.points[i].weight : 0;
        }
    }
    values->missed = missed > 0 ? missed / arrived : 0;
    return true;
}

/* -------- means -------- */

/* The figures of one sample, and how well it resolves the phase. */
struct sampled {
    struct wavefront figures;
    double steepest;   /* most turns from a point to a neighbour */
    double unresolved; /* share of the light where they are too many, less of what is nearly so */
};

/* Where the phase turns more than this from a point to the next, waves that turn faster look slow:
   at a whole turn, where nothing is resolved, they look as if they stood. */
static const double resolved = 0.5;

/* Highest less lowest. */
static double values_span(const struct wavefront_values *values)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < values->count; i++) {
        low = fmin(low, values->waves[i]);
        high = fmax(high, values->waves[i]);
    }
    return high - low;
}

/*
 * How much W turns between neighbouring rays, and the share of the light where that is too much.
 * Neighbours lie inwards, outwards and on either side. Of points without order none are known: they
 * lie sqrt(pi/count) of the radius apart, and W is as steep as five spans a radius.
 */
static void wavefront_find_turns(const struct wavefront_values *values, struct arena *arena,
                                 struct sampled *sampled)
{
    const size_t arms = values->arms, rings = values->rings, count = values->count;
    const double span = values_span(values);
    double *steepest = ARENA_ARRAY(arena, count, double), unresolved = 0, all = 0;
    for (size_t i = 0; i < count; i++) {
        steepest[i] = arms == 0 ? 5 * span * sqrt(PI / (double)count) : 0;
    }
    for (size_t i = 0; i < count && arms > 0; i++) {
        const size_t beside = i % arms + 1 < arms ? i + 1 : i + 1 - arms;
        const size_t outwards = i / arms % rings + 1 < rings ? i + arms : i;
        const size_t others[] = {beside, outwards};
        for (size_t k = 0; k < 2; k++) {
            const double turns = fabs(values->waves[others[k]] - values->waves[i]);
            steepest[i] = fmax(steepest[i], turns);
            steepest[others[k]] = fmax(steepest[others[k]], turns);
        }
    }
    sampled->steepest = 0;
    for (size_t i = 0; i < count; i++) {
        const double weight = isnan(values->waves[i]) ? 0 : values->points[i].weight;
        const double beyond = (steepest[i] - resolved) / (1 - resolved);
        all += weight;
        unresolved += weight * fmax(fmin(beyond, 1), 0);
        sampled->steepest = fmax(sampled->steepest, steepest[i]);
    }
    sampled->unresolved = unresolved / all;
}

static void wavefront_sum_up(const struct wavefront_values *values, struct wavefront *wavefront)
{
    double weight = 0, mean = 0, square = 0, re = 0, im = 0;
    for (size_t i = 0; i < values->count; i++) {
        if (!isnan(values->waves[i])) {
            weight += values->points[i].weight;
            mean += values->points[i].weight * values->waves[i];
        }
    }
    mean /= weight;
    for (size_t i = 0; i < values->count; i++) {
        const double wave = values->waves[i] - mean;
        if (!isnan(wave)) {
            const double w = values->points[i].weight;
            double c, s;
            turns_of(wave, &c, &s);
            square += w * wave * wave;
            re += w * c;
            im += w * s;
        }
    }
    wavefront->mean = mean;
    wavefront->rms = sqrt(square / weight);
    wavefront->strehl = (re * re + im * im) / (weight * weight);
    const double turn = 2 * PI * wavefront->rms;
    wavefront->marechal = exp(-turn * turn);
    wavefront->clear = values->clear;
    wavefront->missed = values->missed;
    wavefront->rays = values->count;
}

static bool wavefront_measure(const struct wavefront_source *source, size_t rays,
                              struct arena *arena, struct sampled *sampled, struct error *error)
{
    const struct arena_mark mark = arena_mark(arena);
    struct wavefront_values values;
    const bool found = wavefront_find_values(source, rays, arena, &values, error);
    if (found) {
        sampled->figures = (struct wavefront){.rms = NAN};
        wavefront_sum_up(&values, &sampled->figures);
        wavefront_find_turns(&values, arena, sampled);
    }
    arena_reset(arena, mark);
    return found;
}

/* -------- extremes -------- */

enum { DIRECTIONS = 64, RINGS = 12, INNER = 3, BESIDE = 5, LOOKS = 12, MOST_LOOKS = 48 };

/* A place of the clear part: an angle and a share of the way to the edge. */
struct wavefront_place {
    double angle, share, wave;
};

/* Look at places of some angles times some shares; keep the highest and the lowest. */
static void wavefront_look(const struct wavefront_source *source, const double *angles,
                           size_t angle_count, const double *shares, size_t share_count,
                           struct arena *arena, struct wavefront_place extremes[2])
{
    const struct arena_mark mark = arena_mark(arena);
    const struct wave_light *light = &source->lights.list[0];
    const struct quadrature_region *region = light->source.region;
    const struct quadrature_rim rim = quadrature_edge(region, angles, angle_count, NULL, 0, arena);
    struct rays rays = rays_new(arena, angle_count);
    for (size_t k = 0; k < share_count; k++) {
        if (!(shares[k] >= 0 && shares[k] <= 1)) {
            continue;
        }
        quadrature_rays_within(region, &rim, &(double){shares[k] * edge}, 1, &rays);
        rays_trace(light->system, &rays, NULL);
        for (size_t i = 0; i < angle_count; i++) {
            const double wave = wave_of(source, &rays, i);
            if (wave > extremes[0].wave) {
                extremes[0] = (struct wavefront_place){angles[i], shares[k], wave};
            }
            if (wave < extremes[1].wave) {
                extremes[1] = (struct wavefront_place){angles[i], shares[k], wave};
            }
        }
    }
    arena_reset(arena, mark);
}

/* Highest less lowest. */
static double wavefront_find_extremes(const struct wavefront_source *source, struct arena *arena)
{
    const struct pupil_boundary *boundary =
        quadrature_boundary(source->lights.list[0].source.region, arena);
    double angles[DIRECTIONS + PUPIL_BOUNDARY_CORNERS], shares[RINGS + INNER];
    size_t count = 0;
    struct wavefront_place extremes[2] = {{.wave = -INFINITY}, {.wave = INFINITY}};
    if (boundary == NULL) {
        return NAN;
    }
    for (; count < DIRECTIONS; count++) {
        angles[count] = 2 * PI * (double)count / DIRECTIONS;
    }
    for (size_t i = 0; i < boundary->corner_count; i++) {
        angles[count++] = boundary->corners[i];
    }
    for (size_t k = 0; k < RINGS; k++) {
        shares[k] = (double)k / (RINGS - 1);
    }
    /* closer to the middle, from which no single direction leads to a place beside it */
    for (size_t k = 0; k < INNER; k++) {
        shares[RINGS + k] = shares[1] * (double)(k + 1) / (INNER + 1);
    }
    wavefront_look(source, angles, count, shares, RINGS + INNER, arena, extremes);
    for (size_t k = 0; k < 2; k++) {
        double turn = PI / DIRECTIONS, way = 0.5 / (RINGS - 1);
        for (size_t i = 0, halved = 0; i < MOST_LOOKS && halved < LOOKS; i++) {
            const struct wavefront_place at = extremes[k];
            for (size_t j = 0; j < BESIDE; j++) {
                const double off = (double)j - BESIDE / 2;
                angles[j] = at.angle + turn * off;
                shares[j] = fmin(at.share + way * off, 1);
            }
            wavefront_look(source, angles, BESIDE, shares, BESIDE, arena, extremes);
            /* at the margin of what was looked at: it may rise further beyond */
            if (fabs(extremes[k].angle - at.angle) < 1.5 * turn &&
                fabs(extremes[k].share - at.share) < 1.5 * way) {
                turn /= 2;
                way /= 2;
                halved++;
            }
        }
    }
    return extremes[0].wave - extremes[1].wave;
}

/* -------- the whole -------- */

/*
 * What a Strehl ratio S may be off, by what twice the rays change of it. Two samples may agree by
 * chance where the phase turns too fast for them: unresolved light of the share e can add e to the
 * mean of the waves. Where that is most of the light its phases count as random, which they are but
 * for chance: S is then within a few times the larger sample's and what so many of them leave.
 */
static double strehl_error_of(const struct sampled *here, const struct sampled *finer, double times)
{
    const double change = fabs(finer->figures.strehl - here->figures.strehl);
    const double high = fmax(finer->figures.strehl, here->figures.strehl);
    const double rays = (double)here->figures.rays, e = finer->unresolved;
    const double coherent = e * (2 * sqrt(high) + e), random = 4 * high + 8 * e * e / rays;
    return fmax(times * change, fmin(coherent, random));
}

/* The figures of two samples, the other of twice the rays. */
static struct wavefront wavefront_figures_of(const struct wavefront_source *source,
                                             const struct sampled *before,
                                             const struct sampled *finer)
{
    const struct wavefront_question *question = source->question;
    /* plain patterns are off as one over the root of their rays, by 3.4 times the change */
    const double times = question->bundle.pattern == PATTERN_GAUSS ? 2 : 4;
    struct wavefront here = question->rays > 0 ? before->figures : finer->figures;
    const double change = fabs(finer->figures.rms - before->figures.rms);
    here.error = fmax(times * change, least) + source->reference.doubt;
    /* the slope of the mean wave is at most 2 pi */
    const double by_reference = 4 * PI * sqrt(here.strehl) * source->reference.doubt;
    here.strehl_error = fmax(strehl_error_of(before, finer, times), least) + by_reference;
    here.has_converged = here.error <= question->error * here.rms + least &&
                         here.strehl_error <= question->error + least;
    return here;
}

/* Doubled again and again; where the phase says how many rays resolve it, so many at once. */
static bool wavefront_converge(const struct wavefront_source *source, struct arena *arena,
                               struct wavefront *wavefront, struct error *error)
{
    const struct wavefront_question *question = source->question;
    size_t rays = question->rays > 0 ? question->rays : FIRST_RAYS;
    const bool is_orderly = question->bundle.pattern == PATTERN_GAUSS;
    struct sampled before, finer;
    if (!wavefront_measure(source, rays, arena, &before, error) ||
        !wavefront_measure(source, 2 * rays, arena, &finer, error)) {
        return false;
    }
    *wavefront = wavefront_figures_of(source, &before, &finer);
    while (question->rays == 0 && !wavefront->has_converged && 2 * rays < MOST_RAYS) {
        const double turns = finer.steepest / resolved;
        const double wanted = fmin((double)rays * turns * turns / 2, MOST_RAYS / 2);
        const bool is_far = is_orderly && wanted > 3 * (double)rays;
        rays = is_far ? (size_t)wanted : 2 * rays;
        before = finer;
        if ((is_far && !wavefront_measure(source, rays, arena, &before, error)) ||
            !wavefront_measure(source, 2 * rays, arena, &finer, error)) {
            return false;
        }
        *wavefront = wavefront_figures_of(source, &before, &finer);
    }
    return true;
}

/* The figures of the first wavelength. */
static bool wavefront_find_one(const struct wavefront_source *source, bool wants_pv,
                               struct arena *arena, struct wavefront *wavefront,
                               struct error *error)
{
    const struct wavefront_question *question = source->question;
    struct wavefront_values values;
    *wavefront = (struct wavefront){.rms = NAN};
    if (!wavefront_converge(source, arena, wavefront, error)) {
        return false;
    }
    wavefront->pv = NAN;
    if (wants_pv && question->bundle.pattern == PATTERN_GAUSS) {
        wavefront->pv = wavefront_find_extremes(source, arena);
    } else if (wants_pv) { /* of patterns that fill no region: of their rays */
        if (!wavefront_find_values(source, wavefront->rays, arena, &values, error)) {
            return false;
        }
        wavefront->pv = values_span(&values);
    }
    wavefront->radius = source->reference.opd.is_plane ? INFINITY : source->reference.opd.radius;
    wavefront->islands = bundle_islands(&source->lights.list[0].source, arena);
    return true;
}

/* What several wavelengths add up to. */
struct wavefront_sums {
    double weight, square, error_square; /* of mean squares */
    double light, strehl, strehl_error;  /* by weights over squared wavelengths */
    double clear, missed;
    size_t rays;
    bool has_converged;
};

static void wavefront_add_light(const struct wave_light *light, const struct wavefront *one,
                                struct wavefront_sums *sums)
{
    const double weight = light->weight;
    const double peak = weight / (light->wavelength * light->wavelength);
    sums->weight += weight;
    sums->square += weight * one->rms * one->rms;
    sums->error_square += weight * one->error * one->error;
    sums->light += peak;
    sums->strehl += peak * one->strehl;
    sums->strehl_error += peak * one->strehl_error;
    sums->clear += weight * one->clear;
    sums->missed += weight * one->missed;
    sums->rays += one->rays;
    sums->has_converged = sums->has_converged && one->has_converged;
}

bool wavefront_find(const struct wavefront_source *source, bool wants_pv, struct arena *arena,
                    struct wavefront *wavefront, struct error *error)
{
    struct wavefront_sums sums = {.has_converged = true};
    if (source->lights.count == 1) {
        return wavefront_find_one(source, wants_pv, arena, wavefront, error);
    }
    for (size_t g = 0; g < source->lights.count; g++) {
        struct wavefront_source each = *source;
        struct wavefront one;
        each.lights.list += g;
        each.zero = opd_path(&source->reference.opd, &each.lights.list[0].chief);
        each.waves = 1000 / each.lights.list[0].wavelength;
        if (!(each.lights.list[0].weight > 0)) {
            continue;
        }
        if (!wavefront_find_one(&each, false, arena, &one, error)) {
            return false;
        }
        wavefront_add_light(&each.lights.list[0], &one, &sums);
        *wavefront = one;
    }
    wavefront->rms = sqrt(sums.square / sums.weight);
    wavefront->error = sqrt(sums.error_square / sums.weight);
    wavefront->strehl = sums.strehl / sums.light;
    wavefront->strehl_error = sums.strehl_error / sums.light;
    wavefront->marechal = exp(-pow(2 * PI * wavefront->rms, 2));
    wavefront->mean = wavefront->pv = NAN;
    wavefront->clear = sums.clear / sums.weight;
    wavefront->missed = sums.missed / sums.weight;
    wavefront->rays = sums.rays;
    wavefront->has_converged = sums.has_converged;
    return true;
}

bool wavefront_fit(const struct wavefront_source *source, enum zernike_kind kind, size_t terms,
                   struct arena *arena, struct wavefront_fit *fit, struct error *error)
{
    struct wavefront_values values;
    const size_t asked = source->question->rays;
    const size_t enough = asked > 0 ? asked : RAYS_A_TERM * terms + 4 * FIRST_RAYS;
    if (!wavefront_find_values(source, enough, arena, &values, error)) {
        return false;
    }
    double *a = ARENA_ARRAY(arena, values.count * terms, double);
    double *b = ARENA_ARRAY(arena, values.count, double);
    double *x = ARENA_ARRAY(arena, terms, double);
    size_t rows = 0;
    for (size_t i = 0; i < values.count; i++) {
        const struct pupil_point *point = &values.points[i];
        if (isnan(values.waves[i]) || !(point->weight > 0)) {
            continue;
        }
        const double root = sqrt(point->weight / values.clear);
        zernike_fill(kind, terms, point->x, point->y, a + rows * terms);
        for (size_t k = 0; k < terms; k++) {
            a[rows * terms + k] *= root;
        }
        b[rows++] = root * values.waves[i];
    }
    const struct linear_factors factors = linear_factor(a, rows, terms, 1e-9, arena);
    if (factors.rank < terms) {
        return fail(error, ERROR_DOMAIN,
                    "%zu rays through what is clear of the pupil tell no more than %zu of %zu "
                    "terms apart: fewer {terms}",
                    rows, factors.rank, terms);
    }
    linear_reflect(&factors, b);
    double left = 0;
    for (size_t i = factors.rank; i < rows; i++) {
        left += b[i] * b[i];
    }
    linear_substitute(&factors, b, x);
    for (size_t i = 0; i < terms; i++) {
        x[i] = fabs(x[i]) < least ? 0 : x[i]; /* what symmetry makes 0 but for rounding */
    }
    *fit = (struct wavefront_fit){x, sqrt(left), values.missed, rows};
    return true;
}

const double *wavefront_map(const struct wavefront_source *source, size_t size, struct arena *arena)
{
    const struct wave_light *light = &source->lights.list[0];
    const size_t count = size * size;
    struct pupil_point *points = ARENA_ARRAY(arena, count, struct pupil_point);
    size_t *place = ARENA_ARRAY(arena, count, size_t), within = 0;
    double *values = ARENA_ARRAY(arena, count, double);
    for (size_t i = 0; i < count; i++) {
        const double x = (2 * (double)(i % size) + 1) / (double)size - 1;
        const double y = (2 * (double)(i / size) + 1) / (double)size - 1;
        values[i] = NAN;
        if (x * x + y * y <= 1) {
            points[within] = (struct pupil_point){x, y, 1};
            place[within++] = i;
        }
    }
    struct rays rays = rays_new(arena, within);
    bundle_aim(&light->source, points, within, &rays);
    rays_trace(light->system, &rays, NULL);
    for (size_t i = 0; i < within; i++) {
        values[place[i]] = wave_of(source, &rays, i);
    }
    return values;
}
