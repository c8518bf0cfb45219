/* tests/unit/test_foveal.c - places of one degree, and glare as the formula has it in long sums. */
/* SPDX-License-Identifier: MIT */
#include "tone/foveal.h"

#include "check.h"
#include "stream.h"
#include "tone/sight.h"

enum { CHANNELS = 3, CELLS_MOST = 64 };

static struct arena arena;
static struct stream stream = {.seed = 3};

static double clamped(double x, double most)
{
    return fmin(fmax(x, 0), most);
}

/* Shares of 1 together, whose mean place is the one asked for, or the nearest on the border. */
static void test_between(void)
{
    const struct foveal foveal = {.columns = 5, .rows = 3};
    for (int i = 0; i < 200; i++) {
        const double x = between(&stream, -0.2, 1.2), y = between(&stream, -0.2, 1.2);
        const struct foveal_between at = foveal_between(&foveal, x, y);
        double column = 0, row = 0, all = 0;
        for (int c = 0; c < 4; c++) {
            const double of[2] = {(double)(at.cells[c] % 5), (double)(at.cells[c] / 5)};
            const double share = (double)at.shares[c];
            CHECK(at.cells[c] < 15 && share >= 0);
            CHECK(share == 0 || (fabs(of[0] - clamped(5 * x - 0.5, 4)) < 1 &&
                                 fabs(of[1] - clamped(3 * y - 0.5, 2)) < 1));
            all += share;
            column += share * of[0];
            row += share * of[1];
        }
        CHECK_NEAR(all, 1, 1e-6, "shares");
        CHECK_NEAR(column, clamped(5 * x - 0.5, 4), 1e-5, "column between cells");
        CHECK_NEAR(row, clamped(3 * y - 0.5, 2), 1e-5, "row between cells");
    }
}

/* -------- glare, as its formula stands -------- */

struct plane {
    size_t columns, rows;
    double light[CELLS_MOST][CHANNELS]; /* of cells */
    double veil[CELLS_MOST][CHANNELS];
};

/*
 * cos t/t^2 of all pairs, and their balance: d such that each sum of d_i d_j cos t/t^2 is 1, as
 * near as four turns come, which leave 0.0012 of light of 1.
 */
static void scatter(struct plane *plane, double width, double height)
{
    const size_t count = plane->columns * plane->rows;
    double at[CELLS_MOST][3], w[CELLS_MOST][CELLS_MOST], d[CELLS_MOST], next[CELLS_MOST];
    for (size_t i = 0; i < count; i++) {
        const double x =
            width * (((double)(i % plane->columns) + 0.5) / (double)plane->columns - 0.5);
        const double y =
            height * (((double)(i / plane->columns) + 0.5) / (double)plane->rows - 0.5);
        const double length = sqrt(x * x + y * y + 1);
        at[i][0] = x / length;
        at[i][1] = y / length;
        at[i][2] = 1 / length;
        d[i] = 1;
    }
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < count; j++) {
            const double cosine = at[i][0] * at[j][0] + at[i][1] * at[j][1] + at[i][2] * at[j][2];
            const double t = acos(fmin(cosine, 1));
            w[i][j] = i != j && cosine > 0 ? cosine / (t * t) : 0;
        }
    }
    for (int turn = 0; turn < 4; turn++) {
        for (size_t i = 0; i < count; i++) {
            double sum = 0;
            for (size_t j = 0; j < count; j++) {
                sum += w[i][j] * d[j];
            }
            next[i] = sqrt(d[i] / sum);
        }
        memcpy(d, next, sizeof d);
    }
    memset(plane->veil, 0, sizeof plane->veil);
    for (size_t i = 0; i < count; i++) {
        for (size_t j = 0; j < count * CHANNELS; j++) {
            const size_t from = j / CHANNELS, k = j % CHANNELS;
            plane->veil[i][k] += SIGHT_VEIL * d[i] * d[from] * w[i][from] * plane->light[from][k];
        }
    }
}

/* In straight lines between the middles of cells. */
static double veil_at(const struct plane *plane, double x, double y, size_t k)
{
    const double column = clamped(x * (double)plane->columns - 0.5, (double)plane->columns - 1);
    const double row = clamped(y * (double)plane->rows - 0.5, (double)plane->rows - 1);
    double sum = 0;
    for (size_t i = 0; i < plane->columns * plane->rows; i++) {
        const double u = 1 - fabs(column - (double)(i % plane->columns));
        const double v = 1 - fabs(row - (double)(i / plane->columns));
        sum += fmax(u, 0) * fmax(v, 0) * plane->veil[i][k];
    }
    return sum;
}

