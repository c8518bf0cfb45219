/* tests/unit/test_tile_rays.c - the order of a tile's pixels, and their points. */
/* SPDX-License-Identifier: MIT */
#include "camera/tile_rays.h"
#include "check.h"

/* Aligned runs of 2^m places fill a rectangle of so many pixels. */
static void check_run(const unsigned char cells[RAYS_BLOCK], size_t from, size_t count)
{
    size_t left = TILE_ACROSS, right = 0, top = TILE_DOWN, bottom = 0;
    for (size_t i = from; i < from + count; i++) {
        const size_t column = cells[i] % TILE_ACROSS, row = cells[i] / TILE_ACROSS;
        left = column < left ? column : left;
        right = column > right ? column : right;
        top = row < top ? row : top;
        bottom = row > bottom ? row : bottom;
    }
    CHECK((right - left + 1) * (bottom - top + 1) == count);
}

/* Every pixel has one place; squares of 2, 4 and 8 pixels have places that follow each other. */
static void test_order(void)
{
    enum { TILES = 200 };
    static unsigned char corner[TILES];
    const struct tile_rays tile = {.in_strands = true, .seed = 5};
    struct arena arena = {0};
    struct tile_room *room = tile_room_new(1, &arena);
    struct film_plan plan = {0};
    size_t often[TILE_PIXELS] = {0}, most = 0;
    for (size_t number = 0; number < TILES; number++) {
        unsigned char seen[TILE_PIXELS] = {0};
        tile_rays_begin(&tile, number, &plan, room);
        for (size_t i = 0; i < TILE_PIXELS; i++) {
            CHECK(room->cells[i] < TILE_PIXELS && !seen[room->cells[i]]);
            seen[room->cells[i]] = 1;
        }
        for (size_t count = 4; count <= TILE_PIXELS / 2; count *= 4) {
            for (size_t from = 0; from < TILE_PIXELS; from += count) {
                check_run(room->cells, from, count);
            }
        }
        corner[number] = room->cells[0];
        most = ++often[corner[number]] > most ? often[corner[number]] : most;
    }
    /* tiles are ordered each by itself: which pixel is first is left to chance */
    CHECK(most < 10);
    tile_rays_begin(&tile, 7, &plan, room);
    CHECK(room->cells[0] == corner[7]);
    arena_free(&arena);
}

/* The least number of bits that counts the samples. */
static void test_bits(void)
{
    CHECK(tile_rays_bits(1) == 0 && tile_rays_bits(2) == 1 && tile_rays_bits(3) == 2);
    CHECK(tile_rays_bits(64) == 6 && tile_rays_bits(65) == 7);
    CHECK(tile_rays_bits((size_t)1 << 25) == 25 && tile_rays_bits((size_t)1 << 26) == 25);
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
        film_rays_cells(&plan, cells, block, SET_BEST, &samples);
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
    test_order();
    test_bits();
    return check_report();
}
