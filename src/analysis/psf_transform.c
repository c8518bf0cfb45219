/* analysis/psf_transform.c - the light of one wavelength by a fast Fourier transform. */
/* SPDX-License-Identifier: MIT */
#include "analysis/psf_light.h"

#include "base/constants.h"
#include "base/fft.h"
#include "base/turns.h"

#include <math.h>

enum {
    CELLS = 128, /* across the pupil */
    ROWS = 8,    /* lines through a cell, which say what of it is clear */
};

/* A cell that is all clear but for rounding; Gauss's two points, from the middle to an end. */
static const double whole = 1 - 1e-9, gauss = 0.57735026918962576451;

/* So much of a turn neighbouring points of a grid may differ at most. */
static const double steepest = 0.2;

/* A grid of the pupil: cell i of a row about (i - length/2) step. */
struct grid {
    size_t length;
    double step, middle[2];
    double *re, *im;
};

/* How long the transform is to be; 0 with the error: no length is enough. */
static size_t length_for(const struct psf_plane *plane, struct error *error)
{
    const struct exit_pupil *pupil = plane->pupil;
    const double wide = 2 * fmax(pupil->half[0], pupil->half[1]);
    const double finest = 1 / (pupil->n * pupil->waves * wide); /* mm: the pupil fills the grid */
    const double by_slope = 2 * plane->spread * 0.5 / (steepest * plane->pitch);
    const double by_cells = CELLS * finest / plane->pitch;
    if (!(plane->pitch < finest)) {
        fail(error, ERROR_DOMAIN,
             "{pitch} %.4g um is too coarse for a Fourier transform: below %.4g um, or {method} "
             "plane",
             1000 * plane->pitch, 1000 * finest);
        return 0;
    }
    const double wanted = fmax(fmax(by_slope, by_cells), (double)plane->size);
    if (!(by_slope <= PSF_TRANSFORM_MOST)) {
        fail(error, ERROR_DOMAIN,
             "the wave front is too steep for a Fourier transform of %d points: at this pitch it "
             "wants %.0f, or {method} plane",
             PSF_TRANSFORM_MOST, ceil(by_slope));
        return 0;
    }
    return fft_length_from((size_t)fmin(ceil(wanted), PSF_TRANSFORM_MOST));
}

/* The piece that a line lies in, and its angle; null: none. */
static const struct exit_piece *piece_at(const struct exit_lines *lines, double t, double *angle)
{
    for (size_t i = 0; i < lines->count; i++) {
        const struct exit_piece *piece = &lines->pieces[i];
        if (t > piece->low && t < piece->high) {
            *angle = asin((2 * t - piece->low - piece->high) / (piece->high - piece->low));
            return piece;
        }
    }
    return NULL;
}

/* Points of a row of cells, and what they count, in cells. */
struct cells {
    double (*at)[2];
    double *weights;
    size_t *cells, count;
    double *clear; /* of each cell of the row */
};

/* Where the parts of a line lie, in cells from the first. */
static size_t parts_of(const struct exit_lines *lines, const struct grid *grid, double t,
                       double (*parts)[2])
{
    double angle, slope;
    const struct exit_piece *piece = piece_at(lines, t, &angle);
    const double first = (double)(grid->length / 2) + 0.5;
    struct exit_spans spans = {.count = 0};
    if (piece != NULL) {
        exit_piece_at(piece, angle, &slope, &spans);
    }
    for (size_t i = 0; i < spans.count; i++) {
        for (int k = 0; k < 2; k++) {
            const double at = (spans.edges[2 * i + (size_t)k] - grid->middle[0]) / grid->step;
            parts[i][k] = fmax(0, fmin(at + first, (double)grid->length));
        }
    }
    return spans.count;
}

static void put_point(const struct grid *grid, double x, double t, double weight,
                      struct cells *cells)
{
    const double first = (double)(grid->length / 2) + 0.5;
    cells->at[cells->count][0] = grid->middle[0] + (x - first) * grid->step;
    cells->at[cells->count][1] = t;
    cells->weights[cells->count] = weight;
    cells->cells[cells->count++] = (size_t)x;
}

/* Parts of lines through cells that are not clear as a whole, two points of Gauss each. */
static void put_parts(const struct grid *grid, const double (*parts)[2], size_t count, double t,
                      struct cells *cells)
{
    for (size_t i = 0; i < count; i++) {
        for (size_t x = (size_t)parts[i][0]; (double)x < parts[i][1]; x++) {
            const double low = fmax(parts[i][0], (double)x);
            const double high = fmin(parts[i][1], (double)x + 1);
            for (int k = -1; k <= 1 && cells->clear[x] < whole && high > low; k += 2) {
                put_point(grid, (low + high) / 2 + k * (high - low) / 2 * gauss, t,
                          (high - low) / (2 * ROWS), cells);
            }
        }
    }
}

