/* tests/unit/test_tile_order.c - the order of a tile's pixels. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tiling.h"
#include "check.h"

#include <math.h>
#include <string.h>

/* Aligned runs of 2^m places fill a rectangle of so many pixels. */
static void check_run(const unsigned char cells[TILE_PIXELS], size_t from, size_t count)
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
static void test_squares(void)
{
    enum { TILES = 200 };
    for (size_t number = 0; number < TILES; number++) {
        unsigned char cells[TILE_PIXELS], seen[TILE_PIXELS] = {0};
        tile_order(5, number, cells);
        for (size_t i = 0; i < TILE_PIXELS; i++) {
            CHECK(cells[i] < TILE_PIXELS && !seen[cells[i]]);
            seen[cells[i]] = 1;
        }
        for (size_t count = 4; count <= TILE_PIXELS / 2; count *= 4) {
            for (size_t from = 0; from < TILE_PIXELS; from += count) {
                check_run(cells, from, count);
            }
        }
    }
}

/* Which quarter of its aligned square of so many pixels a pixel is in. */
static int quarter_of(unsigned char cell, int side)
{
    const int column = cell % TILE_ACROSS % side, row = cell / TILE_ACROSS % side;
    return row / (side / 2) * 2 + column / (side / 2);
}

/*
 * By chance: each half is first in half of the tiles, each pixel in one of 128, and the quarters of
 * a square come in each of their 24 orders as often: numbers of tiles within 5 standard deviations.
 */
static void test_chance(void)
{
    enum { TILES = 9600, ORDERS = 24 };
    static int first[TILE_PIXELS], orders[4 * 4 * 4];
    int left = 0, met = 0;
    for (size_t number = 0; number < TILES; number++) {
        unsigned char cells[TILE_PIXELS];
        tile_order(7, number, cells);
        left += cells[0] % TILE_ACROSS < 8;
        first[cells[0]]++;
        orders[quarter_of(cells[0], 8) * 16 + quarter_of(cells[16], 8) * 4 +
               quarter_of(cells[32], 8)]++;
    }
    CHECK_NEAR(left, TILES / 2, 5 * sqrt(TILES / 4.0), "tiles whose left half is first");
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        CHECK_NEAR(first[i], TILES / 128, 5 * sqrt(TILES / 128.0), "tiles whose first it is");
    }
    for (size_t i = 0; i < sizeof orders / sizeof *orders; i++) {
        met += orders[i] > 0;
        CHECK_NEAR(orders[i], orders[i] > 0 ? TILES / ORDERS : 0, 5 * sqrt(TILES / 24.0), "orders");
    }
    CHECK(met == ORDERS);
}

/* Squares are ordered each by itself: two of a tile begin with the same quarter in one of four. */
static void test_apart(void)
{
    enum { TILES = 9600 };
    static const struct {
        int side;
        size_t next; /* place where the next square of that side begins */
    } squares[] = {{8, 64}, {4, 16}, {2, 4}};
    for (size_t k = 0; k < sizeof squares / sizeof *squares; k++) {
        int alike = 0;
        for (size_t number = 0; number < TILES; number++) {
            unsigned char cells[TILE_PIXELS];
            tile_order(9, number, cells);
            alike += quarter_of(cells[0], squares[k].side) ==
                     quarter_of(cells[squares[k].next], squares[k].side);
        }
        CHECK_NEAR(alike, TILES / 4, 5 * sqrt(TILES * 3 / 16.0), "squares that begin alike");
    }
}

/* The same for the same seed and number; another for another of either. */
static void test_again(void)
{
    unsigned char a[TILE_PIXELS], b[TILE_PIXELS];
    tile_order(5, 7, a);
    tile_order(5, 7, b);
    CHECK(memcmp(a, b, sizeof a) == 0);
    tile_order(6, 7, b);
    CHECK(memcmp(a, b, sizeof a) != 0);
    tile_order(5, 8, b);
    CHECK(memcmp(a, b, sizeof a) != 0);
}

/*
 * A crop in tiles of the whole frame: they begin where the frame's do, have it all between them,
 * each pixel once, and give a picture back that is taken apart by them.
 */
static void test_crops(void)
{
    static const struct image_area crops[] = {{0, 0, 0, 0},   {0, 0, 1, 1},  {17, 9, 30, 21},
                                              {16, 8, 16, 8}, {15, 7, 2, 2}, {40, 31, 10, 2}};
    enum { COLUMNS = 50, ROWS = 33 };
    for (size_t i = 0; i < sizeof crops / sizeof *crops; i++) {
        const struct tile_grid tiling = tiling_of(COLUMNS, ROWS, crops[i]);
        const struct image_area all = {0, 0, COLUMNS, ROWS};
        const struct image_area crop = crops[i].width == 0 ? all : crops[i];
        const size_t first[2] = {crop.left / TILE_ACROSS, crop.top / TILE_DOWN};
        const size_t last[2] = {(crop.left + crop.width - 1) / TILE_ACROSS,
                                (crop.top + crop.height - 1) / TILE_DOWN};
        static float from[ROWS * COLUMNS * TILE_CHANNELS], to[ROWS * COLUMNS * TILE_CHANNELS];
        const size_t count = crop.width * crop.height * TILE_CHANNELS;
        struct image image = {
            .width = crop.width, .height = crop.height, .channels = TILE_CHANNELS, .pixels = from};
        struct image again = image;
        again.pixels = to;
        CHECK(tiling.left == first[0] && tiling.top == first[1]);
        CHECK(tiling.across == last[0] - first[0] + 1 && tiling.down == last[1] - first[1] + 1);
        CHECK(tiling.frame == 4 && tiling.crop.width == crop.width);
        for (size_t k = 0; k < count; k++) {
            from[k] = (float)(k + 1);
            to[k] = -1;
        }
        double sum = 0;
        for (size_t tile = 0; tile < tiling.across * tiling.down; tile++) {
            float pixels[TILE_PIXELS][TILE_CHANNELS];
            size_t column, row;
            tiling_begin(&tiling, tile, &column, &row);
            CHECK(column == (first[0] + tile % tiling.across) * TILE_ACROSS);
            CHECK(row == (first[1] + tile / tiling.across) * TILE_DOWN);
            memset(pixels, 0x7f, sizeof pixels);
            tiling_copy(&tiling, &image, tile, TILE_FROM_PICTURE, pixels);
            for (size_t k = 0; k < TILE_PIXELS; k++) {
                for (size_t c = 0; c < TILE_CHANNELS; c++) {
                    sum += (double)pixels[k][c];
                }
            }
            tiling_copy(&tiling, &again, tile, TILE_TO_PICTURE, pixels);
        }
        CHECK_NEAR(sum, (double)count * ((double)count + 1) / 2, 0, "each once");
        CHECK(memcmp(from, to, count * sizeof *from) == 0);
    }
}

int main(void)
{
    test_squares();
    test_chance();
    test_apart();
    test_again();
    test_crops();
    return check_report();
}
