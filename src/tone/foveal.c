/* tone/foveal.c - a picture as the eye looks about in it: means over one degree. */
/* SPDX-License-Identifier: MIT */
#include "tone/foveal.h"

#include "base/constants.h"
#include "tone/sight.h"

#include <math.h>

enum { CHANNELS = 3, BALANCINGS = 4 };

static size_t clamped_between(double x, size_t least, size_t most)
{
    if (x < (double)least) {
        return least;
    }
    if (x > (double)most) {
        return most;
    }
    return (size_t)x;
}

/* Means over so many cells of a picture that lies so wide on the plane. */
static struct foveal foveal_sample(const struct image *image, double width, size_t columns,
                                   size_t rows, struct arena *arena)
{
    const double high = width / image_proportion(image);
    struct foveal foveal = {.columns = columns,
                            .rows = rows,
                            .light = ARENA_ARRAY(arena, columns * rows * CHANNELS, float),
                            .cell = {width / (double)columns, high / (double)rows}};
    for (size_t r = 0; r < rows; r++) {
        const size_t top = r * image->height / rows, bottom = (r + 1) * image->height / rows;
        double *sums = ARENA_ARRAY(arena, columns * CHANNELS, double);
        for (size_t y = top; y < bottom; y++) {
            const float *row = image_row(image, y);
            for (size_t c = 0; c < columns; c++) {
                const size_t end = (c + 1) * image->width / columns * CHANNELS;
                double sum[CHANNELS] = {0};
                for (size_t i = c * image->width / columns * CHANNELS; i < end; i += CHANNELS) {
                    for (size_t k = 0; k < CHANNELS; k++) {
                        sum[k] += (double)row[i + k];
                    }
                }
                for (size_t k = 0; k < CHANNELS; k++) {
                    sums[c * CHANNELS + k] += sum[k];
                }
            }
        }
        for (size_t i = 0; i < columns * CHANNELS; i++) {
            const size_t c = i / CHANNELS;
            const size_t across = (c + 1) * image->width / columns - c * image->width / columns;
            foveal.light[r * columns * CHANNELS + i] =
                (float)(sums[i] / (double)(across * (bottom - top)));
        }
    }
    return foveal;
}

struct foveal foveal_look(const struct image *image, double angle, struct arena *arena)
{
    const double width = 2 * tan(angle / 2), high = width / image_proportion(image);
    return foveal_sample(image, width,
                         clamped_between(width / RADIANS_PER_DEGREE + 0.5, 1, image->width),
                         clamped_between(high / RADIANS_PER_DEGREE + 0.5, 1, image->height), arena);
}

double foveal_luminance(const struct foveal *foveal, size_t cell)
{
    return (double)sight_luminance(foveal->light + CHANNELS * cell);
}

/* -------- glare -------- */

/* Cells side by side, as many as make whole stretches: those that are none have no light. */
enum { STRETCH = 64 };
struct foveal_cells {
    size_t count, room;
    float *x, *y, *z; /* their directions */
    float *light[CHANNELS];
    float *balance; /* the d of each */
};

/*
 * d cos t/t^2 of a stretch of cells, seen from cell i: by the chord c = 2 sin(t/2), which single
 * precision tells near 0 better than the cosine: t^2 = c^2 (1 + c^2/12 + c^4/90 + c^6/560 +
 * c^8/3150), the square of the arcsine's series, within 3e-3 up to a right angle, where the cosine
 * ends. Itself has no weight.
 */
static void foveal_weigh(const struct foveal_cells *cells, size_t i, size_t from,
                         float weights[STRETCH])
{
    const float *xs = cells->x + from, *ys = cells->y + from, *zs = cells->z + from;
    const float *balance = cells->balance + from;
    for (int j = 0; j < STRETCH; j++) {
        const float x = xs[j] - cells->x[i], y = ys[j] - cells->y[i], z = zs[j] - cells->z[i];
        const float chord2 = x * x + y * y + z * z;
        const float series =
            1 + chord2 * (1.0F / 12 +
                          chord2 * (1.0F / 90 + chord2 * (1.0F / 560 + chord2 * (1.0F / 3150))));
        const float cosine = 1 - chord2 / 2, square = chord2 * series;
        const float seen = cosine > 0 ? cosine : 0;
        weights[j] = chord2 > 0 ? balance[j] * seen / square : 0;
    }
}

