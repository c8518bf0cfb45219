/* tests/unit/test_tile_rays.c - points of a tile's pixels, and of their rays' paths. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tile_rays.h"
#include "check.h"

#include <string.h>

/* Numbers of paths: behind x, y, u, v and time, in the least strands that count the samples. */
static void test_sampler(void)
{
    static const struct {
        size_t samples;
        uint32_t bits;
    } cases[] = {{1, 0}, {2, 1}, {3, 2}, {64, 6}, {65, 7}, {1 << 25, 25}, {1 << 26, 25}};
    struct arena arena = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct sampler_table *table = tile_rays_points(cases[i].samples, &arena);
        struct sobol expected;
        sobol_open_strands(5, cases[i].bits, &expected);
        CHECK(table->first == 5 && memcmp(&table->sobol[0], &expected, sizeof expected) == 0);
    }
    arena_free(&arena);
}

/*
 * Cell i lies i % 16 cells from the largest x and i / 16 above the least y; 16 points of a cell lie
 * one in each sixteenth of its width, of its height and of the pupil's two numbers.
 */
static void test_cells(void)
{
    enum { BITS = 4, COUNT = 1 << BITS };
    unsigned char cells[RAYS_BLOCK];
    static unsigned char seen[FILM_DIMENSIONS][RAYS_BLOCK][COUNT];
    struct sobol sobol[FILM_DIMENSIONS];
    const struct film_plan plan = {.sobol = sobol,
                                   .left = -7,
                                   .bottom = 2,
                                   .width = 32,
                                   .height = 4,
                                   .scrambling = {1, 2, 3, 4}};
    for (size_t i = 0; i < RAYS_BLOCK; i++) {
        cells[i] = (unsigned char)(45 * i % RAYS_BLOCK);
    }
    for (uint32_t k = 0; k < FILM_DIMENSIONS; k++) {
        sobol_open_strands(k, BITS, &sobol[k]);
    }
    for (uint32_t block = 0; block < COUNT; block++) {
        struct film_samples samples;
        film_rays_plan(&plan, cells, block, SET_BEST, &samples);
        for (size_t i = 0; i < RAYS_BLOCK; i++) {
            const int cell = cells[i];
            const double at[FILM_DIMENSIONS] = {(25 - samples.x[i]) / 2 - cell % 16,
                                                (samples.y[i] - 2) * 2 - cell / 16, samples.u[i],
                                                samples.v[i]};
            for (int k = 0; k < FILM_DIMENSIONS; k++) {
                CHECK(at[k] > 0 && at[k] < 1);
                seen[k][i][(size_t)(at[k] * COUNT) % COUNT]++;
            }
        }
    }
    for (int k = 0; k < FILM_DIMENSIONS; k++) {
        for (size_t i = 0; i < (size_t)RAYS_BLOCK * COUNT; i++) {
            CHECK(seen[k][i / COUNT][i % COUNT] == 1);
        }
    }
}

int main(void)
{
    test_cells();
    test_sampler();
    return check_report();
}
