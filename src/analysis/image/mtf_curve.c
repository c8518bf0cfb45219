/* analysis/image/mtf_curve.c - contrast at many even frequencies at once, for drawings. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/mtf_curve.h"

#include "base/constants.h"
#include "base/fft.h"
#include "base/instruction_set.h"
#include "trace/aim/sample.h"

#include <math.h>
#include <string.h>

/* Cells and lines: these at least, as overlaps end with a kink that Gauss's rule does not know; and
   without a turn of the phase. */
enum {
    CELLS = 112,
    CELLS_MOST = 4096,
    LINES_LEAST = 72,
    LINES_STILL = 28,
    LINES_MOST = 2048,
    LOOKS = 24
};
enum { LANES = EXIT_SERIES_LANES };

/* Turns that W1 - W2 may make from cell to cell of CELLS: what cells at an edge get wrong goes with
   the square of them, and with the size of a cell; and of any number. */
static const double steep = 0.15, steepest = 0.4;

/* Lines for each turn of a phase that is as steep everywhere: Gauss's converge from pi/2 on, but
   those kinks are the worse the more it turns. */
static const double a_turn = 2.2;

/*
 * Turns that W1 - W2 makes: the most from place to place along lines, and of all of them across if
 * they were as steep as the steepest, to Gauss's points of the angle and to even ones.
 */
struct mtf_curve_turns {
    double along, across, even;
};

/* The overlap of one pupil in one direction, or of the same pupil with a perfect wave front, which
   wants fewer cells and lines. */
struct curve_pupil_overlap {
    const struct exit_front *front;
    bool is_perfect;
    double middle[2], wide[2]; /* along and across */
    double step;               /* of cells */
    size_t lag, cells;         /* cells of one frequency, and of the pupil */
    struct mtf_curve_turns turns;
    struct fft fft;
    double *power;
    struct arena *arena;
};

/* The turns in a coarse grid, for shifts up to so many of its places. NaN stands where nothing is
   clear. */
static struct mtf_curve_turns mtf_curve_find_turns(const double (*waves)[LOOKS], size_t most)
{
    struct mtf_curve_turns turns = {0, 0, 0};
    for (size_t shift = 1; shift <= most; shift++) {
        double rows[LOOKS][LOOKS];
        for (size_t i = 0; i < LOOKS; i++) {
            for (size_t j = 0; j + shift < LOOKS; j++) {
                rows[i][j] = waves[i][j + shift] - waves[i][j];
            }
        }
        for (size_t j = 0; j + shift < LOOKS; j++) {
            for (size_t i = 0; i < LOOKS; i++) {
                const double next = j + shift + 1 < LOOKS ? fabs(rows[i][j + 1] - rows[i][j]) : 0;
                const double beside = i + 1 < LOOKS ? fabs(rows[i + 1][j] - rows[i][j]) : 0;
                const double sine = 2 * ((double)i + 1) / LOOKS - 1;
                turns.along = fmax(turns.along, next); /* not of NaN */
                turns.across = fmax(turns.across, PI / 2 * LOOKS * sqrt(1 - sine * sine) * beside);
                turns.even = fmax(turns.even, PI / 2 * LOOKS * beside);
            }
        }
    }
    return turns;
}

