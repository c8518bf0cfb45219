/* analysis/image/psf_light.c - the light of one wavelength, as a sum of waves over the pupil. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_light.h"

#include "analysis/waves/exit_lines.h"
#include "base/constants.h"
#include "base/instruction_set.h"
#include "base/parallel.h"
#include "base/turns.h"
#include "trace/aim/sample.h"

#include <math.h>
#include <string.h>

enum {
    LEAST = 14, /* points along a line, and lines */
    MORE = 128, /* that a rule has more points than are wanted, at most */
    TURNS_MOST = PSF_TURNS_MOST,
    SIZE_LEAST = 8 /* of an image that says something */
};

/* More for each turn of the phase: along a line, and lines. */
static const double along_turn = 1.75, across_turn = 3.3;

/* Points at work. */
struct point_placer {
    const struct psf_plane *plane;
    struct psf_points *points;
    double *weights;
    double half[2], turns[2]; /* of the pupil and of the phase: along lines, and across them */
    struct gauss_rules *rules;
};

/* Turns of the phase across half a width of the pupil and the other, so far from the reference. */
static double turns_across(const struct psf_plane *plane, double half, double far)
{
    return 2 * half * (far + plane->spread) * plane->pupil->n * plane->pupil->waves;
}

static double turns_at(const struct psf_plane *plane, double far)
{
    const double *half = plane->pupil->half;
    return fmax(turns_across(plane, half[0], far), turns_across(plane, half[1], far));
}

static double psf_points_farthest(const struct psf_plane *plane)
{
    return 0.5 * (double)plane->size * plane->pitch;
}

double psf_points_turns(const struct psf_plane *plane)
{
    return turns_at(plane, psf_points_farthest(plane));
}

bool psf_points_fit(const struct psf_plane *plane, struct error *error)
{
    const double turns = psf_points_turns(plane), own = turns_at(plane, 0);
    const double share = (TURNS_MOST - own) / (turns - own); /* of the image */
    const double size = ceil(share * (double)plane->size) - 1;
    if (turns < TURNS_MOST) {
        return true;
    }
    if (!(own < TURNS_MOST)) {
        return fail(error, ERROR_DOMAIN,
                    "the wave front is too steep for waves to be added up: its phase turns %.0f "
                    "times across the pupil, and sums take %d: a smaller aperture, or rays (spot)",
                    own, TURNS_MOST);
    }
    return size >= SIZE_LEAST
               ? fail(error, ERROR_DOMAIN,
                      "the phase turns %.0f times across the pupil at the edge of the image, and "
                      "sums take %d: at most {size} %.0f with {pitch} %.4g %s",
                      turns, TURNS_MOST, size, 1000 * plane->pitch, plane->unit)
               : fail(error, ERROR_DOMAIN,
                      "the phase turns %.0f times across the pupil at the edge of the image, and "
                      "sums take %d: at most {pitch} %.4g %s with {size} %zu",
                      turns, TURNS_MOST, 0.999 * share * 1000 * plane->pitch, plane->unit,
                      plane->size);
}

static size_t points_along(const struct point_placer *putting, double length)
{
    const double share = length / (2 * putting->half[0]);
    return LEAST + (size_t)(along_turn * putting->turns[0] * fmin(share, 1));
}

static size_t lines_across(const struct point_placer *putting, const struct exit_piece *piece)
{
    const double share = (piece->high - piece->low) / (2 * putting->half[1]);
    return LEAST + (size_t)(across_turn * putting->turns[1] * fmin(share, 1));
}

