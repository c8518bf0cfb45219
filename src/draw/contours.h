/* draw/contours.h - contour lines of a map, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_CONTOURS_H
#define LENSCALC_DRAW_CONTOURS_H

#include <stddef.h>

struct svg;

/* Values at the corners of a square grid. */
struct contour_map {
    size_t size;          /* corners along a side */
    const double *values; /* size * size, rows from below; NaN = nothing there */
    double x, y, side;    /* the square on the page, px: its upper left corner, its side */
};

/*
 * Draw the line of a value within the group of the caller.
 *
 * Formula   marching squares, linear along the edges of cells; of a saddle the middle is the mean
 *           of its corners. Cells with a corner that is NaN have none
 */
void contours_draw(const struct contour_map *map, double value, struct svg *svg);

#endif
