/* analysis/image/psf_transform.c - the light of one wavelength by a fast Fourier transform. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/psf_light.h"
#include "analysis/waves/exit_lines.h"

#include "base/constants.h"
#include "base/fft.h"
#include "base/turns.h"
#include "trace/aim/sample.h"

#include <math.h>

enum {
    CELLS = 128, /* across the pupil */
    ROWS = 8,    /* lines through a cell, which say what of it is clear */
};

/* A cell that is all clear but for rounding; Gauss's two points, from the middle to an end. */
static const double whole = 1 - 1e-9, gauss = 0.57735026918962576451;

/* Polynomials of the pupil serve that are off so little: waves, and of the amplitude. */
static const double smooth = 3e-6;

/* So much of a turn neighbouring points of a grid may differ at most. */
static const double steepest = 0.2;

/* A grid of the pupil: cell i of a row about (i - length/2) step. */
struct psf_transform_grid {
    size_t length;
    double step, middle[2];
    double *re, *im;
};

/* What to do where the wave front is too steep for the longest transform. */
static bool fail_steep(const struct psf_plane *plane, double finest, struct error *error)
{
    const double wanted = 1.001 * plane->spread / (steepest * PSF_TRANSFORM_MOST);
    const bool sums = psf_points_fit(plane, error);
    if (!sums && !(wanted < finest)) {
        return false;
    }
    const char *other = sums ? "plane waves" : "a smaller aperture";
    error->code = ERROR_NONE;
    return wanted < finest
               ? fail(error, ERROR_DOMAIN,
                      "the wave front is too steep for a Fourier transform of %d points at {pitch} "
                      "%.4g %s: at least %.4g, or %s",
                      PSF_TRANSFORM_MOST, 1000 * plane->pitch, plane->unit, 1000 * wanted, other)
               : fail(error, ERROR_DOMAIN,
                      "the wave front is too steep for a Fourier transform of %d points: %s",
                      PSF_TRANSFORM_MOST, other);
}

/* How long the transform is to be; 0 with the error: no length is enough. */
static size_t length_for(const struct psf_plane *plane, struct error *error)
{
    const struct exit_pupil *pupil = plane->pupil;
    const double wide = 2 * fmax(pupil->half[0], pupil->half[1]);
    const double finest = 1 / (pupil->n * pupil->waves * wide); /* mm: the pupil fills the grid */
    const double by_slope = plane->spread / (steepest * plane->pitch);
    const double by_cells = CELLS * finest / plane->pitch;
    if (!(plane->pitch < finest)) {
        fail(error, ERROR_DOMAIN,
             "{pitch} %.4g %s is too coarse for a Fourier transform: below %.4g, or {method} plane",
             1000 * plane->pitch, plane->unit, 1000 * finest);
        return 0;
    }
    if (!(by_slope <= PSF_TRANSFORM_MOST)) {
        fail_steep(plane, finest, error);
        return 0;
    }
    /* light comes back from beyond the grid, the less the farther from where rays are that lies */
    const double filled = fmin(2 * plane->spread / ((double)plane->size * plane->pitch), 1);
    const double by_size = (2 + 5 * filled) * (double)plane->size;
    const double wanted = fmin(fmax(fmax(by_slope, by_cells), by_size), PSF_TRANSFORM_MOST);
    return fft_length_from((size_t)ceil(wanted));
}

/* Points of a row of cells, and what they count, in cells. */
struct psf_transform_cells {
    double (*at)[2];
    double *weights;
    size_t *cells, count, whole; /* so many of the points are of whole cells, four each */
    double *clear;               /* of each cell of the row */
};

/* A line through a row of cells: its share of them, and its clear parts in cells from the first. */
struct cut {
    double t, share;
    size_t count;
    double parts[EXIT_SPANS][2];
};

static double angle_of(const struct exit_piece *piece, double t)
{
    const double place = (2 * t - piece->low - piece->high) / (piece->high - piece->low);
    return asin(fmax(-1, fmin(place, 1)));
}

/* Gauss's lines through a row, between the ends of the pieces that it meets. */
static size_t cut_row(const struct exit_lines *lines, const struct psf_transform_grid *grid,
                      double middle, struct cut *cuts)
{
    const double first = (double)(grid->length / 2) + 0.5;
    double x[ROWS], w[ROWS], slope;
    size_t count = 0;
    gauss_rule(ROWS, x, w);
    for (size_t p = 0; p < lines->count; p++) {
        const struct exit_piece *piece = &lines->pieces[p];
        const double low = angle_of(piece, middle - grid->step / 2);
        const double high = angle_of(piece, middle + grid->step / 2);
        for (size_t k = 0; k < ROWS && high > low; k++, count++) {
            struct exit_spans spans;
            cuts[count].t = exit_piece_at(piece, low + (high - low) * x[k], &slope, &spans);
            cuts[count].share = slope * (high - low) * w[k] / grid->step;
            cuts[count].count = spans.count;
            for (size_t i = 0; i < 2 * spans.count; i++) {
                const double at = (spans.edges[i] - grid->middle[0]) / grid->step + first;
                cuts[count].parts[i / 2][i % 2] = fmax(0, fmin(at, (double)grid->length));
            }
        }
    }
    return count;
}