bool psf_points_put(const struct psf_plane *plane, struct psf_points *points, struct error *error)
{
    const bool is_x = !(hypot(plane->along[0], plane->along[1]) > 0);
    const double along_line[2] = {is_x ? 1 : plane->along[0], is_x ? 0 : plane->along[1]};
    const double *box = plane->pupil->half;
    struct arena *arena = plane->arena;
    struct exit_lines *lines = ARENA_NEW(arena, struct exit_lines);
    struct point_placer putting = {
        .plane = plane, .points = points, .rules = gauss_rules_new(arena)};
    for (int k = 0; k < 2; k++) {
        putting.half[k] = fabs(along_line[k]) * box[0] + fabs(along_line[1 - k]) * box[1];
        putting.turns[k] = turns_across(plane, putting.half[k], psf_points_farthest(plane));
    }
    if (!psf_points_fit(plane, error)) {
        return false;
    }
    exit_lines_find(plane->pupil, along_line, arena, lines);
    const size_t along = points_along(&putting, INFINITY) + EXIT_SPANS * (LEAST + MORE);
    size_t line_room = 0;
    for (size_t p = 0; p < lines->count; p++) {
        line_room += lines_across(&putting, &lines->pieces[p]) + MORE;
    }
    *putting.points =
        (struct psf_points){.at = arena_array(arena, line_room * along, sizeof(double[2])),
                            .ends = ARENA_ARRAY(arena, line_room, size_t),
                            .widths = ARENA_ARRAY(arena, line_room, double)};
    putting.weights = ARENA_ARRAY(arena, line_room * along, double);
    for (size_t p = 0; p < lines->count; p++) {
        const struct exit_piece *piece = &lines->pieces[p];
        const struct gauss_panels rows =
            gauss_panels_of(putting.rules, (double)lines_across(&putting, piece));
        for (size_t i = 0; i < rows.each * rows.panels; i++) {
            /* The points of one line. */
            const size_t before = points->count;
            struct exit_spans spans;
            double slope;
            const double t =
                exit_piece_at(piece, PI * (gauss_panels_at(&rows, i) - 0.5), &slope, &spans);
            const double width = (PI * gauss_panels_weight(&rows, i)) * slope;
            for (size_t j = 0; j < spans.count; j++) {
                const double low = spans.edges[2 * j], length = spans.edges[2 * j + 1] - low;
                if (!(length > 0)) {
                    continue;
                }
                const struct gauss_panels rule =
                    gauss_panels_of(putting.rules, (double)points_along(&putting, length));
                for (size_t k = 0; k < rule.each * rule.panels; k++, points->count++) {
                    const double s = low + length * gauss_panels_at(&rule, k);
                    for (int m = 0; m < 2; m++) {
                        points->at[points->count][m] = s * lines->along[m] + t * lines->across[m];
                    }
                    putting.weights[points->count] = width * length * gauss_panels_weight(&rule, k);
                }
            }
            if (points->count > before) {
                points->widths[points->lines] = width;
                points->ends[points->lines++] = points->count;
            }
        }
    }
    points->waves = ARENA_ARRAY(arena, points->count, double);
    points->amplitudes = ARENA_ARRAY(arena, points->count, double);
    exit_pupil_values(plane->pupil, (const double(*)[2])points->at, points->count, points->waves,
                      points->amplitudes);
    for (size_t i = 0; i < points->count; i++) {
        points->amplitudes[i] *= putting.weights[i];
        points->total += points->amplitudes[i];
        points->waves[i] = plane->is_perfect ? 0 : points->waves[i];
    }
    return true;
}

/* -------- plane waves -------- */

/* Spread the points of a line over the cells of frequency. */
static void psf_line_put(const struct nufft *nufft, const struct psf_points *points,
                         const double across_place[2], size_t line, double *re, double *im)
{
    for (size_t i = line > 0 ? points->ends[line - 1] : 0; i < points->ends[line]; i++) {
        const double turns =
            points->at[i][0] * across_place[0] + points->at[i][1] * across_place[1];
        const struct nufft_wave wave = nufft_wave(nufft, turns);
        double c, s;
        turns_of(points->waves[i], &c, &s);
        c *= points->amplitudes[i];
        s *= points->amplitudes[i];
        for (size_t k = 0, cell = wave.first; k < NUFFT_TAPS; k++) {
            re[cell] += wave.shares[k] * c;
            im[cell] += wave.shares[k] * s;
            cell = nufft_next(nufft, cell);
        }
    }
}

size_t psf_lines_transform(const struct nufft *nufft, const struct psf_points *points,
                           const double across_place[2], size_t first, struct psf_cells *cells)
{
    const size_t length = nufft->fft.length, left = points->lines - first;
    const struct fft_lines lines = {cells->re, cells->im, left < FFT_LANES ? left : FFT_LANES,
                                    length, 1};
    memset(cells->re, 0, FFT_LANES * length * sizeof *cells->re);
    memset(cells->im, 0, FFT_LANES * length * sizeof *cells->im);
    for (size_t l = 0; l < lines.count; l++) {
        psf_line_put(nufft, points, across_place, first + l, cells->re + l * length,
                     cells->im + l * length);
    }
    fft_transform(&nufft->fft, false, &lines, SET_BEST, cells->arena);
    return lines.count;
}

struct psf_cells psf_cells_new(const struct nufft *nufft, struct arena *arena)
{
    const size_t room = FFT_LANES * nufft->fft.length;
    return (struct psf_cells){ARENA_ARRAY(arena, room, double), ARENA_ARRAY(arena, room, double),
                              arena};
}

/* Sums over the points of each line, at each column of the image. */
struct psf_line_sums {
    double *re, *im;                /* size each line */
    const struct nufft_wave *waves; /* of the lines, from row to row */
    size_t lines;
};

enum { COLUMNS = 4 * FFT_LANES };

