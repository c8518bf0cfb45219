/* analysis/waves/hopkins.c - contrast as the overlap of an exit pupil with itself. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/hopkins.h"

#include "base/constants.h"
#include "base/instruction_set.h"

#include <math.h>

enum { LOOKS = 48, ROUNDS = 44, PARTS = EXIT_SPANS * EXIT_SPANS, BREAKS = 16 };
enum { REFINED = 9, LOOK_ALONG = 12, LOOK_ACROSS = 12, LANES = EXIT_SERIES_LANES };

/* Points for each turn of the phase, were it as steep all along: Gauss's converge from pi/2 on. */
static const double a_turn = 1.6;

/* So many times the points of one round the next has. */
static const double finer = 1.25;

/* More points than these a round does not have: a tenth of a second. */
static const double most_points = 1.6e7;

/* A wave front of which series leave so much of contrast says nothing. */
static const double too_rough = 0.3;

/* Sums over points, lane by lane. */
struct hopkins_sums {
    double re[LANES], im[LANES], perfect[LANES];
};

/* An integral at work. */
struct overlap_integral {
    const struct exit_front *front;
    struct gauss_rules *rules;
    double shift;
    double least, times; /* points without a turn of the phase; times what is thought enough */
    double more; /* and so many more: each round must have other rules than the one before */
    struct hopkins_range *ranges;
    size_t count;
};

/*
 * Turns that the phase made if it were as steep everywhere as where it is steepest: to Gauss's
 * points, which lie the closer the nearer to the ends, and to even ones.
 */
struct hopkins_turns {
    double gauss, even;
};

/* Lines between two angles, whose parts are alike. */
struct hopkins_range {
    size_t piece, parts;
    double low, high;                   /* rad */
    double times;                       /* that it counts: for its mirror image too, or once */
    bool is_mirrored;                   /* its own mirror image: one half counts twice */
    struct hopkins_turns along, across; /* of the phase: along a part, and across the lines */
};

/* What is clear of a line at both places; a number of which edges end it. */
struct hopkins_parts {
    size_t count, kind;
    double low[PARTS], high[PARTS];
    size_t from[PARTS][2]; /* the spans */
};

static void find_parts(const struct exit_spans *spans, double shift, struct hopkins_parts *parts)
{
    const double half = shift / 2;
    parts->count = parts->kind = 0;
    for (size_t i = 0; i < spans->count; i++) {
        for (size_t j = 0; j < spans->count; j++) {
            const double *a = spans->edges + 2 * i, *b = spans->edges + 2 * j;
            const double low = fmax(a[0] + half, b[0] - half);
            const double high = fmin(a[1] + half, b[1] - half);
            const size_t ends =
                (a[0] + half > b[0] - half ? 1u : 0u) + (a[1] + half < b[1] - half ? 2u : 0u);
            parts->kind = 5 * parts->kind + (high > low ? 1 + ends : 0);
            if (high > low) {
                parts->low[parts->count] = low;
                parts->from[parts->count][0] = i;
                parts->from[parts->count][1] = j;
                parts->high[parts->count++] = high;
            }
        }
    }
}

static size_t kind_at(const struct exit_piece *piece, double shift, double angle)
{
    struct hopkins_parts parts;
    struct exit_spans spans;
    double slope;
    exit_piece_at(piece, angle, &slope, &spans);
    find_parts(&spans, shift, &parts);
    return parts.kind;
}

