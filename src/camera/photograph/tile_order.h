/* camera/photograph/tile_order.h - which pixel of a tile comes after which. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILE_ORDER_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILE_ORDER_H

#include "camera/photograph/tiling.h"

#include <stddef.h>
#include <stdint.h>

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
