/* camera/photograph/tiling.c - tiles of a frame, and of a crop of it. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tiling.h"

#include "base/random.h"

#include <string.h>

struct tile_grid tiling_of(size_t columns, size_t rows, struct image_area crop)
{
    struct tile_grid tiling = {.crop = crop, .frame = (columns + TILE_ACROSS - 1) / TILE_ACROSS};
    if (crop.width == 0) {
        tiling.crop = crop = (struct image_area){0, 0, columns, rows};
    }
    tiling.left = crop.left / TILE_ACROSS;
    tiling.top = crop.top / TILE_DOWN;
    tiling.across = (crop.left + crop.width + TILE_ACROSS - 1) / TILE_ACROSS - tiling.left;
    tiling.down = (crop.top + crop.height + TILE_DOWN - 1) / TILE_DOWN - tiling.top;
    return tiling;
}

void tiling_begin(const struct tile_grid *tiling, size_t tile, size_t *column, size_t *row)
{
    *column = (tiling->left + tile % tiling->across) * TILE_ACROSS;
    *row = (tiling->top + tile / tiling->across) * TILE_DOWN;
}

void tiling_copy(const struct tile_grid *tiling, const struct image *image, size_t tile,
                 enum tile_way way, float pixels[TILE_PIXELS][TILE_CHANNELS])
{
    const struct image_area *crop = &tiling->crop;
    size_t column, row;
    tiling_begin(tiling, tile, &column, &row);
    for (size_t k = 0; k < TILE_PIXELS; k++) {
        const size_t x = column + k % TILE_ACROSS, y = row + k / TILE_ACROSS;
        const bool is_within = x >= crop->left && x < crop->left + crop->width && y >= crop->top &&
                               y < crop->top + crop->height;
        float *in_picture =
            is_within ? image_row(image, y - crop->top) + (x - crop->left) * TILE_CHANNELS : NULL;
        for (size_t channel = 0; channel < TILE_CHANNELS; channel++) {
            if (way == TILE_FROM_PICTURE) {
                pixels[k][channel] = is_within ? in_picture[channel] : 0;
            } else if (is_within) {
                in_picture[channel] = pixels[k][channel];
            }
        }
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
            /* digits 0 .. 3 in an order by chance */
            uint32_t word = words.w[j];
            unsigned char *digits = order[k + j];
            for (uint32_t left = 4; left > 0; left--) {
                const uint32_t taken = word % left, digit = digits[taken];
                word /= left;
                digits[taken] = digits[left - 1];
                digits[left - 1] = (unsigned char)digit;
            }
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