/* Angles between which the parts of all lines are alike: count and one more. */
static size_t hopkins_find_breaks(const struct exit_piece *piece, double shift, double *breaks)
{
    size_t count = 0;
    double before = -PI / 2;
    size_t kind = kind_at(piece, shift, before + 1e-9);
    breaks[0] = before;
    for (size_t i = 1; i <= LOOKS && count + 2 < BREAKS; i++) {
        const double here = PI * ((double)i / LOOKS - 0.5);
        const size_t next = kind_at(piece, shift, here - 1e-9);
        if (next != kind) {
            double low = before, high = here;
            for (int round = 0; round < ROUNDS; round++) {
                const double middle = (low + high) / 2;
                if (kind_at(piece, shift, middle) == kind) {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            breaks[++count] = high;
        }
        kind = next;
        before = here;
    }
    breaks[++count] = PI / 2;
    return count;
}

/* Add up a part of a line; phases: receives those of its points, or null. */
static void add_part(const struct overlap_integral *summing, const struct exit_line *line,
                     const struct hopkins_parts *parts, size_t p, const struct gauss_panels *along,
                     double weight, struct hopkins_sums *sums, double *phases)
{
    kernel_exit_values *find = KERNEL_FOR(SET_BEST, kernel_exit_values);
    double x[2][LANES], waves[2][LANES], amplitudes[2][LANES];
    double weights[LANES], re[LANES], im[LANES], size[LANES];
    const struct pupil_cross cross = {
        LANES, {waves[0], waves[1]}, {amplitudes[0], amplitudes[1]}, weights, re, im, size};
    const double low = parts->low[p], high = parts->high[p], length = high - low;
    /* in the other half of a part that mirrors itself the phase is the opposite */
    const bool is_half = summing->front->lines->is_mirrored_along &&
                         fabs(low + high) <= 1e-5 * (high - low) && phases == NULL;
    const size_t count = along->each * along->panels / (is_half ? 2 : 1);
    const double times = (is_half ? 2 : 1) * weight;
    struct exit_series series[2];
    double middle[2], scale[2];
    for (int k = 0; k < 2; k++) {
        const size_t span = parts->from[p][k];
        const double *edges = line->spans.edges + 2 * span;
        series[k] = line->series[span];
        middle[k] = (edges[0] + edges[1]) / 2 + (k == 0 ? 1 : -1) * summing->shift / 2;
        scale[k] = 2 / (edges[1] - edges[0]);
    }
    const double panel = length / (double)along->panels;
    double from = low;
    for (size_t done = 0, i = 0; done < count; done += LANES) {
        const size_t left = count - done < LANES ? count - done : LANES;
        for (size_t l = 0; l < left; l++) {
            const double s = from + panel * along->x[i];
            x[0][l] = (s - middle[0]) * scale[0];
            x[1][l] = (s - middle[1]) * scale[1];
            weights[l] = times * panel * along->w[i];
            if (++i == along->each) {
                i = 0;
                from += panel;
            }
        }
        for (size_t l = left; l < LANES; l++) {
            x[0][l] = x[1][l] = weights[l] = 0;
        }
        for (int k = 0; k < 2; k++) {
            find(&series[k], x[k], waves[k], amplitudes[k]);
        }
        pupil_cross(&cross);
        for (size_t l = 0; l < LANES; l++) {
            sums->re[l] += re[l];
            sums->im[l] += im[l];
            sums->perfect[l] += size[l];
        }
        for (size_t l = 0; l < left && phases != NULL; l++) {
            phases[done + l] = waves[0][l] - waves[1][l];
        }
    }
}

/* Add up the lines of a range; phases: receives those of all points, line by line, or null. */
static void add_lines(const struct overlap_integral *summing, const struct hopkins_range *range,
                      const struct gauss_panels *across, const struct gauss_panels *along,
                      struct hopkins_sums *sums, double *phases)
{
    const size_t row = range->parts * along->each * along->panels;
    const double wide = range->high - range->low;
    const bool is_half = range->is_mirrored && phases == NULL;
    const double times = (is_half ? 2 : 1) * range->times;
    for (size_t i = 0; i < across->each * across->panels / (is_half ? 2 : 1); i++) {
        struct exit_line line;
        struct hopkins_parts parts;
        exit_front_line(summing->front, range->piece,
                        range->low + wide * gauss_panels_at(across, i), &line);
        find_parts(&line.spans, summing->shift, &parts);
        const double weight = times * wide * gauss_panels_weight(across, i) * line.slope;
        /* rounding at an end of the range may lose a part, which is empty there */
        for (size_t p = 0; p < parts.count && p < range->parts; p++) {
            add_part(summing, &line, &parts, p, along, weight, sums,
                     phases != NULL ? phases + i * row + p * along->each * along->panels : NULL);
        }
    }
}

/* The most of what was seen and phases at Gauss's points say, which are `step` apart. */
static void see_turns(const double *phases, const struct gauss_panels *rule, size_t step,
                      struct hopkins_turns *turns)
{
    for (size_t i = 1; i < rule->each; i++) {
        const double here = fabs(phases[i * step] - phases[(i - 1) * step]);
        turns->gauss = fmax(turns->gauss, 2 / PI * (double)rule->each * here);
        turns->even = fmax(turns->even, here / (rule->x[i] - rule->x[i - 1]));
    }
}

static void hopkins_find_turns(const struct overlap_integral *summing, struct hopkins_range *range)
{
    enum { ROW = PARTS * LOOK_ALONG };
    const struct gauss_panels across = gauss_panels_of(summing->rules, LOOK_ACROSS);
    const struct gauss_panels along = gauss_panels_of(summing->rules, LOOK_ALONG);
    const size_t row = range->parts * LOOK_ALONG;
    struct hopkins_sums sums = {.re = {0}};
    double phases[LOOK_ACROSS * ROW] = {0};
    add_lines(summing, range, &across, &along, &sums, phases);
    for (size_t i = 0; i < LOOK_ACROSS * row; i += LOOK_ALONG) {
        see_turns(phases + i, &along, 1, &range->along);
    }
    for (size_t j = 0; j < row; j++) {
        see_turns(phases + j, &across, row, &range->across);
    }
}

/* Are the ranges between breaks mirror images of each other? */
static bool breaks_are_mirrored(const double *breaks, size_t count)
{
    bool are = true;
    for (size_t k = 0; k <= count; k++) {
        are = are && fabs(breaks[k] + breaks[count - k]) <= 1e-5;
    }
    return are;
}

/* Of ranges that are mirror images of each other the first counts twice. */
static void find_ranges(struct overlap_integral *summing)
{
    const struct exit_lines *lines = summing->front->lines;
    const size_t pieces = lines->is_mirrored_across ? (lines->count + 1) / 2 : lines->count;
    for (size_t i = 0; i < pieces; i++) {
        double breaks[BREAKS];
        const size_t count = hopkins_find_breaks(&lines->pieces[i], summing->shift, breaks);
        const bool has_image = lines->is_mirrored_across && 2 * i + 1 < lines->count;
        const bool is_mirrored = lines->is_mirrored_across && 2 * i + 1 == lines->count &&
                                 breaks_are_mirrored(breaks, count);
        for (size_t k = 0; k < (is_mirrored ? (count + 1) / 2 : count); k++) {
            struct exit_spans spans;
            struct hopkins_parts parts;
            double slope;
            exit_piece_at(&lines->pieces[i], (breaks[k] + breaks[k + 1]) / 2, &slope, &spans);
            find_parts(&spans, summing->shift, &parts);
            if (parts.count > 0) {
                struct hopkins_range *range = &summing->ranges[summing->count++];
                const bool is_middle = is_mirrored && 2 * k + 1 == count;
                *range = (struct hopkins_range){
                    .piece = i,
                    .parts = parts.count,
                    .low = breaks[k],
                    .high = breaks[k + 1],
                    .times = has_image || (is_mirrored && !is_middle) ? 2 : 1,
                    .is_mirrored = is_middle};
                hopkins_find_turns(summing, range);
            }
        }
    }
}

/* How many points are thought to do. */
static double points_for(const struct overlap_integral *summing, double least,
                         const struct hopkins_turns *turns)
{
    const double one = summing->times * (least + a_turn * turns->gauss) + summing->more;
    const double even = summing->times * (least + a_turn * turns->even) + summing->more;
    return one <= GAUSS_PANEL ? one : even;
}

/* Points of a range: across, and along each part. */
static void find_points(const struct overlap_integral *summing, const struct hopkins_range *range,
                        double *across, double *along)
{
    const double share = (range->high - range->low) / PI, least = summing->least;
    *across = points_for(summing, least * (1 + share) / 2, &range->across);
    *along = points_for(summing, least, &range->along);
}

/* How many points a round has. */
static double hopkins_points_of(const struct overlap_integral *summing)
{
    double points = 0, across, along;
    for (size_t i = 0; i < summing->count; i++) {
        find_points(summing, &summing->ranges[i], &across, &along);
        points += summing->ranges[i].times * across * along * (double)summing->ranges[i].parts;
    }
    return points;
}

static struct overlap hopkins_sum_up(const struct overlap_integral *summing)
{
    struct hopkins_sums sums = {.re = {0}};
    struct overlap sum = {.re = 0};
    for (size_t i = 0; i < summing->count; i++) {
        double across, along;
        find_points(summing, &summing->ranges[i], &across, &along);
        const struct gauss_panels rules[2] = {gauss_panels_of(summing->rules, across),
                                              gauss_panels_of(summing->rules, along)};
        add_lines(summing, &summing->ranges[i], &rules[0], &rules[1], &sums, NULL);
    }
    for (size_t l = 0; l < LANES; l++) {
        sum.re += sums.re[l];
        sum.im += sums.im[l];
        sum.perfect += sums.perfect[l];
    }
    if (summing->front->lines->is_mirrored_along) {
        sum.im = 0; /* as the halves of parts have opposite ones */
    }
    return sum;
}

/* Rounds of ever more points until the error is met, perhaps only that of a perfect wave front. */
static struct overlap refine(struct overlap_integral *summing, double error, bool only_perfect)
{
    struct overlap before, here = hopkins_sum_up(summing);
    here.error = INFINITY;
    for (int i = 0; i < REFINED && here.error > error; i++) {
        summing->times *= finer;
        summing->more += GAUSS_STEP;
        if (hopkins_points_of(summing) > most_points) {
            break;
        }
        before = here;
        here = hopkins_sum_up(summing);
        here.error = fabs(here.perfect - before.perfect) +
                     (only_perfect ? 0 : hypot(here.re - before.re, here.im - before.im));
    }
    return here;
}

bool overlap_is_known(double off)
{
    return off < too_rough;
}

struct overlap overlap_find(const struct exit_front *front, struct gauss_rules *rules, double shift,
                            double error, bool only_perfect)
{
    struct hopkins_range ranges[EXIT_PIECES * BREAKS];
    struct overlap_integral summing = {.front = front,
                                       .rules = rules,
                                       .shift = shift,
                                       .least = 3 - 1.5 * log10(error),
                                       .times = 1,
                                       .ranges = ranges};
    const double energy = front->pupil->energy;
    struct overlap sum = {.re = NAN, .im = NAN, .perfect = NAN, .error = INFINITY};
    if (!overlap_is_known(front->off)) {
        return sum;
    }
    find_ranges(&summing);
    const bool is_steep = 2 * hopkins_points_of(&summing) > most_points;
    for (size_t i = 0; i < summing.count && (is_steep || only_perfect); i++) {
        ranges[i].across = ranges[i].along = (struct hopkins_turns){0, 0}; /* which turns nothing */
    }
    /* what the integral may be off, in shares of the energy, beside the series of the front */
    const double off = front->off, left = fmax(error - off, fmax(error, off) / 4);
    sum = refine(&summing, left * energy, is_steep || only_perfect);
    sum.error += off * energy;
    sum.has_converged = !is_steep && sum.error <= error * energy;
    if (is_steep || only_perfect) {
        sum.re = sum.im = NAN;
        sum.error = only_perfect ? sum.error : INFINITY;
    }
    return sum;
}
