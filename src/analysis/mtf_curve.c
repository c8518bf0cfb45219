/* analysis/mtf_curve.c - contrast at many even frequencies at once, for drawings. */
/* SPDX-License-Identifier: MIT */
#include "analysis/mtf_curve.h"

#include "base/constants.h"
#include "base/fft.h"
#include "base/instruction_set.h"
#include "trace/sample.h"

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

/* Of the lines that are transformed side by side those with wave fronts are so many; two of their
   perfect ones make one of the others. */
enum { WAVES = 5, PERFECT = 3 };
_Static_assert(WAVES + PERFECT == FFT_LANES && 2 * PERFECT >= WAVES, "room for all");

/* Turns that W1 - W2 may make from cell to cell of CELLS: what cells at an edge get wrong goes with
   the square of them, and with the size of a cell; and of any number. */
static const double steep = 0.15, steepest = 0.4;

/* Lines for each turn of a phase that is as steep everywhere: Gauss's converge from pi/2 on, but
   those kinks are the worse the more it turns. */
static const double a_turn = 2.2;

/* How far series of n terms hold beyond their ends: T_n grows by exp(5) up to there. */
static double beyond(const struct exit_series *series)
{
    const double n = fmax((double)series->wave_count, (double)series->amplitude_count);
    return 1 + 12.5 / (n * n);
}

/* The overlap of one pupil in one direction. */
struct overlapping {
    const struct exit_front *front;
    double middle[2], wide[2]; /* along and across */
    double step;               /* of cells */
    size_t lag, cells, across; /* cells of one frequency, and of the pupil; lines of it */
    struct fft fft;
    double *power[2]; /* with the wave front, and with a perfect one */
    struct arena *arena;
};

/* Turns of W1 - W2 in a coarse grid, for shifts up to so many of its places: the most from place to
   place along lines, and of all of them across if they were as steep as the steepest to Gauss's
   points of the angle. NaN stands where nothing is clear. */
static void find_turns(const double (*waves)[LOOKS], size_t most, double *along, double *across)
{
    *along = *across = 0;
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
                *along = fmax(*along, next); /* not of NaN */
                *across = fmax(*across, PI / 2 * LOOKS * sqrt(1 - sine * sine) * beside);
            }
        }
    }
}

/* W of a line at even places along the pupil, NaN where it is not clear. */
static void look_along(const struct overlapping *one, const struct exit_line *line, double *waves)
{
    struct exit_wave_lanes lanes = {.x = {0}};
    for (size_t j = 0; j < LOOKS; j++) {
        waves[j] = NAN;
    }
    for (size_t k = 0; k < line->spans.count; k++) {
        const double *edges = line->spans.edges + 2 * k;
        for (size_t j = 0; j < LOOKS; j++) {
            const double s = one->middle[0] + one->wide[0] * (((double)j + 0.5) / LOOKS - 0.5);
            lanes.x[j] = (2 * s - edges[0] - edges[1]) / (edges[1] - edges[0]);
        }
        KERNEL_FOR(SET_BEST, kernel_exit_wave)(&line->series[k], &lanes);
        for (size_t j = 0; j < LOOKS; j++) {
            waves[j] = fabs(lanes.x[j]) < 1 ? lanes.waves[j] : waves[j];
        }
    }
}

/* Turns for shifts up to the most: of W1 - W2 from cell to cell of the grid along, and across. */
static void look(const struct overlapping *one, double most, double *along, double *across)
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
        look_along(one, &line, waves[i]);
    }
    const double places = most * LOOKS / one->wide[0];
    const double whole = fmin(fmax(ceil(places), 1), LOOKS - 1);
    find_turns((const double(*)[LOOKS])waves, (size_t)whole, along, across);
    *along *= fmin(places, 1); /* less than a place */
    *across *= fmin(places, 1);
}

