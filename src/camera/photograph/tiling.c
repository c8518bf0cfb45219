/* camera/photograph/tiling.c - tiles of a frame, and of a crop of it. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/tiling.h"

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
