/* analysis/mtf_curve.c - contrast at many even frequencies at once, for drawings. */
/* SPDX-License-Identifier: MIT */
#include "analysis/mtf_curve.h"

#include "base/constants.h"
#include "base/fft.h"
#include "base/turns.h"
#include "trace/sample.h"

#include <math.h>

enum { CELLS = 112, CELLS_MOST = 4096, LINES_LEAST = 56, LINES_MOST = 1024, LOOKS = 24 };
enum { PAIRS = FFT_LANES / 2 }; /* lines with and without their wave fronts */

/* Turns of the phase that two cells may lie apart, and lines for each turn across them. */
static const double steepest = 0.15, a_turn = 1.75;

/* What polynomials of the wave front may leave, of contrast. */
static const double fine = 3e-4;

/* The overlap of one pupil in one direction. */
struct overlapping {
    const struct exit_pupil *pupil;
    const struct exit_lines *lines;
    double middle[2], wide[2]; /* along and across */
    double step;               /* of cells */
    size_t lag, cells, across; /* cells of one frequency, and of the pupil; lines of it */
    struct fft fft;
    double *power[2]; /* with the wave front, and with a perfect one */
    struct arena *arena;
};

static void find_values(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                        double *waves, double *amplitudes)
{
    const double off = 4 * PI * pupil->off_waves + 2 * pupil->off_amplitude;
    (off <= fine ? exit_pupil_form : exit_pupil_values)(pupil, at, count, waves, amplitudes);
}

static void put(const struct overlapping *one, double s, double t, double at[2])
{
    for (int k = 0; k < 2; k++) {
        at[k] = s * one->lines->along[k] + t * one->lines->across[k];
    }
}

static bool is_clear(const struct exit_spans *spans, double s)
{
    bool clear = false;
    for (size_t i = 0; i < spans->count; i++) {
        clear = clear || (s > spans->edges[2 * i] && s < spans->edges[2 * i + 1]);
    }
    return clear;
}

/* Turns of W in a coarse grid: the most from place to place along lines, and of a whole row of
   them across. NaN stands where nothing is clear. */
static void find_turns(const double (*waves)[LOOKS], double *along, double *across)
{
    *along = *across = 0;
    for (size_t i = 0; i < LOOKS; i++) {
        double turns = 0;
        for (size_t j = 0; j + 1 < LOOKS; j++) {
            const double next = fabs(waves[i][j + 1] - waves[i][j]);
            const double beside = fabs(waves[j + 1][i] - waves[j][i]);
            *along = fmax(*along, next); /* not of NaN */
            turns += isfinite(beside) ? beside : 0;
        }
        *across = fmax(*across, turns);
    }
}

static void look(const struct overlapping *one, double *along, double *across)
{
    double waves[LOOKS][LOOKS], amplitudes[LOOKS], at[LOOKS][2];
    for (size_t i = 0; i < LOOKS; i++) {
        struct exit_spans spans = {.count = 0};
        const double t = one->middle[1] + one->wide[1] * (((double)i + 0.5) / LOOKS - 0.5);
        for (size_t p = 0; p < one->lines->count; p++) {
            const struct exit_piece *piece = &one->lines->pieces[p];
            double slope;
            if (t > piece->low && t < piece->high) {
                exit_piece_at(piece,
                              asin((2 * t - piece->low - piece->high) / (piece->high - piece->low)),
                              &slope, &spans);
            }
        }
        for (size_t j = 0; j < LOOKS; j++) {
            put(one, one->middle[0] + one->wide[0] * (((double)j + 0.5) / LOOKS - 0.5), t, at[j]);
        }
        find_values(one->pupil, (const double(*)[2])at, LOOKS, waves[i], amplitudes);
        for (size_t j = 0; j < LOOKS; j++) {
            const double s = one->middle[0] + one->wide[0] * (((double)j + 0.5) / LOOKS - 0.5);
            waves[i][j] = is_clear(&spans, s) ? waves[i][j] : (double)NAN;
        }
    }
    find_turns((const double(*)[LOOKS])waves, along, across);
}

