/* draw/grid_image.h - a square grid as a lens images it, over the ideal one, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_GRID_IMAGE_H
#define LENSCALC_DRAW_GRID_IMAGE_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

/*
 * Lines run across x and across y, each through all others, with further points between the
 * crossings: point i of line k, at k * points + i, first those along x from below to above, then
 * those along y.
 */
struct grid_image {
    const char *title, *subtitle, *note; /* null = none */
    const char *ideal_label, *image_label;
    size_t lines, points; /* of one direction; of one line */
    double half;          /* of the ideal square's side, mm */
    const double *x, *y;  /* 2 * lines * points places in the image, mm; not finite = a gap */
};

/*
 * Draw it as a whole SVG document into `svg`, which must be empty: the image solid, the ideal grid
 * dashed, both at one scale, with axes in mm.
 *
 * Errors    ERROR_DOMAIN: no point of the image
 */
bool grid_image_draw(const struct grid_image *grid, struct svg *svg, struct error *error);

#endif