/* Sums of lines at all rows of some columns. */
static void psf_columns_add(const struct psf_plane *plane, const struct nufft *nufft,
                            const struct psf_line_sums *sums, size_t first)
{
    const struct arena_mark mark = arena_mark(plane->arena);
    const size_t length = nufft->fft.length, size = plane->size;
    const size_t columns = size - first < COLUMNS ? size - first : COLUMNS;
    double *re = ARENA_ARRAY(plane->arena, length * COLUMNS, double);
    double *im = ARENA_ARRAY(plane->arena, length * COLUMNS, double);
    for (size_t k = 0; k < sums->lines; k++) {
        const double *from_re = sums->re + k * size + first, *from_im = sums->im + k * size + first;
        for (size_t tap = 0, cell = sums->waves[k].first; tap < NUFFT_TAPS; tap++) {
            const double share = sums->waves[k].shares[tap];
            double *to_re = re + cell * COLUMNS, *to_im = im + cell * COLUMNS;
            for (size_t x = 0; x < columns; x++) {
                to_re[x] += share * from_re[x];
                to_im[x] += share * from_im[x];
            }
            cell = nufft_next(nufft, cell);
        }
    }
    const struct fft_lines lines = {re, im, columns, 1, COLUMNS};
    fft_transform(&nufft->fft, false, &lines, SET_BEST, plane->arena);
    for (size_t y = 0; y < size; y++) {
        const size_t cell = nufft_cell(nufft, y) * COLUMNS;
        for (size_t x = 0; x < columns; x++) {
            plane->re[y * size + first + x] = re[cell + x] / nufft->left[y];
            plane->im[y * size + first + x] = im[cell + x] / nufft->left[y];
        }
    }
    arena_reset(plane->arena, mark);
}

/* A wave is that of its x times that of its y: rows of a line's points, then columns of lines. */
bool psf_by_plane(struct psf_plane *plane, struct error *error)
{
    const size_t size = plane->size;
    const double wave = plane->pupil->n * plane->pupil->waves * plane->pitch;
    const double across_place[2] = {wave, 0};
    struct psf_points points;
    if (!psf_points_put(plane, &points, error)) {
        return false;
    }
    struct arena *arena = plane->arena;
    const struct nufft nufft = nufft_open(size, arena);
    struct psf_cells cells = psf_cells_new(&nufft, arena);
    struct nufft_wave *waves = ARENA_ARRAY(arena, points.lines, struct nufft_wave);
    const struct psf_line_sums sums = {ARENA_ARRAY(arena, points.lines * size, double),
                                       ARENA_ARRAY(arena, points.lines * size, double), waves,
                                       points.lines};
    for (size_t first = 0, count; first < points.lines; first += count) {
        count = psf_lines_transform(&nufft, &points, across_place, first, &cells);
        for (size_t l = 0; l < count; l++) {
            const size_t line = first + l, last = points.ends[line] - 1;
            double *re = sums.re + line * size, *im = sums.im + line * size;
            waves[line] = nufft_wave(&nufft, points.at[last][1] * wave);
            for (size_t x = 0; x < size; x++) {
                const size_t cell = l * nufft.fft.length + nufft_cell(&nufft, x);
                re[x] = cells.re[cell] / nufft.left[x];
                im[x] = cells.im[cell] / nufft.left[x];
            }
        }
    }
    for (size_t first = 0; first < size; first += COLUMNS) {
        psf_columns_add(plane, &nufft, &sums, first);
    }
    plane->perfect = points.total;
    return true;
}

/* -------- wavelets -------- */

/* Wavelets may be off so many turns. */
static const double fine = 1e-8;

/* Cubics through Chebyshev's nodes. */
static struct psf_steps steps_of(size_t rows)
{
    /* differences at 0 of 1, j, j^2 and j^3 */
    static const double powers[PSF_NODES][PSF_NODES] = {
        {1, 0, 0, 0}, {0, 1, 1, 1}, {0, 0, 2, 6}, {0, 0, 0, 6}};
    struct psf_steps steps = {.rows = rows};
    for (size_t k = 0; k < PSF_NODES; k++) {
        const double node = cos(PI * ((double)k + 0.5) / PSF_NODES);
        steps.at[k] = ((double)rows * (1 + node) - 1) / 2;
    }
    for (size_t k = 0; k < PSF_NODES; k++) {
        double monomials[PSF_NODES];
        /* Monomials of the Lagrange polynomial of one of the nodes. */
        double over = 1, sums[PSF_NODES] = {1}; /* of the products of other nodes, by how many */
        for (size_t i = 0, count = 0; i < PSF_NODES; i++) {
            if (i != k) {
                over *= steps.at[k] - steps.at[i];
                count++;
                for (size_t j = count; j > 0; j--) {
                    sums[j] += sums[j - 1] * steps.at[i];
                }
            }
        }
        for (size_t j = 0; j < PSF_NODES; j++) {
            const size_t others = PSF_NODES - 1 - j;
            monomials[j] = (others % 2 == 0 ? 1 : -1) * sums[others] / over;
        }
        for (size_t m = 0; m < PSF_NODES; m++) {
            for (size_t power = 0; power < PSF_NODES; power++) {
                steps.differences[m][k] += powers[m][power] * monomials[power];
            }
        }
    }
    return steps;
}