/* Turns for shifts up to the most. */
static struct mtf_curve_turns mtf_curve_look(const struct curve_pupil_overlap *one, double most)
{
    const struct exit_lines *lines = one->front->lines;
    double waves[LOOKS][LOOKS];
    for (size_t i = 0; i < LOOKS; i++) {
        const double t = one->middle[1] + one->wide[1] * (((double)i + 0.5) / LOOKS - 0.5);
        struct exit_line line;
        line.spans.count = 0;
        for (size_t p = 0; p < lines->count; p++) {
            const struct exit_piece *piece = &lines->pieces[p];
            if (t > piece->low && t < piece->high) {
                const double x = (2 * t - piece->low - piece->high) / (piece->high - piece->low);
                exit_front_line(one->front, p, asin(x), &line);
            }
        }
        /* W of a line at even places along the pupil, NaN where it is not clear. */
        double xs[LANES] = {0}, here[LANES], amplitudes[LANES];
        for (size_t j = 0; j < LOOKS; j++) {
            waves[i][j] = NAN;
        }
        for (size_t k = 0; k < line.spans.count; k++) {
            const double *edges = line.spans.edges + 2 * k;
            for (size_t j = 0; j < LOOKS; j++) {
                const double s = one->middle[0] + one->wide[0] * (((double)j + 0.5) / LOOKS - 0.5);
                xs[j] = (2 * s - edges[0] - edges[1]) / (edges[1] - edges[0]);
            }
            KERNEL_FOR(SET_BEST, kernel_exit_values)(&line.series[k], xs, here, amplitudes);
            for (size_t j = 0; j < LOOKS; j++) {
                waves[i][j] = fabs(xs[j]) < 1 ? here[j] : waves[i][j];
            }
        }
    }
    const double places = most * LOOKS / one->wide[0];
    const double whole = fmin(fmax(ceil(places), 1), LOOKS - 1);
    const struct mtf_curve_turns turns =
        mtf_curve_find_turns((const double(*)[LOOKS])waves, (size_t)whole);
    const double part = fmin(places, 1); /* of a place */
    return (struct mtf_curve_turns){part * turns.along, part * turns.across, part * turns.even};
}

/* Lines that a share of the pupil across wants. */
static double lines_for(const struct mtf_curve_turns *turns, double share)
{
    const double most = (1 + share) / 2, across = fmin(most * turns->across, share * turns->even);
    return fmax(most * LINES_LEAST, most * LINES_STILL + a_turn * across);
}

/* Cells and lines for a step of the shift; false: too many. */
static bool mtf_curve_set_grid(struct curve_pupil_overlap *one, double shift, size_t count)
{
    one->turns = one->is_perfect ? (struct mtf_curve_turns){0, 0, 0}
                                 : mtf_curve_look(one, shift * (double)count);
    const double turns = 1.3 * LOOKS * one->turns.along;
    const double cells =
        fmax(fmax(CELLS, turns / steepest), cbrt(CELLS * turns * turns / (steep * steep)));
    const double lag = ceil(shift * cells / one->wide[0]);
    one->step = shift / lag;
    one->lag = (size_t)fmin(lag, CELLS_MOST);
    one->cells = (size_t)(1.02 * fmin(one->wide[0] / one->step, CELLS_MOST)) + 2;
    return one->wide[0] / one->step < CELLS_MOST && lines_for(&one->turns, 1) < LINES_MOST;
}

/* A line's cells from the first that is clear: complex, or real of a perfect wave front. */
static void mtf_curve_put_line(const struct curve_pupil_overlap *one, const struct exit_line *line,
                               double weight, double *re, double *im)
{
    kernel_exit_values *find = KERNEL_FOR(SET_BEST, kernel_exit_values);
    const double first = line->spans.edges[0], cells = (double)one->cells;
    double x[LANES] = {0}, waves[LANES], amplitudes[LANES], none[LANES] = {0}, all[LANES];
    double shares[LANES], cosines[LANES], sines[LANES];
    const struct pupil_cross cross = {LANES, {waves, none}, {amplitudes, all}, shares, cosines,
                                      sines, NULL};
    for (size_t l = 0; l < LANES; l++) {
        all[l] = 1;
    }
    for (size_t k = 0; k < line->spans.count; k++) {
        const double *edges = line->spans.edges + 2 * k, wide = edges[1] - edges[0];
        /* How far series of n terms hold beyond their ends: T_n grows by exp(5) up to there. */
        const double n =
            fmax((double)line->series[k].wave_count, (double)line->series[k].amplitude_count);
        const double end_x = 1 + 12.5 / (n * n);
        /* edges that were found between few nodes may cross: no cell lies before the first */
        const size_t from = (size_t)fmin(fmax((edges[0] - first) / one->step, 0), cells);
        const size_t end = (size_t)fmin(fmax(ceil((edges[1] - first) / one->step), 0), cells);
        for (size_t i = from; i < end; i += LANES) {
            const size_t left = end - i < LANES ? end - i : LANES;
            memset(shares, 0, sizeof shares);
            for (size_t l = 0; l < left; l++) {
                const double low = first + one->step * (double)(i + l);
                const double clear = fmin(edges[1], low + one->step) - fmax(edges[0], low);
                const double s = low + one->step / 2;
                shares[l] = weight * fmax(0, clear) / one->step;
                /* the middle of a cell that is clear in part may lie beyond the edge */
                x[l] = fmin(fmax((2 * s - edges[0] - edges[1]) / wide, -end_x), end_x);
            }
            find(&line->series[k], x, waves, amplitudes);
            if (!one->is_perfect) {
                pupil_cross(&cross);
            }
            for (size_t l = 0; l < left; l++) {
                re[i + l] += one->is_perfect ? shares[l] * amplitudes[l] : cosines[l];
                if (!one->is_perfect) {
                    im[i + l] += sines[l];
                }
            }
        }
    }
}