/* Cells as large as pixels, and of two by two pixels, near the axis and at more than 90 degrees. */
static void test_veil(void)
{
    static const struct {
        size_t width, height, columns, rows;
        double plane, tolerance; /* the width at distance 1; of light up to 1 */
    } cases[] = {
        {6, 4, 6, 4, 1.2, 1e-5},   {5, 7, 5, 7, 0.3, 1e-5},           {6, 4, 6, 4, 6, 1e-3},
        {2, 1, 2, 1, 0.2, 1e-6},   {12, 8, 6, 4, 6 * PI / 180, 1e-5}, {1, 3, 1, 3, 0.3, 1e-5},
        {16, 6, 8, 3, 0.14, 1e-5},
    };
    for (size_t n = 0; n < sizeof cases / sizeof cases[0]; n++) {
        struct error error;
        struct plane plane = {.columns = cases[n].columns, .rows = cases[n].rows};
        struct image image = {
            .width = cases[n].width, .height = cases[n].height, .channels = CHANNELS};
        const size_t pixels = image.width * image.height, cells = plane.columns * plane.rows;
        const size_t wide = image.width / plane.columns, high = image.height / plane.rows;
        double before[CHANNELS * 2 * CELLS_MOST];
        CHECK(image_new(&image, &arena, &error));
        for (size_t i = 0; i < pixels * CHANNELS; i++) {
            const size_t x = i / CHANNELS % image.width, y = i / CHANNELS / image.width;
            const double light = between(&stream, 0, 1);
            image.pixels[i] = (float)light;
            before[i] = light;
            plane.light[y / high * plane.columns + x / wide][i % CHANNELS] +=
                light / (double)(wide * high);
        }
        struct foveal foveal = foveal_look(&image, 2 * atan(cases[n].plane / 2), &arena);
        CHECK(foveal.columns == plane.columns && foveal.rows == plane.rows);
        CHECK_RELATIVE(foveal.cell[0], cases[n].plane / (double)plane.columns, 1e-12, "a cell");
        for (size_t i = 0; i < cells * CHANNELS; i++) {
            CHECK_NEAR((double)foveal.light[i], plane.light[i / CHANNELS][i % CHANNELS], 1e-6,
                       "the mean of a cell");
        }
        const struct foveal_grid grid = foveal_veil(&foveal, &image, &arena);
        CHECK(grid.columns == plane.columns && grid.rows == plane.rows);
        scatter(&plane, cases[n].plane,
                cases[n].plane * (double)image.height / (double)image.width);
        /* what is between the cells, by as much as makes the light of all what was taken */
        double taken[CHANNELS] = {0}, given[CHANNELS] = {0};
        for (size_t i = 0; i < pixels * CHANNELS; i++) {
            const size_t k = i % CHANNELS, pixel = i / CHANNELS;
            taken[k] += SIGHT_VEIL * before[i];
            given[k] += veil_at(&plane, ((double)(pixel % image.width) + 0.5) / (double)image.width,
                                ((double)(pixel / image.width) + 0.5) / (double)image.height, k);
        }
        for (size_t i = 0; i < pixels * CHANNELS; i++) {
            const size_t k = i % CHANNELS, pixel = i / CHANNELS;
            const double x = ((double)(pixel % image.width) + 0.5) / (double)image.width;
            const double y = ((double)(pixel / image.width) + 0.5) / (double)image.height;
            CHECK_NEAR((double)image.pixels[i],
                       (1 - SIGHT_VEIL) * before[i] +
                           veil_at(&plane, x, y, k) * taken[k] / given[k],
                       cases[n].tolerance, "a pixel with its veil");
        }
        for (size_t i = 0; i < cells * CHANNELS; i++) {
            const size_t k = i % CHANNELS;
            CHECK_NEAR((double)foveal.light[i],
                       (1 - SIGHT_VEIL) * plane.light[i / CHANNELS][k] +
                           plane.veil[i / CHANNELS][k] * taken[k] / given[k],
                       cases[n].tolerance, "a cell with its veil");
        }
    }
}

/* One place alone: its light goes nowhere else. */
static void test_alone(void)
{
    float pixels[CHANNELS] = {1, 2, 3};
    struct image image = {.width = 1, .height = 1, .channels = CHANNELS, .pixels = pixels};
    struct foveal foveal = foveal_look(&image, 0.5, &arena);
    const struct foveal_grid grid = foveal_veil(&foveal, &image, &arena);
    CHECK(grid.columns == 1 && grid.rows == 1);
    CHECK(pixels[0] == 1 && pixels[1] == 2 && pixels[2] == 3);
    CHECK_RELATIVE(foveal_luminance(&foveal, 0), 0.2126 * 1 + 0.7152 * 2 + 0.0722 * 3, 1e-6,
                   "luminance of sRGB");
}

/* A degree across, to the nearest whole number of cells, none smaller than a pixel. */
static void test_look(void)
{
    static const struct {
        double degrees; /* the width at distance 1, over that of a degree */
        size_t columns;
    } cases[] = {{0.3, 1}, {1.4, 1}, {1.6, 2}, {7.45, 7}, {7.55, 8}, {39.7, 40}, {90, 40}};
    struct error error;
    struct image image = {.width = 40, .height = 40, .channels = CHANNELS};
    CHECK(image_new(&image, &arena, &error));
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double width = cases[i].degrees * PI / 180;
        const struct foveal foveal = foveal_look(&image, 2 * atan(width / 2), &arena);
        CHECK(foveal.columns == cases[i].columns && foveal.rows == cases[i].columns);
    }
}

int main(void)
{
    test_between();
    test_look();
    test_veil();
    test_alone();
    arena_free(&arena);
    return check_report();
}