/* Cells and lines for a step of the shift; false: too many. */
static bool set_grid(struct overlapping *one, double shift, size_t count)
{
    double along, across;
    look(one, shift * (double)count, &along, &across);
    const double turns = 1.3 * LOOKS * along;
    const double cells =
        fmax(fmax(CELLS, turns / steepest), cbrt(CELLS * turns * turns / (steep * steep)));
    const double lag = ceil(shift * cells / one->wide[0]);
    const double lines = fmax(LINES_LEAST, LINES_STILL + a_turn * across);
    one->step = shift / lag;
    one->lag = (size_t)fmin(lag, CELLS_MOST);
    one->cells = (size_t)(1.02 * fmin(one->wide[0] / one->step, CELLS_MOST)) + 2;
    one->across = (size_t)fmin(lines, LINES_MOST);
    return one->wide[0] / one->step < CELLS_MOST && lines < LINES_MOST;
}

/* A line's cells from the first that is clear: complex with the wave front, and real without. */
static void put_line(const struct overlapping *one, const struct exit_line *line, double weight,
                     double *re, double *im, double *perfect)
{
    kernel_exit_wave *find = KERNEL_FOR(SET_BEST, kernel_exit_wave);
    const double first = line->spans.edges[0], cells = (double)one->cells;
    struct exit_wave_lanes lanes = {.x = {0}};
    for (size_t k = 0; k < line->spans.count; k++) {
        const double *edges = line->spans.edges + 2 * k, wide = edges[1] - edges[0];
        const double end_x = beyond(&line->series[k]);
        /* edges that were found between few nodes may cross: no cell lies before the first */
        const size_t from = (size_t)fmin(fmax((edges[0] - first) / one->step, 0), cells);
        const size_t end = (size_t)fmin(fmax(ceil((edges[1] - first) / one->step), 0), cells);
        for (size_t i = from; i < end; i += LANES) {
            const size_t left = end - i < LANES ? end - i : LANES;
            for (size_t l = 0; l < left; l++) {
                const double s = first + one->step * ((double)(i + l) + 0.5);
                /* the middle of a cell that is clear in part may lie beyond the edge */
                lanes.x[l] = fmin(fmax((2 * s - edges[0] - edges[1]) / wide, -end_x), end_x);
            }
            find(&line->series[k], &lanes);
            for (size_t l = 0; l < left; l++) {
                const double low = first + one->step * (double)(i + l);
                const double clear = fmin(edges[1], low + one->step) - fmax(edges[0], low);
                const double share = weight * fmax(0, clear) / one->step;
                re[i + l] += share * lanes.re[l];
                im[i + l] += share * lanes.im[l];
                perfect[i + l] += share * lanes.amplitudes[l];
            }
        }
    }
}

/* The power of lines that were transformed: of the first with wave fronts, and of perfect ones. Two
   of these are a complex line, in whose power what they have in common is odd, so that it does not
   come back in the real part. */
static void add_power(const struct overlapping *one, const double *re, const double *im)
{
    const size_t length = one->fft.length;
    for (size_t k = 0; k < FFT_LANES; k++) {
        const double *x = re + k * length, *y = im + k * length;
        double *power = one->power[k < WAVES ? 0 : 1];
        for (size_t j = 0; j < length; j++) {
            power[j] += x[j] * x[j] + y[j] * y[j];
        }
    }
}

