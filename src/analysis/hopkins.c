/* analysis/hopkins.c - contrast as the overlap of an exit pupil with itself. */
/* SPDX-License-Identifier: MIT */
#include "analysis/hopkins.h"

#include "base/constants.h"
#include "base/turns.h"
#include "trace/sample.h"

#include <math.h>

enum { LOOKS = 48, ROUNDS = 44, PARTS = EXIT_SPANS * EXIT_SPANS, BREAKS = 16 };
enum {
    RULE_STEP = 4,
    PANEL = RULE_STEP * OVERLAP_RULES,
    REFINED = 9,
    LOOK_ALONG = 8,
    LOOK_ACROSS = 8
};

/* Points for each turn of the phase: Gauss's converge from pi/2 on. */
static const double a_turn = 1.75;

/* So many times the points of one round the next has. */
static const double finer = 1.25;

/* An integral at work. */
struct summing {
    const struct exit_pupil *pupil;
    const struct exit_lines *lines;
    struct overlap_rules *rules;
    double shift;
    double least, times; /* points without a turn of the phase; times what is thought enough */
    double more;  /* and so many more: each round must have other rules than the one before */
    bool by_form; /* from polynomials */
    struct arena *arena;
    struct overlap *sum;
};

/* Gauss's points, of many in equal panels. */
struct rule {
    const double *x, *w;
    size_t each, panels;
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

static struct rule rule_of(struct overlap_rules *rules, double wanted)
{
    const size_t panels = (size_t)ceil(wanted / PANEL);
    const size_t slot = (size_t)ceil(wanted / (double)(panels * RULE_STEP)) - 1;
    if (!rules->is_ready[slot]) {
        gauss_rule(RULE_STEP * (slot + 1), rules->x[slot], rules->w[slot]);
        rules->is_ready[slot] = true;
    }
    return (struct rule){rules->x[slot], rules->w[slot], RULE_STEP * (slot + 1), panels};
}

static double rule_at(const struct rule *rule, size_t i)
{
    return ((double)(i / rule->each) + rule->x[i % rule->each]) / (double)rule->panels;
}

static double rule_weight(const struct rule *rule, size_t i)
{
    return rule->w[i % rule->each] / (double)rule->panels;
}

/* Points of lines whose parts are alike: line by line, part by part. */
struct points {
    size_t lines, parts, along, count;
    double (*at)[2], *weights; /* at: between both places */
    double *phases, *products; /* W1 - W2, A1 A2 */
};

static void find_values(const struct summing *summing, struct points *points)
{
    struct arena *arena = summing->arena;
    const size_t count = points->count;
    double(*at)[2] = arena_array(arena, count, sizeof *at);
    double *waves[2], *amplitudes[2];
    for (int k = 0; k < 2; k++) {
        const double half = (k == 0 ? -1 : 1) * summing->shift / 2;
        waves[k] = ARENA_ARRAY(arena, count, double);
        amplitudes[k] = ARENA_ARRAY(arena, count, double);
        for (size_t i = 0; i < count; i++) {
            at[i][0] = points->at[i][0] + half * summing->lines->along[0];
            at[i][1] = points->at[i][1] + half * summing->lines->along[1];
        }
        (summing->by_form ? exit_pupil_form : exit_pupil_values)(
            summing->pupil, (const double(*)[2])at, count, waves[k], amplitudes[k]);
    }
    for (size_t i = 0; i < count; i++) {
        waves[0][i] -= waves[1][i];
        amplitudes[0][i] *= amplitudes[1][i];
    }
    points->phases = waves[0];
    points->products = amplitudes[0];
}

/* Points of a piece between two angles. */
static struct points put_points(const struct summing *summing, const struct exit_piece *piece,
                                const double range[2], const struct rule *across,
                                const struct rule *along)
{
    const struct exit_lines *lines = summing->lines;
    struct points points = {across->each * across->panels, 0, along->each * along->panels,
                            .count = 0};
    struct parts parts;
    double slope;
    find_parts(piece, summing->shift, (range[0] + range[1]) / 2, &slope, &parts);
    points.parts = parts.count;
    const size_t room = points.lines * points.parts * points.along;
    points.at = arena_array(summing->arena, room, sizeof *points.at);
    points.weights = ARENA_ARRAY(summing->arena, room, double);
    for (size_t i = 0; i < points.lines; i++) {
        const double angle = range[0] + (range[1] - range[0]) * rule_at(across, i);
        const double weight = (range[1] - range[0]) * rule_weight(across, i);
        const double t = find_parts(piece, summing->shift, angle, &slope, &parts);
        for (size_t p = 0; p < points.parts; p++) {
            /* rounding at an end of the range may lose a part, which is empty there */
            const double low = p < parts.count ? parts.low[p] : 0;
            const double length = p < parts.count ? parts.high[p] - low : 0;
            for (size_t j = 0; j < points.along; j++) {
                const double s = low + length * rule_at(along, j);
                for (int k = 0; k < 2; k++) {
                    points.at[points.count][k] = s * lines->along[k] + t * lines->across[k];
                }
                points.weights[points.count++] = weight * slope * length * rule_weight(along, j);
            }
        }
    }
    find_values(summing, &points);
    return points;
}

/* The most turns of the phase along a part of a line, and across the lines. */
static void find_turns(const struct points *points, double *along, double *across)
{
    const size_t row = points->parts * points->along;
    *along = *across = 0;
    for (size_t i = 0; i < points->count; i += points->along) {
        double turns = 0;
        for (size_t j = i + 1; j < i + points->along; j++) {
            turns += fabs(points->phases[j] - points->phases[j - 1]);
        }
        *along = fmax(*along, turns);
    }
    for (size_t j = 0; j < row; j++) {
        double turns = 0;
        for (size_t i = j + row; i < points->count; i += row) {
            turns += fabs(points->phases[i] - points->phases[i - row]);
        }
        *across = fmax(*across, turns);
    }
}

/* Lines between two angles, whose parts are alike. */
static void add_lines(const struct summing *summing, const struct exit_piece *piece,
                      const double range[2])
{
    const struct arena_mark mark = arena_mark(summing->arena);
    const struct rule look_across = rule_of(summing->rules, LOOK_ACROSS);
    const struct rule look_along = rule_of(summing->rules, LOOK_ALONG);
    const struct points looks = put_points(summing, piece, range, &look_across, &look_along);
    double turns_along, turns_across;
    find_turns(&looks, &turns_along, &turns_across);
    const double share = (range[1] - range[0]) / PI, least = summing->least;
    const struct rule across =
        rule_of(summing->rules,
                summing->more + summing->times * (least * (1 + share) / 2 + a_turn * turns_across));
    const struct rule along =
        rule_of(summing->rules, summing->more + summing->times * (least + a_turn * turns_along));
    const struct points points = put_points(summing, piece, range, &across, &along);
    for (size_t i = 0; i < points.count; i++) {
        const double weight = points.weights[i] * points.products[i];
        double c, s;
        turns_of(points.phases[i], &c, &s);
        summing->sum->re += weight * c;
        summing->sum->im += weight * s;
        summing->sum->perfect += weight;
    }
    arena_reset(summing->arena, mark);
}

static struct overlap sum_up(const struct summing *summing)
{
    struct overlap sum = {.re = 0};
    struct summing here = *summing;
    here.sum = &sum;
    for (size_t i = 0; i < summing->lines->count; i++) {
        double breaks[BREAKS];
        const struct exit_piece *piece = &summing->lines->pieces[i];
        const size_t count = find_breaks(piece, summing->shift, breaks);
        for (size_t k = 0; k < count; k++) {
            if (kind_at(piece, summing->shift, (breaks[k] + breaks[k + 1]) / 2) > 0) {
                add_lines(&here, piece, breaks + k);
            }
        }
    }
    return sum;
}

struct overlap_rules *overlap_rules_new(struct arena *arena)
{
    struct overlap_rules *rules = ARENA_NEW(arena, struct overlap_rules);
    for (size_t i = 0; i < OVERLAP_RULES; i++) {
        rules->x[i] = ARENA_ARRAY(arena, RULE_STEP * (i + 1), double);
        rules->w[i] = ARENA_ARRAY(arena, RULE_STEP * (i + 1), double);
        rules->is_ready[i] = false;
    }
    return rules;
}

struct overlap overlap_find(const struct exit_pupil *pupil, const struct exit_lines *lines,
                            struct overlap_rules *rules, double shift, double error,
                            struct arena *arena)
{
    /* of the mean of exp(2 pi i (W1 - W2)) A1 A2 */
    const double off = 4 * PI * pupil->off_waves + 2 * pupil->off_amplitude;
    struct summing summing = {.pupil = pupil,
                              .lines = lines,
                              .rules = rules,
                              .shift = shift,
                              .least = 3 - 1.5 * log10(error),
                              .times = 1,
                              .by_form = off <= error / 2,
                              .arena = arena};
    const double left = summing.by_form ? error - off : error;
    struct overlap before, here = sum_up(&summing);
    for (int i = 0; i < REFINED && !here.has_converged; i++) {
        before = here;
        summing.times *= finer;
        summing.more += RULE_STEP;
        here = sum_up(&summing);
        here.error =
            hypot(here.re - before.re, here.im - before.im) + fabs(here.perfect - before.perfect);
        here.has_converged = here.error <= left * pupil->energy;
    }
    here.error += summing.by_form ? off * pupil->energy : 0;
    return here;
}
