/* analysis/real/real_focus.c - how sharp a point on the axis is, by a lens's own rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/real/real_focus.h"

#include "analysis/pupil/bundle.h"
#include "base/constants.h"

#include <float.h>
#include <math.h>

enum { FIRST_RAYS = 60 };

/* How well blurs are known, relative to them; how many rays of a wavelength are taken at most. */
struct precision {
    double blur;
    size_t rays;
    double film; /* where it is sharpest, of as far as rays spread there */
};

/* Means of smooth functions converge fast; how much light a disc holds has corners. */
static const struct precision precisions[] = {
    [BLUR_RMS] = {1e-9, 1 << 13, 0},
    [BLUR_ENERGY] = {1e-3, 1 << 11, 1e-4},
    [BLUR_MTF] = {1e-6, 1 << 13, 1e-8},
};

/* Of 2 J1(u)/u: where it is lowest first. */
static const double lobe = 5.1356223018406826;

/* Blurs below this do not differ, mm. */
static const double nothing = 1e-12;

/* -------- the rays of a point -------- */

/* Rays of all wavelengths while they are gathered. */
struct focus_rays {
    const struct real_focus *focus;
    double (*at)[2], (*slope)[2];
    struct encircled_energy_mark *marks;
    size_t count, room;
    bool has_arms;
    const struct encircled_energy_sheet *sheets;
};

/* Lines behind the last vertex, by where they cross its plane. */
static void real_focus_gather(struct focus_rays *all, const struct bundle *bundle, double weight)
{
    struct encircled_energy_arms arms =
        encircled_energy_arms_open(bundle, all->sheets, all->focus->arena);
    struct arena *arena = all->focus->arena;
    const struct focus_rays old = *all;
    all->room += bundle->count;
    all->at = arena_array(arena, all->room, sizeof *all->at);
    all->slope = arena_array(arena, all->room, sizeof *all->slope);
    all->marks = ARENA_ARRAY(arena, all->room, struct encircled_energy_mark);
    for (size_t i = 0; i < old.count; i++) {
        for (int k = 0; k < 2; k++) {
            all->at[i][k] = old.at[i][k];
            all->slope[i][k] = old.slope[i][k];
        }
        all->marks[i] = old.marks[i];
    }
    all->has_arms = bundle->arms > 0;
    for (size_t i = 0; i < bundle->count; i++) {
        const struct ray_block *block = &bundle->rays.blocks[i / RAYS_BLOCK];
        const size_t lane = i % RAYS_BLOCK, n = all->count;
        const bool arrives = ray_block_status(block, lane) == RAY_OK;
        if (arrives) {
            const double a = block->p[lane] / block->r[lane], b = block->q[lane] / block->r[lane];
            all->at[n][0] = block->x[lane] - a * block->z[lane];
            all->at[n][1] = block->y[lane] - b * block->z[lane];
            all->slope[n][0] = a;
            all->slope[n][1] = b;
            all->marks[n].weight = weight * bundle->points[i].weight;
            all->count++;
        }
        encircled_energy_arms_add(&arms, i, all->marks, arrives ? n : ENCIRCLED_ENERGY_ALONE);
    }
    all->sheets = arms.sheets;
}

static bool trace_all(struct focus_rays *all, double object, struct error *error)
{
    const struct real_focus *focus = all->focus;
    const struct field_point axis = {.kind = FIELD_NONE};
    struct setup_question asked = focus->asked;
    struct setup setup;
    asked.object = &object;
    if (!setup_open(&asked, focus->arena, &setup, error)) {
        return false;
    }
    for (size_t g = 0; g < setup.wavelength_count; g++) {
        const struct bundle_question question = {
            .setup = &setup,
            .field = &axis,
            .wavelength = g,
            .clip = true,
            .weight = WEIGHT_PUPIL,
            .pattern = PATTERN_GAUSS,
        };
        struct bundle_source source;
        struct bundle bundle;
        if (!bundle_open(&question, focus->arena, &source, error) ||
            !bundle_trace(&source, focus->rays, source.system->places, focus->arena, &bundle,
                          error)) {
            return false;
        }
        real_focus_gather(all, &bundle, setup.wavelengths[g].weight);
    }
    return true;
}

