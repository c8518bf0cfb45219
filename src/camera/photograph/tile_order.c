/* camera/photograph/tile_order.c - quarters of squares of pixels in orders by chance. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tile_order.h"

#include "base/random.h"

#include <string.h>

/* Digits 0 .. 3 in an order by chance. */
static void shuffle(uint32_t word, unsigned char digits[4])
{
    for (uint32_t left = 4; left > 0; left--) {
        const uint32_t taken = word % left, digit = digits[taken];
        word /= left;
        digits[taken] = digits[left - 1];
        digits[left - 1] = (unsigned char)digit;
    }
}

void tile_order(uint64_t seed, size_t number, unsigned char cells[TILE_PIXELS])
{
    enum { NODES = 44 }; /* both halves; then quarters of squares of 8, 4 and 2 pixels */
    unsigned char order[NODES][4];
    for (uint32_t k = 0; k < NODES; k += 4) {
        const struct random_words words = random_words(RANDOM_CELLS, seed, number, k);
        for (uint32_t j = 0; j < 4; j++) {
            memcpy(order[k + j], (const unsigned char[]){0, 1, 2, 3}, 4);
            shuffle(words.w[j], order[k + j]);
        }
    }
    const size_t half = order[0][0] % 2;
    for (size_t i = 0; i < TILE_PIXELS; i++) {
        const size_t eight = order[1 + i / 64][i / 16 % 4], four = order[3 + i / 16][i / 4 % 4],
                     two = order[11 + i / 4][i % 4];
        const size_t column = (i / 64 ^ half) * 8 + eight % 2 * 4 + four % 2 * 2 + two % 2;
        const size_t row = eight / 2 * 4 + four / 2 * 2 + two / 2;
        cells[i] = (unsigned char)(row * TILE_ACROSS + column);
    }
}
