/* camera/photograph/tiling.h - tiles that a picture is taken in, each by itself. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILING_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILING_H

#include "base/image/image.h"

#include <stddef.h>

enum {
    TILE_CHANNELS = 3,
    TILE_ACROSS = 16, /* pixels of it: of 128 points of a net in base 2 each has one */
    TILE_DOWN = 8,
    TILE_PIXELS = TILE_ACROSS * TILE_DOWN
};

/* Of a frame, those that a crop of it lies in: in rows from the crop's top left. */
struct tile_grid {
    struct image_area crop;
    size_t frame;     /* tiles across the frame */
    size_t left, top; /* the first one's column and row among them */
    size_t across, down;
};

/* Given: crop  pixels that are taken; no width: all of the frame */
struct tile_grid tiling_of(size_t columns, size_t rows, struct image_area crop);

/* Where a tile of the crop begins in the frame: column and row of pixels. */
void tiling_begin(const struct tile_grid *tiling, size_t tile, size_t *column, size_t *row);

enum tile_way { TILE_FROM_PICTURE, TILE_TO_PICTURE };

/* A tile's channels between a picture of the crop and an array by itself, 0 outside the crop. */
void tiling_copy(const struct tile_grid *tiling, const struct image *image, size_t tile,
                 enum tile_way way, float pixels[TILE_PIXELS][TILE_CHANNELS]);

#endif