static double foveal_sum_of(const float values[STRETCH])
{
    double sum = 0;
    for (int j = 0; j < STRETCH; j++) {
        sum += (double)values[j];
    }
    return sum;
}

/* sum_j d_j w_ij L_j of each channel. */
static void foveal_scatter(const struct foveal_cells *cells, size_t i, double light[CHANNELS])
{
    float weights[STRETCH], sums[CHANNELS][STRETCH] = {{0}};
    for (size_t from = 0; from < cells->room; from += STRETCH) {
        foveal_weigh(cells, i, from, weights);
        for (size_t k = 0; k < CHANNELS; k++) {
            const float *lights = cells->light[k] + from;
            float *sum = sums[k];
            for (int j = 0; j < STRETCH; j++) {
                sum[j] += weights[j] * lights[j];
            }
        }
    }
    for (size_t k = 0; k < CHANNELS; k++) {
        light[k] = foveal_sum_of(sums[k]);
    }
}

/* The d of each cell: each time the square root of what is missing. */
static void balance(struct foveal_cells *cells, struct arena *arena)
{
    float *next = ARENA_ARRAY(arena, cells->room, float);
    for (int turn = 0; turn < BALANCINGS; turn++) {
        for (size_t i = 0; i < cells->count; i++) {
            /* sum_j d_j w_ij of each cell */
            float weights[STRETCH], sums[STRETCH] = {0};
            for (size_t from = 0; from < cells->room; from += STRETCH) {
                foveal_weigh(cells, i, from, weights);
                for (int j = 0; j < STRETCH; j++) {
                    sums[j] += weights[j];
                }
            }
            const double sum = foveal_sum_of(sums);
            next[i] = sum > 0 ? (float)sqrt((double)cells->balance[i] / sum) : 0;
        }
        float *spare = cells->balance;
        cells->balance = next;
        next = spare;
    }
}

struct foveal_between foveal_between(const struct foveal *foveal, double x, double y)
{
    const double last[2] = {(double)foveal->columns - 1, (double)foveal->rows - 1};
    const double column = fmin(fmax(x * (double)foveal->columns - 0.5, 0), last[0]);
    const double row = fmin(fmax(y * (double)foveal->rows - 0.5, 0), last[1]);
    const size_t left = (size_t)column, above = (size_t)row;
    const size_t right = left + (left + 1 < foveal->columns ? 1 : 0);
    const size_t below = above + (above + 1 < foveal->rows ? 1 : 0);
    const float u = (float)(column - (double)left), v = (float)(row - (double)above);
    const size_t n = foveal->columns;
    return (struct foveal_between){
        {above * n + left, above * n + right, below * n + left, below * n + right},
        {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v}};
}

/* Light of a cell's neighbours at a pixel, one of so many across and down. */
static void veil_at(const struct foveal *foveal, const float *veil, const size_t size[2],
                    size_t pixel, float light[CHANNELS])
{
    const double x = ((double)(pixel % size[0]) + 0.5) / (double)size[0];
    const double y = ((double)(pixel / size[0]) + 0.5) / (double)size[1];
    const struct foveal_between at = foveal_between(foveal, x, y);
    for (size_t k = 0; k < CHANNELS; k++) {
        light[k] = 0;
        for (int c = 0; c < 4; c++) {
            light[k] += at.shares[c] * veil[CHANNELS * at.cells[c] + k];
        }
    }
}

/* So much of the veil that it has all that was taken away, in each channel. */
static void keep_light(const struct foveal *foveal, const struct image *image, float *veil)
{
    const size_t size[] = {image->width, image->height};
    double taken[CHANNELS] = {0}, given[CHANNELS] = {0};
    for (size_t i = 0; i < image->width * image->height; i++) {
        float light[CHANNELS];
        veil_at(foveal, veil, size, i, light);
        for (size_t k = 0; k < CHANNELS; k++) {
            taken[k] += SIGHT_VEIL * (double)image->pixels[CHANNELS * i + k];
            given[k] += (double)light[k];
        }
    }
    for (size_t i = 0; i < foveal->columns * foveal->rows * CHANNELS; i++) {
        const size_t k = i % CHANNELS;
        veil[i] = given[k] > 0 ? (float)((double)veil[i] * taken[k] / given[k]) : 0;
    }
}