/*
 * Lines of one piece. Two of a perfect wave front are a complex line, in whose power what they have
 * in common is odd, so that it does not come back in the real part.
 *
 * Given     times  that the piece counts: for its mirror image too
 *           halves  of a piece that is its own mirror image half the lines do
 */
static void add_piece(const struct curve_pupil_overlap *one, size_t p, double times, bool halves)
{
    const struct arena_mark mark = arena_mark(one->arena);
    const struct exit_piece *piece = &one->front->lines->pieces[p];
    const size_t length = one->fft.length, abreast = (one->is_perfect ? 2 : 1) * FFT_LANES;
    const double share = fmin((piece->high - piece->low) / one->wide[1], 1);
    const size_t count = (size_t)lines_for(&one->turns, share);
    const size_t some = halves ? (count + 1) / 2 : count;
    double *x = ARENA_ARRAY(one->arena, count, double), *w = ARENA_ARRAY(one->arena, count, double);
    double *re = ARENA_ARRAY(one->arena, FFT_LANES * length, double);
    double *im = ARENA_ARRAY(one->arena, FFT_LANES * length, double);
    gauss_rule(count, x, w);
    for (size_t done = 0; done < some; done += abreast) {
        memset(re, 0, FFT_LANES * length * sizeof *re);
        memset(im, 0, FFT_LANES * length * sizeof *im);
        for (size_t i = 0; i < abreast && done + i < some; i++) {
            struct exit_line line;
            const size_t at = done + i;
            const double counts = halves && 2 * at + 1 != count ? 2 * times : times;
            exit_front_line(one->front, p, PI * (x[at] - 0.5), &line);
            double *real = i < FFT_LANES ? re + i * length : im + (i - FFT_LANES) * length;
            mtf_curve_put_line(one, &line, sqrt(PI * counts * w[at] * line.slope), real,
                               one->is_perfect ? NULL : im + i * length);
        }
        const struct fft_lines lines = {re, im, FFT_LANES, length, 1};
        fft_transform(&one->fft, false, &lines, SET_BEST, one->arena);
        /* Add the power of lines that were transformed. */
        for (size_t k = 0; k < FFT_LANES; k++) {
            const double *a = re + k * length, *b = im + k * length;
            for (size_t j = 0; j < length; j++) {
                one->power[j] += a[j] * a[j] + b[j] * b[j];
            }
        }
    }
    arena_reset(one->arena, mark);
}

/* What a direction has at the frequencies, of all wavelengths. */
struct mtf_curve_sums {
    double *re, *im, *perfect, light;
};

static void add_overlaps(const struct curve_pupil_overlap *one, size_t count, double weight,
                         struct mtf_curve_sums *sums)
{
    const size_t length = one->fft.length;
    double *zero = ARENA_ARRAY(one->arena, length, double);
    const struct fft_lines line = {one->power, zero, 1, length, 1};
    fft_transform(&one->fft, true, &line, SET_BEST, one->arena);
    const double unit = weight * one->step / (double)length;
    double *real = one->is_perfect ? sums->perfect : sums->re;
    /* cells that are clear in part say too little of themselves, but not of others */
    real[0] += weight * one->front->pupil->energy;
    for (size_t i = 1; i < count && i * one->lag < one->cells; i++) {
        real[i] += unit * one->power[i * one->lag];
        if (!one->is_perfect) {
            sums->im[i] += unit * zero[i * one->lag];
        }
    }
}