/*
 * How many rows a cubic is good for: it leaves L^4/3072 of the fourth slope of r over a length L,
 * which is 3/r^3 at most, as r^2 is c^2 + s^2 along a line, and the slope 3 c^2 (4 s^2 - c^2)/r^7.
 */
static size_t rows_at_once(const struct psf_plane *plane, double radius, double waves)
{
    const double half = 0.5 * (double)plane->size * plane->pitch;
    const double near = fmax(radius - sqrt(2) * half, 0);
    const double length = sqrt(sqrt(1024 * fine * near * near * near / waves));
    const double rows = floor(fmin(length / plane->pitch, PSF_ROWS_MOST));
    const size_t parts = (plane->size + (size_t)fmax(rows, 1) - 1) / (size_t)fmax(rows, 1);
    return (plane->size + parts - 1) / parts;
}

/* All wavelets over some columns. */
static void add_strip(const struct psf_plane *plane, const struct psf_points *points,
                      const struct psf_strip *strip)
{
    kernel_psf *add_wavelet = KERNEL_FOR(SET_BEST, kernel_psf);
    const struct opd_reference *sphere = &plane->pupil->reference->opd;
    const double waves = plane->pupil->n * plane->pupil->waves;
    const size_t rows = rows_at_once(plane, sphere->radius, waves);
    for (size_t first = 0; first < plane->size; first += rows) {
        const size_t left = plane->size - first;
        const struct psf_steps steps = steps_of(left < rows ? left : rows);
        const struct psf_strip part = {strip->x, strip->y + (double)first * plane->pitch,
                                       plane->pitch, strip->re + first * PSF_LANES,
                                       strip->im + first * PSF_LANES};
        for (size_t i = 0; i < points->count; i++) {
            const struct psf_wavelet one = {
                .amplitude = points->amplitudes[i],
                .turns = points->waves[i],
                .waves = sphere->side * waves,
                .radius = sphere->radius,
                .bx = sphere->side * sphere->radius * points->at[i][0],
                .by = sphere->side * sphere->radius * points->at[i][1],
            };
            add_wavelet(&one, &steps, &part);
        }
    }
}

/* What threads add to a plane. */
struct psf_light_columns {
    struct psf_plane *plane;
    const struct psf_points *points;
};

/* Strips of columns. */
static void psf_light_add_columns(void *context, const struct parallel_piece *piece)
{
    const struct psf_light_columns *columns = context;
    const struct psf_plane *plane = columns->plane;
    const size_t size = plane->size, room = size * PSF_LANES;
    const double first = -(double)(size / 2) * plane->pitch;
    const struct arena_mark mark = arena_mark(piece->arena);
    for (size_t i = piece->begin; i < piece->end; i++) {
        const size_t x = i * PSF_LANES;
        const struct psf_strip strip = {.x = first + (double)x * plane->pitch,
                                        .y = first,
                                        .re = ARENA_ARRAY(piece->arena, room, double),
                                        .im = ARENA_ARRAY(piece->arena, room, double)};
        add_strip(plane, columns->points, &strip);
        for (size_t y = 0; y < size; y++) {
            for (size_t l = 0; l < PSF_LANES && x + l < size; l++) {
                plane->re[y * size + x + l] = strip.re[y * PSF_LANES + l];
                plane->im[y * size + x + l] = strip.im[y * PSF_LANES + l];
            }
        }
        arena_reset(piece->arena, mark);
    }
}

bool psf_by_huygens(struct psf_plane *plane, struct error *error)
{
    struct psf_points points;
    const struct opd_reference *reference = &plane->pupil->reference->opd;
    if (reference->is_plane || isinf(reference->radius)) {
        return fail(error, ERROR_DOMAIN,
                    "the %s lies infinitely far away, wavelets are plane: {method} plane",
                    reference->is_plane ? "image" : "exit pupil");
    }
    if (!psf_points_put(plane, &points, error)) {
        return false;
    }
    struct parallel *parallel = ARENA_NEW(plane->arena, struct parallel);
    struct psf_light_columns columns = {plane, &points};
    parallel->threads = plane->threads;
    parallel_pieces(parallel, (plane->size + PSF_LANES - 1) / PSF_LANES, 1, psf_light_add_columns,
                    &columns);
    parallel_free(parallel);
    plane->perfect = points.total;
    return true;
}