/* The cells, or larger ones: their number counts twice over, as givers and as takers of light. */
static struct foveal cells_for_veil(const struct foveal *foveal, const struct image *image,
                                    struct arena *arena)
{
    const double count = (double)(foveal->columns * foveal->rows);
    if (count <= FOVEAL_VEIL_MOST) {
        return *foveal;
    }
    const double over = sqrt(FOVEAL_VEIL_MOST / count);
    const size_t columns = clamped_between((double)foveal->columns * over, 1, FOVEAL_VEIL_MOST);
    const size_t rows =
        clamped_between((double)foveal->rows * over, 1, (size_t)FOVEAL_VEIL_MOST / columns);
    return foveal_sample(image, foveal->cell[0] * (double)foveal->columns, columns, rows, arena);
}

struct foveal_grid foveal_veil(struct foveal *foveal, struct image *image, struct arena *arena)
{
    const struct foveal coarse = cells_for_veil(foveal, image, arena);
    const struct foveal_grid grid = {coarse.columns, coarse.rows};
    const size_t size[] = {image->width, image->height};
    const size_t places[] = {foveal->columns, foveal->rows}, count = grid.columns * grid.rows;
    if (count < 2) {
        return grid; /* light that goes nowhere else */
    }
    /* where the cells are seen, and their light */
    struct foveal_cells cells = {.count = coarse.columns * coarse.rows};
    cells.room = (cells.count + STRETCH - 1) / STRETCH * STRETCH;
    float **all[] = {&cells.x,        &cells.y,        &cells.z,      &cells.light[0],
                     &cells.light[1], &cells.light[2], &cells.balance};
    for (size_t k = 0; k < sizeof all / sizeof all[0]; k++) {
        *all[k] = ARENA_ARRAY(arena, cells.room, float);
    }
    for (size_t i = 0; i < cells.count; i++) {
        const size_t column = i % coarse.columns, row = i / coarse.columns;
        const double x = coarse.cell[0] * ((double)column + 0.5 - 0.5 * (double)coarse.columns);
        const double y = coarse.cell[1] * ((double)row + 0.5 - 0.5 * (double)coarse.rows);
        const double over = 1 / sqrt(x * x + y * y + 1);
        cells.x[i] = (float)(x * over);
        cells.y[i] = (float)(y * over);
        cells.z[i] = (float)over;
        cells.balance[i] = 1;
        for (size_t k = 0; k < CHANNELS; k++) {
            cells.light[k][i] = coarse.light[CHANNELS * i + k];
        }
    }
    balance(&cells, arena);
    float *veil = ARENA_ARRAY(arena, count * CHANNELS, float);
    for (size_t i = 0; i < count; i++) {
        double light[CHANNELS];
        foveal_scatter(&cells, i, light);
        for (size_t k = 0; k < CHANNELS; k++) {
            veil[CHANNELS * i + k] = (float)(SIGHT_VEIL * (double)cells.balance[i] * light[k]);
        }
    }
    keep_light(&coarse, image, veil);
    for (size_t i = 0; i < image->width * image->height; i++) {
        float light[CHANNELS];
        veil_at(&coarse, veil, size, i, light);
        for (size_t k = 0; k < CHANNELS; k++) {
            float *pixel = &image->pixels[CHANNELS * i + k];
            *pixel = (float)(1 - SIGHT_VEIL) * *pixel + light[k];
        }
    }
    for (size_t i = 0; i < foveal->columns * foveal->rows; i++) {
        float light[CHANNELS];
        veil_at(&coarse, veil, places, i, light);
        for (size_t k = 0; k < CHANNELS; k++) {
            float *cell = &foveal->light[CHANNELS * i + k];
            *cell = (float)(1 - SIGHT_VEIL) * *cell + light[k];
        }
    }
    return grid;
}