bool mtf_curve_find(const struct mtf_source *source, double step, size_t count, struct arena *arena,
                    struct mtf_curve *curve)
{
    enum { BOTH = 2 }; /* with the wave front, and with a perfect one */
    const size_t lights = source->pupils.lights.count, each = lights * BOTH;
    struct curve_pupil_overlap *plans =
        arena_array(arena, source->directions * each, sizeof(struct curve_pupil_overlap));
    for (size_t i = 0; i < source->directions * each; i++) {
        const struct exit_front *front =
            &source->fronts[i % each / BOTH * MTF_DIRECTIONS + i / each];
        const struct exit_pupil *pupil = front->pupil;
        plans[i] = (struct curve_pupil_overlap){.front = front, .is_perfect = i % BOTH == 1};
        for (int m = 0; m < 2; m++) {
            double range[2];
            exit_pupil_range(pupil, m == 0 ? front->lines->along : front->lines->across, range);
            plans[i].middle[m] = (range[0] + range[1]) / 2;
            plans[i].wide[m] = range[1] - range[0];
        }
        if (!overlap_is_known(front->off) ||
            !mtf_curve_set_grid(&plans[i], step / (pupil->waves * pupil->n), count)) {
            return false;
        }
    }
    for (size_t k = 0; k < source->directions; k++) {
        struct mtf_curve_sums sums = {ARENA_ARRAY(arena, count, double),
                                      ARENA_ARRAY(arena, count, double),
                                      ARENA_ARRAY(arena, count, double), 0};
        for (size_t i = 0; i < each; i++) {
            const struct wave_light *light = &source->pupils.lights.list[i / BOTH];
            if (light->weight > 0) {
                const struct arena_mark mark = arena_mark(arena);
                struct curve_pupil_overlap *one = &plans[k * each + i];
                one->arena = arena;
                /* empty cells behind a line, so that it does not meet its other end up to the last
                   shift */
                const size_t last = (count - 1) * one->lag;
                const size_t length = one->cells + (last < one->cells ? last : one->cells);
                one->fft = fft_open(fft_length_from(length), arena);
                one->power = ARENA_ARRAY(arena, one->fft.length, double);
                /* Of pieces that are mirror images of each other the first counts twice. */
                const struct exit_lines *lines = one->front->lines;
                const size_t pieces = lines->count;
                for (size_t j = 0; j < (lines->is_mirrored_across ? (pieces + 1) / 2 : pieces);
                     j++) {
                    const bool is_middle = 2 * j + 1 == pieces;
                    add_piece(one, j, lines->is_mirrored_across && !is_middle ? 2 : 1,
                              lines->is_mirrored_across && is_middle);
                }
                add_overlaps(one, count, exit_pupil_weight(one->front->pupil), &sums);
                arena_reset(arena, mark);
            }
        }
        for (size_t g = 0; g < lights; g++) {
            const struct exit_pupil *pupil = &source->pupils.list[g];
            sums.light += pupil->light->weight > 0 ? exit_pupil_weight(pupil) * pupil->energy : 0;
        }
        curve->contrast[k] = sums.re;
        curve->limit[k] = sums.perfect;
        for (size_t i = 0; i < count; i++) {
            curve->contrast[k][i] = fmin(hypot(sums.re[i], sums.im[i]) / sums.light, 1);
            curve->limit[k][i] = fmin(sums.perfect[i] / sums.light, 1);
        }
    }
    for (size_t k = source->directions; k < MTF_DIRECTIONS; k++) {
        curve->contrast[k] = curve->contrast[0];
        curve->limit[k] = curve->limit[0];
    }
    return true;
}