/* Cells and lines for a step of the shift; false: too many. */
static bool set_grid(struct overlapping *one, double shift)
{
    double along, across;
    look(one, &along, &across);
    const double cells = fmax(CELLS, 1.3 * LOOKS * along / steepest);
    const double lag = ceil(shift * cells / one->wide[0]);
    const double lines = LINES_LEAST + a_turn * across;
    one->step = shift / lag;
    if (!(one->wide[0] / one->step < CELLS_MOST && lines < LINES_MOST)) {
        return false;
    }
    one->lag = (size_t)lag;
    one->cells = (size_t)(1.02 * one->wide[0] / one->step) + 2;
    one->across = (size_t)lines;
    one->fft = fft_open(fft_length_from(2 * one->cells), one->arena);
    for (int k = 0; k < 2; k++) {
        one->power[k] = ARENA_ARRAY(one->arena, one->fft.length, double);
        for (size_t i = 0; i < one->fft.length; i++) {
            one->power[k][i] = 0;
        }
    }
    return true;
}

/* How much of a cell is clear. */
static double share_of(const struct exit_spans *spans, double low, double step)
{
    double share = 0;
    for (size_t i = 0; i < spans->count; i++) {
        const double from = fmax(spans->edges[2 * i], low);
        const double to = fmin(spans->edges[2 * i + 1], low + step);
        share += fmax(0, to - from) / step;
    }
    return share;
}

/* A line's cells from the first that is clear: complex with the wave front, and real without. */
static void put_line(const struct overlapping *one, const struct exit_spans *spans, double t,
                     double weight, double *re, double *im, double *perfect)
{
    const struct arena_mark mark = arena_mark(one->arena);
    const size_t n = one->cells;
    double(*at)[2] = arena_array(one->arena, n, sizeof *at);
    double *waves = ARENA_ARRAY(one->arena, n, double);
    double *amplitudes = ARENA_ARRAY(one->arena, n, double);
    const double first = spans->edges[0], end = spans->edges[2 * spans->count - 1];
    const size_t count = (size_t)fmax(0, fmin(ceil((end - first) / one->step), (double)n));
    for (size_t i = 0; i < count; i++) {
        put(one, first + one->step * ((double)i + 0.5), t, at[i]);
    }
    find_values(one->pupil, (const double(*)[2])at, count, waves, amplitudes);
    for (size_t i = 0; i < count; i++) {
        const double share = share_of(spans, first + one->step * (double)i, one->step);
        double c, s;
        turns_of(waves[i], &c, &s);
        perfect[i] = share > 0 ? weight * share * amplitudes[i] : 0;
        re[i] = share > 0 ? perfect[i] * c : 0;
        im[i] = share > 0 ? perfect[i] * s : 0;
    }
    arena_reset(one->arena, mark);
}

/* Lines of one piece, each with and without its wave front. */
static void add_piece(const struct overlapping *one, const struct exit_piece *piece)
{
    const struct arena_mark mark = arena_mark(one->arena);
    const size_t length = one->fft.length;
    const double share = fmin((piece->high - piece->low) / one->wide[1], 1);
    const size_t count =
        LINES_LEAST / 2 + (size_t)((double)(one->across - LINES_LEAST / 2) * share);
    double *x = ARENA_ARRAY(one->arena, count, double), *w = ARENA_ARRAY(one->arena, count, double);
    double *re = ARENA_ARRAY(one->arena, FFT_LANES * length, double);
    double *im = ARENA_ARRAY(one->arena, FFT_LANES * length, double);
    gauss_rule(count, x, w);
    for (size_t done = 0; done < count; done += PAIRS) {
        for (size_t k = 0; k < FFT_LANES * length; k++) {
            re[k] = im[k] = 0;
        }
        for (size_t i = 0; i < PAIRS && done + i < count; i++) {
            struct exit_spans spans;
            double slope, *real = re + 2 * i * length;
            const double t = exit_piece_at(piece, PI * (x[done + i] - 0.5), &slope, &spans);
            put_line(one, &spans, t, sqrt(PI * w[done + i] * slope), real, im + 2 * i * length,
                     real + length);
        }
        const struct fft_lines lines = {re, im, FFT_LANES, length, 1};
        fft_transform(&one->fft, false, &lines, FFT_BEST, one->arena);
        for (size_t k = 0; k < FFT_LANES; k++) {
            double *power = one->power[k % 2];
            for (size_t i = k * length, j = 0; j < length; i++, j++) {
                power[j] += re[i] * re[i] + im[i] * im[i];
            }
        }
    }
    arena_reset(one->arena, mark);
}