/* -------- where they lie closest -------- */

static bool real_focus_settle(struct focus_rays *all, struct real_point *point, struct error *error)
{
    double product = 0, spread = 0, square = 0;
    for (size_t i = 0; i < all->count; i++) {
        for (int k = 0; k < 2; k++) {
            product += all->marks[i].weight * all->at[i][k] * all->slope[i][k];
            spread += all->marks[i].weight * all->slope[i][k] * all->slope[i][k];
        }
    }
    if (!(sqrt(spread) > 64 * DBL_EPSILON)) {
        return fail(error, ERROR_DOMAIN,
                    "its rays leave the lens parallel: no film makes them "
                    "sharp");
    }
    const double nearest = -product / spread;
    for (size_t i = 0; i < all->count; i++) {
        for (int k = 0; k < 2; k++) {
            all->at[i][k] += nearest * all->slope[i][k];
            square += all->marks[i].weight * all->at[i][k] * all->at[i][k];
        }
    }
    *point = (struct real_point){
        .sharpest = nearest,
        .nearest = nearest,
        .count = all->count,
        .at = (const double(*)[2])all->at,
        .slope = (const double(*)[2])all->slope,
        .marks = all->marks,
        .has_arms = all->has_arms,
        .sheets = all->sheets,
        .square = square,
        .spread = spread,
    };
    return true;
}

/* -------- blurs -------- */

double blur_rule_reach(struct blur_rule rule)
{
    return rule.measure == BLUR_MTF ? lobe / (PI * rule.at) : INFINITY;
}

/* The diameter of the disc whose MTF this is, mm. */
static double disc_of_mtf(double mtf, double frequency)
{
    enum { TERMS = 30, TURNS = 60 };
    double low = 0, high = lobe;
    for (int turn = 0; turn < TURNS; turn++) {
        const double u = (low + high) / 2;
        double term = 1, sum = 1; /* 2 J1(u)/u */
        for (int k = 1; k < TERMS; k++) {
            term *= -u * u / (4.0 * k * (k + 1));
            sum += term;
        }
        low = sum > mtf ? u : low;
        high = sum > mtf ? high : u;
    }
    return (low + high) / (2 * PI * frequency);
}

static double mtf_of(const struct real_point *point, double shift, double frequency)
{
    double sum = 0;
    for (size_t i = 0; i < point->count; i++) {
        for (int k = 0; k < 2; k++) {
            sum += point->marks[i].weight *
                   cos(2 * PI * frequency * (point->at[i][k] + shift * point->slope[i][k]));
        }
    }
    return sum / 2;
}

static double energy_radius(const struct real_focus *focus, const struct real_point *point,
                            double shift)
{
    const struct arena_mark mark = arena_mark(focus->arena);
    struct encircled_energy_mark *marks =
        ARENA_ARRAY(focus->arena, point->count, struct encircled_energy_mark);
    for (size_t i = 0; i < point->count; i++) {
        marks[i] = point->marks[i];
        for (int k = 0; k < 2; k++) {
            marks[i].at[k] = point->at[i][k] + shift * point->slope[i][k];
        }
    }
    const struct encircled_energy_sample sample = {marks, point->count, point->has_arms,
                                                   point->sheets};
    const double radius = encircled_energy_find(&sample, focus->rule.at, focus->arena);
    arena_reset(focus->arena, mark);
    return radius;
}

/* Is a film so far off that contrast comes back upside down, or rays are too few to tell it? */
static bool is_beyond(const struct real_point *point, double shift, struct blur_rule rule)
{
    const double disc = 2 * sqrt(2 * point->spread) * fabs(shift);
    return disc > blur_rule_reach(rule) + 2 * sqrt(2 * point->square);
}

double real_focus_blur(const struct real_focus *focus, const struct real_point *point, double film)
{
    const struct blur_rule rule = focus->rule;
    const double shift = film - point->nearest;
    switch (rule.measure) {
    case BLUR_ENERGY:
        return 2 * energy_radius(focus, point, shift) / sqrt(rule.at);
    case BLUR_MTF:
        return is_beyond(point, shift, rule) ? blur_rule_reach(rule)
                                             : disc_of_mtf(mtf_of(point, shift, rule.at), rule.at);
    case BLUR_RMS:
        break;
    }
    return 2 * sqrt(2 * (point->square + point->spread * shift * shift));
}

