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

int main(void)
{
    test_squares();
    test_chance();
    test_apart();
    test_again();
    return check_report();
}