/* What a direction has at the frequencies, of all wavelengths. */
struct sums {
    double *re, *im, *perfect, light;
};

static void add_overlaps(const struct overlapping *one, size_t count, double weight,
                         struct sums *sums)
{
    const size_t length = one->fft.length;
    double *zero = ARENA_ARRAY(one->arena, 2 * length, double);
    for (size_t i = 0; i < 2 * length; i++) {
        zero[i] = 0;
    }
    for (size_t k = 0; k < 2; k++) {
        const struct fft_lines line = {one->power[k], zero + k * length, 1, length, 1};
        fft_transform(&one->fft, true, &line, FFT_BEST, one->arena);
    }
    const double unit = weight * one->step / (double)length;
    /* cells that are clear in part say too little of themselves, but not of others */
    sums->re[0] += weight * one->pupil->energy;
    sums->perfect[0] += weight * one->pupil->energy;
    for (size_t i = 1; i < count && i * one->lag < one->cells; i++) {
        sums->re[i] += unit * one->power[0][i * one->lag];
        sums->im[i] += unit * zero[i * one->lag];
        sums->perfect[i] += unit * one->power[1][i * one->lag];
    }
}

static bool add_pupil(const struct mtf_source *source, size_t g, size_t direction, double step,
                      size_t count, struct arena *arena, struct sums *sums)
{
    const struct exit_pupil *pupil = &source->pupils.list[g];
    const struct arena_mark mark = arena_mark(arena);
    const double weight = exit_pupil_weight(pupil);
    struct overlapping one = {
        .pupil = pupil, .lines = &source->lines[g * MTF_DIRECTIONS + direction], .arena = arena};
    for (int k = 0; k < 2; k++) {
        double range[2];
        exit_pupil_range(pupil, k == 0 ? one.lines->along : one.lines->across, range);
        one.middle[k] = (range[0] + range[1]) / 2;
        one.wide[k] = range[1] - range[0];
    }
    const bool done = set_grid(&one, step / (pupil->waves * pupil->n));
    for (size_t i = 0; i < one.lines->count && done; i++) {
        add_piece(&one, &one.lines->pieces[i]);
    }
    if (done) {
        add_overlaps(&one, count, weight, sums);
        sums->light += weight * pupil->energy;
    }
    arena_reset(arena, mark);
    return done;
}

bool mtf_curve_find(const struct mtf_source *source, double step, size_t count, struct arena *arena,
                    struct mtf_curve *curve)
{
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        struct sums sums = {ARENA_ARRAY(arena, count, double), ARENA_ARRAY(arena, count, double),
                            ARENA_ARRAY(arena, count, double), 0};
        for (size_t i = 0; i < count; i++) {
            sums.re[i] = sums.im[i] = sums.perfect[i] = 0;
        }
        for (size_t g = 0; g < source->pupils.lights.count; g++) {
            if (source->pupils.lights.list[g].weight > 0 &&
                !add_pupil(source, g, k, step, count, arena, &sums)) {
                return false;
            }
        }
        curve->contrast[k] = sums.re;
        curve->limit[k] = sums.perfect;
        for (size_t i = 0; i < count; i++) {
            curve->contrast[k][i] = fmin(hypot(sums.re[i], sums.im[i]) / sums.light, 1);
            curve->limit[k][i] = fmin(sums.perfect[i] / sums.light, 1);
        }
    }
    return true;
}
