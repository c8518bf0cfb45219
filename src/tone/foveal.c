/* tone/foveal.c - a picture as the eye looks about in it: means over one degree. */
/* SPDX-License-Identifier: MIT */
#include "tone/foveal.h"

#include "base/constants.h"
#include "tone/sight.h"

#include <math.h>

enum { CHANNELS = 3, BALANCINGS = 4 };

static size_t between(double x, size_t least, size_t most)
{
    return x < (double)least ? least : x > (double)most ? most : (size_t)x;
}

struct foveal foveal_look(const struct image *image, double angle, struct arena *arena)
{
    const double width = 2 * tan(angle / 2), pixel = width / (double)image->width;
    struct foveal foveal = {
        .columns = between(width / RADIANS_PER_DEGREE + 0.5, 1, image->width),
        .rows =
            between(pixel * (double)image->height / RADIANS_PER_DEGREE + 0.5, 1, image->height)};
    const size_t columns = foveal.columns, rows = foveal.rows;
    foveal.cell[0] = width / (double)columns;
    foveal.cell[1] = pixel * (double)image->height / (double)rows;
    foveal.light = ARENA_ARRAY(arena, columns * rows * CHANNELS, float);
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

double foveal_luminance(const struct foveal *foveal, size_t cell)
{
    return (double)sight_luminance(foveal->light + CHANNELS * cell);
}

/* -------- glare -------- */

struct direction {
    float x, y, z;
};

static struct direction *directions_of(const struct foveal *foveal, struct arena *arena)
{
    struct direction *directions =
        ARENA_ARRAY(arena, foveal->columns * foveal->rows, struct direction);
    for (size_t i = 0; i < foveal->columns * foveal->rows; i++) {
        const size_t column = i % foveal->columns, row = i / foveal->columns;
        const double x = foveal->cell[0] * ((double)column + 0.5 - 0.5 * (double)foveal->columns);
        const double y = foveal->cell[1] * ((double)row + 0.5 - 0.5 * (double)foveal->rows);
        const double over = 1 / sqrt(x * x + y * y + 1);
        directions[i] = (struct direction){(float)(x * over), (float)(y * over), (float)over};
    }
    return directions;
}

/*
 * cos t/t^2 by the chord c = 2 sin(t/2), which single precision tells near 0 better than the
 * cosine: t^2 = c^2 (1 + c^2/12 + c^4/90 + c^6/560 + c^8/3150), the square of the arcsine's series,
 * within 3e-3 up to a right angle, where the cosine ends.
 */
static float scattering(struct direction a, struct direction b)
{
    const float x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    const float chord2 = x * x + y * y + z * z;
    const float series =
        1 + chord2 *
                (1.0F / 12 + chord2 * (1.0F / 90 + chord2 * (1.0F / 560 + chord2 * (1.0F / 3150))));
    const float cosine = 1 - chord2 / 2;
    return cosine > 0 ? cosine / (chord2 * series) : 0;
}

/* sum_j d_j w_ij L_j of each channel, and in the last place sum_j d_j w_ij. */
static void scatter(const struct foveal *foveal, const struct direction *directions,
                    const float *balance, size_t i, double sums[CHANNELS + 1])
{
    const size_t count = foveal->columns * foveal->rows;
    for (size_t k = 0; k <= CHANNELS; k++) {
        sums[k] = 0;
    }
    for (size_t j = 0; j < count; j++) {
        if (j == i) {
            continue;
        }
        const float weight = balance[j] * scattering(directions[i], directions[j]);
        for (size_t k = 0; k < CHANNELS; k++) {
            sums[k] += (double)(weight * foveal->light[CHANNELS * j + k]);
        }
        sums[CHANNELS] += (double)weight;
    }
}

/* The d of each cell: each time the square root of what is missing. */
static float *balance_of(const struct foveal *foveal, const struct direction *directions,
                         struct arena *arena)
{
    const size_t count = foveal->columns * foveal->rows;
    float *balance = ARENA_ARRAY(arena, count, float), *next = ARENA_ARRAY(arena, count, float);
    for (size_t i = 0; i < count; i++) {
        balance[i] = 1;
    }
    for (int turn = 0; turn < BALANCINGS; turn++) {
        for (size_t i = 0; i < count; i++) {
            double sums[CHANNELS + 1];
            scatter(foveal, directions, balance, i, sums);
            next[i] = sums[CHANNELS] > 0 ? (float)sqrt((double)balance[i] / sums[CHANNELS]) : 0;
        }
        float *spare = balance;
        balance = next;
        next = spare;
    }
    return balance;
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

/* Light of a cell's neighbours at a pixel. */
static void veil_at(const struct foveal *foveal, const float *veil, const struct image *image,
                    size_t pixel, float light[CHANNELS])
{
    const double x = ((double)(pixel % image->width) + 0.5) / (double)image->width;
    const double y = ((double)(pixel / image->width) + 0.5) / (double)image->height;
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
    double taken[CHANNELS] = {0}, given[CHANNELS] = {0};
    for (size_t i = 0; i < image->width * image->height; i++) {
        float light[CHANNELS];
        veil_at(foveal, veil, image, i, light);
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

void foveal_veil(struct foveal *foveal, struct image *image, struct arena *arena)
{
    const size_t count = foveal->columns * foveal->rows;
    if (count < 2) {
        return; /* light that goes nowhere else */
    }
    const struct direction *directions = directions_of(foveal, arena);
    const float *balance = balance_of(foveal, directions, arena);
    float *veil = ARENA_ARRAY(arena, count * CHANNELS, float);
    for (size_t i = 0; i < count; i++) {
        double sums[CHANNELS + 1];
        scatter(foveal, directions, balance, i, sums);
        for (size_t k = 0; k < CHANNELS; k++) {
            veil[CHANNELS * i + k] = (float)(SIGHT_VEIL * (double)balance[i] * sums[k]);
        }
    }
    keep_light(foveal, image, veil);
    for (size_t i = 0; i < image->width * image->height; i++) {
        float light[CHANNELS];
        veil_at(foveal, veil, image, i, light);
        for (size_t k = 0; k < CHANNELS; k++) {
            float *pixel = &image->pixels[CHANNELS * i + k];
            *pixel = (float)(1 - SIGHT_VEIL) * *pixel + light[k];
        }
    }
    for (size_t i = 0; i < count * CHANNELS; i++) {
        foveal->light[i] = (float)(1 - SIGHT_VEIL) * foveal->light[i] + veil[i];
    }
}