/* Lines of one piece, each with and without its wave front. */
static void add_piece(const struct overlapping *one, size_t p)
{
    const struct arena_mark mark = arena_mark(one->arena);
    const struct exit_piece *piece = &one->front->lines->pieces[p];
    const size_t length = one->fft.length;
    const double share = fmin((piece->high - piece->low) / one->wide[1], 1);
    const size_t count = (size_t)((double)one->across * (1 + share) / 2);
    double *x = ARENA_ARRAY(one->arena, count, double), *w = ARENA_ARRAY(one->arena, count, double);
    double *re = ARENA_ARRAY(one->arena, FFT_LANES * length, double);
    double *im = ARENA_ARRAY(one->arena, FFT_LANES * length, double);
    gauss_rule(count, x, w);
    for (size_t done = 0; done < count; done += WAVES) {
        memset(re, 0, FFT_LANES * length * sizeof *re);
        memset(im, 0, FFT_LANES * length * sizeof *im);
        for (size_t i = 0; i < WAVES && done + i < count; i++) {
            struct exit_line line;
            exit_front_line(one->front, p, PI * (x[done + i] - 0.5), &line);
            double *perfect = (i % 2 == 0 ? re : im) + (WAVES + i / 2) * length;
            put_line(one, &line, sqrt(PI * w[done + i] * line.slope), re + i * length,
                     im + i * length, perfect);
        }
        const struct fft_lines lines = {re, im, FFT_LANES, length, 1};
        fft_transform(&one->fft, false, &lines, SET_BEST, one->arena);
        add_power(one, re, im);
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
    for (size_t k = 0; k < 2; k++) {
        const struct fft_lines line = {one->power[k], zero + k * length, 1, length, 1};
        fft_transform(&one->fft, true, &line, SET_BEST, one->arena);
    }
    const double unit = weight * one->step / (double)length;
    /* cells that are clear in part say too little of themselves, but not of others */
    sums->re[0] += weight * one->front->pupil->energy;
    sums->perfect[0] += weight * one->front->pupil->energy;
    for (size_t i = 1; i < count && i * one->lag < one->cells; i++) {
        sums->re[i] += unit * one->power[0][i * one->lag];
        sums->im[i] += unit * zero[i * one->lag];
        sums->perfect[i] += unit * one->power[1][i * one->lag];
    }
}

/* Plan one wavelength in one direction; false: it cannot be drawn. */
static bool plan(const struct mtf_source *source, size_t g, size_t direction, double step,
                 size_t count, struct overlapping *one)
{
    const struct exit_pupil *pupil = &source->pupils.list[g];
    const struct exit_front *front = &source->fronts[g * MTF_DIRECTIONS + direction];
    *one = (struct overlapping){.front = front};
    for (int k = 0; k < 2; k++) {
        double range[2];
        exit_pupil_range(pupil, k == 0 ? front->lines->along : front->lines->across, range);
        one->middle[k] = (range[0] + range[1]) / 2;
        one->wide[k] = range[1] - range[0];
    }
    return overlap_is_known(front->off) && set_grid(one, step / (pupil->waves * pupil->n), count);
}

static void add_pupil(struct overlapping *one, size_t count, struct arena *arena, struct sums *sums)
{
    const struct exit_pupil *pupil = one->front->pupil;
    const struct arena_mark mark = arena_mark(arena);
    const double weight = exit_pupil_weight(pupil);
    one->arena = arena;
    /* empty cells behind a line, so that it does not meet its other end up to the last shift */
    const size_t last = (count - 1) * one->lag;
    one->fft =
        fft_open(fft_length_from(one->cells + (last < one->cells ? last : one->cells)), arena);
    for (int k = 0; k < 2; k++) {
        one->power[k] = ARENA_ARRAY(arena, one->fft.length, double);
    }
    for (size_t i = 0; i < one->front->lines->count; i++) {
        add_piece(one, i);
    }
    add_overlaps(one, count, weight, sums);
    sums->light += weight * pupil->energy;
    arena_reset(arena, mark);
}

bool mtf_curve_find(const struct mtf_source *source, double step, size_t count, struct arena *arena,
                    struct mtf_curve *curve)
{
    const size_t lights = source->pupils.lights.count;
    struct overlapping *plans =
        arena_array(arena, lights * MTF_DIRECTIONS, sizeof(struct overlapping));
    for (size_t i = 0; i < lights * MTF_DIRECTIONS; i++) {
        if (!plan(source, i / MTF_DIRECTIONS, i % MTF_DIRECTIONS, step, count, &plans[i])) {
            return false;
        }
    }
    for (size_t k = 0; k < MTF_DIRECTIONS; k++) {
        struct sums sums = {ARENA_ARRAY(arena, count, double), ARENA_ARRAY(arena, count, double),
                            ARENA_ARRAY(arena, count, double), 0};
        for (size_t g = 0; g < lights; g++) {
            if (source->pupils.lights.list[g].weight > 0) {
                add_pupil(&plans[g * MTF_DIRECTIONS + k], count, arena, &sums);
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
