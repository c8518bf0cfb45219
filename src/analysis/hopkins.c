/* analysis/hopkins.c - contrast as the overlap of an exit pupil with itself. */
/* SPDX-License-Identifier: MIT */
#include "analysis/hopkins.h"

#include "base/constants.h"
#include "base/turns.h"
#include "trace/sample.h"

#include <math.h>

enum { LOOKS = 48, ROUNDS = 44, PARTS = EXIT_SPANS * EXIT_SPANS, BREAKS = 16 };
enum { FIRST = 10, REFINED = 9, LEAST = 4 };

/* Points of an integral. */
struct summing {
    const struct exit_pupil *pupil;
    const struct exit_lines *lines;
    double shift;
    size_t across, along; /* points of a whole piece, and of one part of a line */
    struct arena *arena;
    struct overlap *sum;
};

/* What is clear of a line at both places; a number of which edges end it. */
struct parts {
    size_t count, kind;
    double low[PARTS], high[PARTS];
};

static double find_parts(const struct exit_piece *piece, double shift, double angle, double *slope,
                         struct parts *parts)
{
    struct exit_spans spans;
    const double t = exit_piece_at(piece, angle, slope, &spans), half = shift / 2;
    *parts = (struct parts){.count = 0};
    for (size_t i = 0; i < spans.count; i++) {
        for (size_t j = 0; j < spans.count; j++) {
            const double *a = spans.edges + 2 * i, *b = spans.edges + 2 * j;
            const double low = fmax(a[0] + half, b[0] - half);
            const double high = fmin(a[1] + half, b[1] - half);
            const size_t ends =
                (a[0] + half > b[0] - half ? 1u : 0u) + (a[1] + half < b[1] - half ? 2u : 0u);
            parts->kind = 5 * parts->kind + (high > low ? 1 + ends : 0);
            if (high > low) {
                parts->low[parts->count] = low;
                parts->high[parts->count++] = high;
            }
        }
    }
    return t;
}

static size_t kind_at(const struct exit_piece *piece, double shift, double angle)
{
    struct parts parts;
    double slope;
    find_parts(piece, shift, angle, &slope, &parts);
    return parts.kind;
}

/* Angles between which the parts of all lines are alike: count and one more. */
static size_t find_breaks(const struct exit_piece *piece, double shift, double *breaks)
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
                *(kind_at(piece, shift, middle) == kind ? &low : &high) = middle;
            }
            breaks[++count] = high;
        }
        kind = next;
        before = here;
    }
    breaks[++count] = PI / 2;
    return count;
}

/* Add up points, at both places. */
static void add_points(const struct summing *summing, const double (*at)[2], const double *weights,
                       size_t count)
{
    struct arena *arena = summing->arena;
    double(*first)[2] = arena_array(arena, count, sizeof *first);
    double(*second)[2] = arena_array(arena, count, sizeof *second);
    double *waves[2], *amplitudes[2];
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            const double half = summing->shift / 2 * summing->lines->along[k];
            first[i][k] = at[i][k] - half;
            second[i][k] = at[i][k] + half;
        }
    }
    for (int k = 0; k < 2; k++) {
        waves[k] = ARENA_ARRAY(arena, count, double);
        amplitudes[k] = ARENA_ARRAY(arena, count, double);
        exit_pupil_values(summing->pupil, (const double(*)[2])(k == 0 ? first : second), count,
                          waves[k], amplitudes[k]);
    }
    for (size_t i = 0; i < count; i++) {
        const double w = weights[i] * amplitudes[0][i] * amplitudes[1][i];
        double c, s;
        turns_of(waves[0][i] - waves[1][i], &c, &s);
        summing->sum->re += w * c;
        summing->sum->im += w * s;
        summing->sum->perfect += w;
    }
}

/* Lines between two angles, whose parts are alike. */
static void add_lines(const struct summing *summing, const struct exit_piece *piece, double low,
                      double high)
{
    const struct arena_mark mark = arena_mark(summing->arena);
    struct arena *arena = summing->arena;
    const struct exit_lines *lines = summing->lines;
    const size_t along = summing->along;
    const size_t across = LEAST + (size_t)((double)summing->across * (high - low) / PI);
    double *x = ARENA_ARRAY(arena, across, double), *w = ARENA_ARRAY(arena, across, double);
    double *y = ARENA_ARRAY(arena, along, double), *v = ARENA_ARRAY(arena, along, double);
    const size_t most = across * along * PARTS;
    double(*at)[2] = arena_array(arena, most, sizeof *at);
    double *weights = ARENA_ARRAY(arena, most, double);
    size_t count = 0;
    gauss_rule(across, x, w);
    gauss_rule(along, y, v);
    for (size_t i = 0; i < across; i++) {
        struct parts parts;
        double slope;
        const double angle = low + (high - low) * x[i];
        const double t = find_parts(piece, summing->shift, angle, &slope, &parts);
        for (size_t j = 0; j < parts.count * along; j++) {
            const double begin = parts.low[j / along], length = parts.high[j / along] - begin;
            const double s = begin + length * y[j % along];
            for (int k = 0; k < 2; k++) {
                at[count][k] = s * lines->along[k] + t * lines->across[k];
            }
            weights[count++] = (high - low) * w[i] * slope * length * v[j % along];
        }
    }
    add_points(summing, (const double(*)[2])at, weights, count);
    arena_reset(arena, mark);
}

static struct overlap sum_up(const struct exit_pupil *pupil, const struct exit_lines *lines,
                             double shift, size_t points, struct arena *arena)
{
    struct overlap sum = {.re = 0};
    const struct summing summing = {pupil, lines, shift, points, points, arena, &sum};
    for (size_t i = 0; i < lines->count; i++) {
        double breaks[BREAKS];
        const size_t count = find_breaks(&lines->pieces[i], shift, breaks);
        for (size_t k = 0; k < count; k++) {
            add_lines(&summing, &lines->pieces[i], breaks[k], breaks[k + 1]);
        }
    }
    return sum;
}

struct overlap overlap_find(const struct exit_pupil *pupil, const struct exit_lines *lines,
                            double shift, double error, struct arena *arena)
{
    struct overlap before, here = sum_up(pupil, lines, shift, FIRST, arena);
    size_t points = FIRST;
    for (int i = 0; i < REFINED && !here.has_converged; i++) {
        before = here;
        points = points * 8 / 5;
        here = sum_up(pupil, lines, shift, points, arena);
        here.error =
            hypot(here.re - before.re, here.im - before.im) + fabs(here.perfect - before.perfect);
        here.has_converged = here.error <= error * pupil->energy;
    }
    return here;
}