/* The film of least blur, about the nearest: as far to both sides as the rays spread there. */
static double search_sharpest(const struct real_focus *focus, const struct real_point *point)
{
    enum { STEPS = 8, TURNS = 40 };
    const double golden = 0.6180339887498949, reach = 2 * sqrt(point->square / point->spread);
    double best = point->nearest, least = real_focus_blur(focus, point, best);
    if (!(least > nothing)) {
        return best;
    }
    for (int i = -STEPS; i <= STEPS; i++) {
        const double film = point->nearest + reach * i / STEPS;
        const double blur = real_focus_blur(focus, point, film);
        if (blur < least) {
            least = blur;
            best = film;
        }
    }
    double low = best - reach / STEPS, high = best + reach / STEPS;
    double first = high - golden * (high - low), second = low + golden * (high - low);
    double at_first = real_focus_blur(focus, point, first);
    double at_second = real_focus_blur(focus, point, second);
    for (int turn = 0; turn < TURNS && high - low > precisions[focus->rule.measure].film * reach;
         turn++) {
        if (at_first < at_second) {
            high = second;
            second = first;
            at_second = at_first;
            first = high - golden * (high - low);
            at_first = real_focus_blur(focus, point, first);
        } else {
            low = first;
            first = second;
            at_first = at_second;
            second = low + golden * (high - low);
            at_second = real_focus_blur(focus, point, second);
        }
    }
    return (low + high) / 2;
}

bool real_focus_point(const struct real_focus *focus, double object, struct real_point *point,
                      struct error *error)
{
    struct focus_rays all = {.focus = focus};
    if (!trace_all(&all, object, error)) {
        return false;
    }
    /* Coordinates about their means, which are those of the middle of the blur on every film. */
    double sum = 0, mean[4] = {0, 0, 0, 0};
    for (size_t i = 0; i < all.count; i++) {
        sum += all.marks[i].weight;
        for (int k = 0; k < 2; k++) {
            mean[k] += all.marks[i].weight * all.at[i][k];
            mean[2 + k] += all.marks[i].weight * all.slope[i][k];
        }
    }
    for (size_t i = 0; i < all.count; i++) {
        all.marks[i].weight /= sum;
        for (int k = 0; k < 2; k++) {
            all.at[i][k] -= mean[k] / sum;
            all.slope[i][k] -= mean[2 + k] / sum;
        }
    }
    if (!real_focus_settle(&all, point, error)) {
        return false;
    }
    if (focus->rule.measure != BLUR_RMS) {
        point->sharpest = search_sharpest(focus, point);
    }
    return true;
}

/* With so many rays, the blur where the disc of that mean square would be as large as c. */
static bool real_focus_measure(struct real_focus *focus, size_t rays, double object, double c,
                               double *blur, struct error *error)
{
    const struct arena_mark mark = arena_mark(focus->arena);
    struct real_point point;
    focus->rays = rays;
    const bool found = real_focus_point(focus, object, &point, error);
    const double away = found ? sqrt(fmax(c * c / 8 - point.square, 0) / point.spread) : 0;
    *blur = found ? real_focus_blur(focus, &point, point.sharpest + away) : (double)NAN;
    arena_reset(focus->arena, mark);
    return found;
}

bool real_focus_open(const struct real_focus_question *question, struct arena *arena,
                     struct real_focus *focus, struct error *error)
{
    const struct precision wanted = precisions[question->rule.measure];
    const double object = question->object, c = question->c;
    double here, finer;
    *focus = (struct real_focus){.asked = question->lens, .rule = question->rule, .arena = arena};
    if (!real_focus_measure(focus, FIRST_RAYS, object, c, &here, error)) {
        return false;
    }
    for (size_t rays = FIRST_RAYS; rays < wanted.rays; rays *= 2) {
        if (!real_focus_measure(focus, 2 * rays, object, c, &finer, error)) {
            return false;
        }
        focus->error = finer > nothing ? fabs(finer - here) / finer : 0;
        here = finer;
        if (focus->error <= wanted.blur) {
            break;
        }
    }
    return true;
}
