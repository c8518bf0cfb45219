/* analysis/waves/exit_front.c - wave front and amplitude of an exit pupil as series along its lines. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/exit_front.h"

#include "base/constants.h"
#include "base/instruction_set.h"
#include "base/turns.h"

#include <math.h>

enum { LINES_FIRST = 24, POINTS_FIRST = 16, LAST = 3, HOPELESS = 54 * 36 };

/* Rounding of paths leaves so much, wavelengths. */
static const double finest = 2e-9;

/* A map that is off by more half boxes does not say where rays go. */
static const double lost = 0.05;

/* A sheet in the making. */
struct sheet_builder {
    const struct exit_pupil *pupil;
    const struct exit_lines *lines;
    const struct exit_piece *piece;
    size_t span;
    bool by_form;
    double off; /* of places without a ray */
    struct arena *arena;
};

static double exit_front_worst_of(const struct exit_pupil *pupil)
{
    /* of the mean of exp(2 pi i (W1 - W2)) A1 A2 */
    return 4 * PI * pupil->off_waves + 2 * pupil->off_amplitude;
}

/* Chebyshev's point i of n. */
static double exit_front_point_of(size_t i, size_t n)
{
    double c, s;
    turns_of_ratio(2 * i + 1, 4 * n, &c, &s);
    return c;
}

/* Values at points of both directions. */
static void exit_front_sample(struct sheet_builder *making, size_t lines, size_t points,
                              double *waves, double *amplitudes)
{
    const struct exit_lines *of = making->lines;
    const size_t count = lines * points;
    const struct arena_mark mark = arena_mark(making->arena);
    double(*at)[2] = arena_array(making->arena, count, sizeof *at);
    for (size_t i = 0; i < lines; i++) {
        struct exit_spans spans;
        double slope;
        const double t =
            exit_piece_at(making->piece, PI / 2 * exit_front_point_of(i, lines), &slope, &spans);
        const double *edges = spans.edges + 2 * making->span;
        const double middle = (edges[0] + edges[1]) / 2, half = (edges[1] - edges[0]) / 2;
        for (size_t j = 0; j < points; j++) {
            const double s = middle + half * exit_front_point_of(j, points);
            for (int k = 0; k < 2; k++) {
                at[i * points + j][k] = s * of->along[k] + t * of->across[k];
            }
        }
    }
    const double(*const all)[2] = (const double(*)[2])at;
    if (making->by_form) {
        exit_pupil_form(making->pupil, all, count, waves, amplitudes);
    } else {
        exit_pupil_values(making->pupil, all, count, waves, amplitudes);
    }
    for (size_t i = 0; i < count && !making->by_form; i++) {
        if (!isfinite(waves[i]) || !isfinite(amplitudes[i])) {
            exit_pupil_form(making->pupil, all + i, 1, waves + i, amplitudes + i);
            making->off = exit_front_worst_of(making->pupil);
        }
    }
    arena_reset(making->arena, mark);
}

/* Values at n of Chebyshev's points, `step` apart, to the coefficients of their series. */
static void to_series(double *values, size_t n, size_t step, const double *cosines)
{
    double sums[EXIT_FRONT_MOST];
    for (size_t k = 0; k < n; k++) {
        sums[k] = 0;
        for (size_t i = 0; i < n; i++) {
            sums[k] += values[i * step] * cosines[k * n + i];
        }
    }
    for (size_t k = 0; k < n; k++) {
        values[k * step] = sums[k] * (k == 0 ? 1 : 2) / (double)n;
    }
}

static const double *cosines_of(size_t n, struct arena *arena)
{
    double *cosines = ARENA_ARRAY(arena, n * n, double), s;
    for (size_t k = 0; k < n; k++) {
        for (size_t i = 0; i < n; i++) {
            turns_of_ratio(k * (2 * i + 1) % (4 * n), 4 * n, &cosines[k * n + i], &s);
        }
    }
    return cosines;
}

/*
 * Drop the last terms along lines that are all below `least`; returns how many are left.
 *
 * Given     noise    what is no more than that is rounding
 *           dropped  receives the root of the sum of their squares: the rms of what they make, or
 *                    more
 */
static size_t front_shorten(double *c, size_t lines, size_t points, double least, double noise,
                            double *dropped)
{
    size_t left = 2;
    for (size_t i = 0; i < lines; i++) {
        for (size_t j = left; j < points; j++) {
            left = fabs(c[i * points + j]) > least ? j + 1 : left;
        }
    }
    double square = 0;
    for (size_t i = 0; i < lines; i++) {
        for (size_t j = 0; j < points; j++) {
            const double term = c[i * points + j];
            if (j < left) {
                c[i * left + j] = term;
            } else {
                square += fabs(term) > noise ? term * term : 0;
            }
        }
    }
    *dropped = sqrt(square);
    return left;
}