static void psf_transform_put_point(const struct psf_transform_grid *grid, double x, double t,
                                    double weight, struct psf_transform_cells *cells)
{
    const double first = (double)(grid->length / 2) + 0.5;
    cells->at[cells->count][0] = grid->middle[0] + (x - first) * grid->step;
    cells->at[cells->count][1] = t;
    cells->weights[cells->count] = weight;
    cells->cells[cells->count++] = (size_t)x;
}

/* All points of a row of cells: of whole cells two by two, of others line by line. */
static void put_cells(const struct exit_lines *lines, const struct psf_transform_grid *grid,
                      double middle, struct psf_transform_cells *cells)
{
    struct cut cuts[EXIT_PIECES * ROWS];
    const size_t count = cut_row(lines, grid, middle, cuts);
    /* How much of each cell of a row is clear. */
    for (size_t x = 0; x < grid->length; x++) {
        cells->clear[x] = 0;
    }
    for (const struct cut *cut = cuts; cut < cuts + count; cut++) {
        for (size_t i = 0; i < cut->count; i++) {
            const double *part = cut->parts[i];
            for (size_t x = (size_t)part[0]; (double)x < part[1]; x++) {
                const double length = fmin(part[1], (double)x + 1) - fmax(part[0], (double)x);
                cells->clear[x] += fmax(length, 0) * cut->share;
            }
        }
    }
    cells->count = 0;
    for (size_t x = 0; x < grid->length; x++) {
        for (int k = 0; k < 4 && cells->clear[x] >= whole; k++) {
            const double across = k % 2 == 0 ? -gauss : gauss, up = k < 2 ? -gauss : gauss;
            psf_transform_put_point(grid, (double)x + 0.5 + across / 2,
                                    middle + up / 2 * grid->step, 0.25, cells);
        }
    }
    cells->whole = cells->count;
    for (size_t k = 0; k < count; k++) {
        /* Parts of a line through cells that are not clear as a whole, two points of Gauss each. */
        for (size_t i = 0; i < cuts[k].count; i++) {
            for (size_t j = (size_t)cuts[k].parts[i][0]; (double)j < cuts[k].parts[i][1]; j++) {
                const double low = fmax(cuts[k].parts[i][0], (double)j);
                const double high = fmin(cuts[k].parts[i][1], (double)j + 1);
                for (int m = -1; m <= 1 && cells->clear[j] < whole && high > low; m += 2) {
                    psf_transform_put_point(grid, (low + high) / 2 + m * (high - low) / 2 * gauss,
                                            cuts[k].t, (high - low) / 2 * cuts[k].share, cells);
                }
            }
        }
    }
}

/*
 * What the mean of a wave that turns evenly is more than that of Gauss's two points: sin x/x over
 * cos(x/sqrt 3), x from the middle to an end.
 */
static double more_than(double low, double high)
{
    const double x = 2 * PI * (high - low) / (2 * gauss), x2 = x * x;
    return 1 + x2 * x2 / 270 * (1 + x2 * 8 / 63);
}

/* The means of the amplitude over the cells. */
static void fill_grid(struct psf_plane *plane, const struct psf_transform_grid *grid)
{
    static const double across_x[2] = {1, 0};
    struct arena *arena = plane->arena;
    struct exit_lines *lines = ARENA_NEW(arena, struct exit_lines);
    exit_lines_find(plane->pupil, across_x, arena, lines);
    const size_t length = grid->length, cuts = lines->count * ROWS;
    const size_t room = 4 * length + 2 * cuts * (length + 2 * EXIT_SPANS);
    struct psf_transform_cells cells = {.at = arena_array(arena, room, sizeof *cells.at),
                                        .weights = ARENA_ARRAY(arena, room, double),
                                        .cells = ARENA_ARRAY(arena, room, size_t),
                                        .clear = ARENA_ARRAY(arena, length, double)};
    double *waves = ARENA_ARRAY(arena, room, double);
    double *amplitudes = ARENA_ARRAY(arena, room, double);
    const struct exit_pupil *pupil = plane->pupil;
    const bool is_smooth = pupil->off_waves <= smooth && pupil->off_amplitude <= smooth;
    exit_pupil_ask *find = is_smooth ? exit_pupil_form : exit_pupil_values;
    for (size_t y = 0; y < length; y++) {
        const double t = grid->middle[1] + ((double)y - (double)(length / 2)) * grid->step;
        if (fabs(t - grid->middle[1]) > plane->pupil->half[1] + grid->step) {
            continue;
        }
        put_cells(lines, grid, t, &cells);
        find(plane->pupil, (const double(*)[2])cells.at, cells.count, waves, amplitudes);
        for (size_t i = 0; i < cells.count; i++) {
            const double amplitude = amplitudes[i] * cells.weights[i] * grid->step * grid->step;
            /* That of a point: they lie two by two along x, and those of whole cells along y. */
            const double along = more_than(waves[i - i % 2], waves[i - i % 2 + 1]);
            const size_t below = i - i % 4 + i % 2;
            const double corrected =
                amplitude *
                (i < cells.whole ? along * more_than(waves[below], waves[below + 2]) : along);
            double c, s;
            turns_of(waves[i], &c, &s);
            grid->re[y * length + cells.cells[i]] += corrected * c;
            grid->im[y * length + cells.cells[i]] += corrected * s;
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
    const struct psf_transform_grid grid = {
        .length = length,
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
