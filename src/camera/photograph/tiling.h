/* camera/photograph/tiling.h - tiles that a picture is taken in, each by itself. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILING_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILING_H

#include "base/image/image.h"
#include "camera/film/film_rays.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

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

_Static_assert(TILE_ACROSS == (int)FILM_ACROSS && TILE_DOWN == (int)FILM_DOWN,
               "a cell of the film for each pixel of a tile");

struct tile_cell {
    size_t column, row; /* from the left and from below, on the film */
    size_t pixel;       /* in rows from the upper left of the picture */
};

/*
 * Given     plan  of a tile
 *           x, y  of a point within it, mm
 */
static inline struct tile_cell tile_cell_of(const struct film_plan *plan, double x, double y)
{
    const double across = (x - plan->left) / plan->width * TILE_ACROSS;
    const double up = (y - plan->bottom) / plan->height * TILE_DOWN;
    const size_t column = (size_t)fmin(across, TILE_ACROSS - 1),
                 row = (size_t)fmin(up, TILE_DOWN - 1);
    return (struct tile_cell){column, row, row * TILE_ACROSS + (TILE_ACROSS - 1 - column)};
}

/*
 * Pixels along a curve that fills squares: those that follow each other, whose points complement
 * each other, are neighbours. The quarters of each square come in an order by chance, or it would
 * show as a pattern of the whole picture.
 *
 * Given     number  of the tile
 * Result    cells   every pixel once, counted in rows; squares of 2, 4 and 8 pixels have places
 *                   that follow each other. Tiles are ordered each by itself
 * Source    [Ahmed20]
 */
void tile_order(uint64_t seed, size_t number, unsigned char cells[TILE_PIXELS]);

#endif
