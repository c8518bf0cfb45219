/* camera/photograph/tile_cell.h - which pixel of a tile a point of the film is of. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_TILE_CELL_H
#define LENSCALC_CAMERA_PHOTOGRAPH_TILE_CELL_H

#include "camera/film/film_rays.h"
#include "camera/photograph/tiling.h"

#include <math.h>

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

#endif