/* All points of a row of cells: of whole cells two by two, of others line by line. */
static void put_cells(const struct exit_lines *lines, const struct grid *grid, double middle,
                      struct cells *cells)
{
    double parts[ROWS][EXIT_SPANS][2], t[ROWS];
    size_t counts[ROWS];
    cells->count = 0;
    for (size_t x = 0; x < grid->length; x++) {
        cells->clear[x] = 0;
    }
    for (size_t k = 0; k < ROWS; k++) {
        t[k] = middle + (((double)k + 0.5) / ROWS - 0.5) * grid->step;
        counts[k] = parts_of(lines, grid, t[k], parts[k]);
        for (size_t i = 0; i < counts[k]; i++) {
            for (size_t x = (size_t)parts[k][i][0]; (double)x < parts[k][i][1]; x++) {
                const double part =
                    fmin(parts[k][i][1], (double)x + 1) - fmax(parts[k][i][0], (double)x);
                cells->clear[x] += fmax(part, 0) / ROWS;
            }
        }
    }
    for (size_t x = 0; x < grid->length; x++) {
        for (int k = 0; k < 4 && cells->clear[x] >= whole; k++) {
            const double across = k % 2 == 0 ? -gauss : gauss, up = k < 2 ? -gauss : gauss;
            put_point(grid, (double)x + 0.5 + across / 2, middle + up / 2 * grid->step, 0.25,
                      cells);
        }
    }
    for (size_t k = 0; k < ROWS; k++) {
        put_parts(grid, (const double(*)[2])parts[k], counts[k], t[k], cells);
    }
}

/* The means of the amplitude over the cells. */
static void fill_grid(struct psf_plane *plane, const struct grid *grid)
{
    static const double across_x[2] = {1, 0};
    struct arena *arena = plane->arena;
    const size_t length = grid->length, room = length * (4 + 2 * ROWS * EXIT_SPANS);
    struct exit_lines *lines = ARENA_NEW(arena, struct exit_lines);
    struct cells cells = {.at = arena_array(arena, room, sizeof *cells.at),
                          .weights = ARENA_ARRAY(arena, room, double),
                          .cells = ARENA_ARRAY(arena, room, size_t),
                          .clear = ARENA_ARRAY(arena, length, double)};
    double *waves = ARENA_ARRAY(arena, room, double);
    double *amplitudes = ARENA_ARRAY(arena, room, double);
    exit_lines_find(plane->pupil, across_x, arena, lines);
    for (size_t y = 0; y < length; y++) {
        const double t = grid->middle[1] + ((double)y - (double)(length / 2)) * grid->step;
        if (fabs(t - grid->middle[1]) > plane->pupil->half[1] + grid->step) {
            continue;
        }
        put_cells(lines, grid, t, &cells);
        exit_pupil_values(plane->pupil, (const double(*)[2])cells.at, cells.count, waves,
                          amplitudes);
        for (size_t i = 0; i < cells.count; i++) {
            const double amplitude = amplitudes[i] * cells.weights[i] * grid->step * grid->step;
            double c, s;
            turns_of(waves[i], &c, &s);
            grid->re[y * length + cells.cells[i]] += amplitude * c;
            grid->im[y * length + cells.cells[i]] += amplitude * s;
            plane->perfect += amplitude;
        }
    }
}

/* What means over cells leave of a wave at a place, pixels from the middle. */
static double left_by_cells(size_t i, size_t size, size_t length)
{
    const double x = PI * ((double)i - (double)(size / 2)) / (double)length;
    return fabs(x) > 0 ? sin(x) / x : 1;
}

bool psf_by_fft(struct psf_plane *plane, struct error *error)
{
    const struct exit_pupil *pupil = plane->pupil;
    const size_t length = length_for(plane, error), size = plane->size;
    if (length == 0) {
        return false;
    }
    const size_t room = length * length;
    const struct grid grid = {.length = length,
                              .step = 1 / (pupil->n * pupil->waves * (double)length * plane->pitch),
                              .middle = {pupil->middle[0], pupil->middle[1]},
                              .re = ARENA_ARRAY(plane->arena, room, double),
                              .im = ARENA_ARRAY(plane->arena, room, double)};
    for (size_t i = 0; i < room; i++) {
        grid.re[i] = grid.im[i] = 0;
    }
    fill_grid(plane, &grid);
    const struct fft fft = fft_open(length, plane->arena);
    fft_plane(&fft, false, grid.re, grid.im, plane->arena);
    for (size_t i = 0; i < size * size; i++) {
        /* light alone: where the middles lie only turns the phase */
        const size_t x = (i % size + length - size / 2) % length;
        const size_t y = (i / size + length - size / 2) % length;
        const double left =
            left_by_cells(i % size, size, length) * left_by_cells(i / size, size, length);
        plane->re[i] = grid.re[y * length + x] / left;
        plane->im[i] = grid.im[y * length + x] / left;
    }
    return true;
}