/* Series of both from so many points: c receives them; off: what they leave, across and along. */
static void find_series(struct sheet_builder *making, size_t lines, size_t points, double *c[2],
                        double off[2])
{
    struct arena *arena = making->arena;
    double tails[2][2];
    c[0] = ARENA_ARRAY(arena, lines * points, double);
    c[1] = ARENA_ARRAY(arena, lines * points, double);
    exit_front_sample(making, lines, points, c[0], c[1]);
    const double *across = cosines_of(lines, arena), *along = cosines_of(points, arena);
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < lines; i++) {
            to_series(c[k] + i * points, points, 1, along);
        }
        for (size_t j = 0; j < points; j++) {
            to_series(c[k] + j, lines, points, across);
        }
        /* the largest of the last terms: of the lines, and along them */
        tails[k][0] = tails[k][1] = 0;
        for (size_t i = 0; i < lines; i++) {
            for (size_t j = 0; j < points; j++) {
                const double size = fabs(c[k][i * points + j]);
                tails[k][0] = i + LAST >= lines ? fmax(tails[k][0], size) : tails[k][0];
                tails[k][1] = j + LAST >= points ? fmax(tails[k][1], size) : tails[k][1];
            }
        }
    }
    for (int d = 0; d < 2; d++) {
        /* of the mean of exp(2 pi i (W1 - W2)) A1 A2 */
        off[d] = 4 * PI * fmax(0, tails[0][d] - finest) + 2 * tails[1][d] / c[1][0];
    }
}

/* Half as many again where they do not do; false: they do, or there are enough. */
static bool more(double off, double error, size_t *count)
{
    const size_t before = *count;
    if (!(off <= error / 20)) {
        *count = before * 3 / 2 < EXIT_FRONT_MOST ? before * 3 / 2 : EXIT_FRONT_MOST;
    }
    return *count > before;
}

/* One sheet; returns what its series leave of contrast. */
static double make_sheet(struct sheet_builder *making, double error, struct exit_sheet *sheet)
{
    size_t lines = LINES_FIRST, points = POINTS_FIRST;
    const double least = error / 200;
    while (true) {
        const struct arena_mark mark = arena_mark(making->arena);
        const size_t tried[2] = {lines, points};
        double *c[2], off[2];
        find_series(making, lines, points, c, off);
        const bool hopeless = lines * points >= HOPELESS && !(off[0] + off[1] < 1);
        const bool again[2] = {more(off[0], error, &lines), more(off[1], error, &points)};
        if (hopeless || (!again[0] && !again[1])) {
            double dropped[2];
            const double sizes[2] = {fmax(least / (4 * PI), finest), least * c[1][0] / 2};
            *sheet = (struct exit_sheet){
                tried[0], front_shorten(c[0], tried[0], tried[1], sizes[0], finest, &dropped[0]),
                front_shorten(c[1], tried[0], tried[1], sizes[1], 0, &dropped[1]), c[0], c[1]};
            /* what they are worth as in find_series */
            return off[0] + off[1] + 4 * PI * dropped[0] + 2 * dropped[1] / c[1][0];
        }
        arena_reset(making->arena, mark);
    }
}

void exit_front_find(const struct exit_pupil *pupil, const struct exit_lines *lines, double error,
                     struct arena *arena, struct exit_front *front)
{
    struct sheet_builder making = {.pupil = pupil,
                                   .lines = lines,
                                   .by_form = exit_front_worst_of(pupil) <= error / 2,
                                   .arena = arena};
    making.off = making.by_form ? exit_front_worst_of(pupil) : 0;
    if (!(pupil->off <= lost)) {
        making.off = INFINITY;
    }
    *front = (struct exit_front){
        pupil, lines, ARENA_ARRAY(arena, lines->count * EXIT_SPANS, struct exit_sheet), 0};
    for (size_t p = 0; p < lines->count; p++) {
        making.piece = &lines->pieces[p];
        for (making.span = 0; making.span < making.piece->count && front->off < 1; making.span++) {
            struct exit_sheet *sheet = &front->sheets[p * EXIT_SPANS + making.span];
            const double off = make_sheet(&making, error, sheet);
            front->off = off <= front->off ? front->off : off; /* NaN too */
        }
    }
    front->off += making.off;
}

/* -------- asking -------- */

void exit_front_line(const struct exit_front *front, size_t piece, double angle,
                     struct exit_line *line)
{
    kernel_exit_line *find = KERNEL_FOR(SET_BEST, kernel_exit_line);
    double shares[EXIT_FRONT_MOST];
    const double x = angle / (PI / 2);
    shares[0] = 1, shares[1] = x;
    for (size_t i = 2; i < EXIT_FRONT_MOST; i++) {
        shares[i] = 2 * x * shares[i - 1] - shares[i - 2];
    }
    line->t = exit_piece_at(&front->lines->pieces[piece], angle, &line->slope, &line->spans);
    for (size_t k = 0; k < line->spans.count; k++) {
        const struct exit_sheet *sheet = &front->sheets[piece * EXIT_SPANS + k];
        double *waves = line->room[2 * k], *amplitudes = line->room[2 * k + 1];
        find(sheet->waves, shares, sheet->lines, sheet->wave_count, waves);
        find(sheet->amplitudes, shares, sheet->lines, sheet->amplitude_count, amplitudes);
        line->series[k] =
            (struct exit_series){waves, amplitudes, sheet->wave_count, sheet->amplitude_count};
    }
}
