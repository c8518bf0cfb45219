/* draw/ray_map.h - a map of errors over field and pupil, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_RAY_MAP_H
#define LENSCALC_DRAW_RAY_MAP_H

#include <stdbool.h>
#include <stddef.h>

struct arena;
struct error;
struct svg;

struct ray_map_point {
    size_t column, row;
    double x, y;   /* in the pupil, 1 is its edge */
    double dx, dy; /* the error, in `unit`; NaN = the ray was lost */
};

struct ray_map {
    const char *title, *subtitle;
    const struct ray_map_point *points;
    size_t count;
    const char *const *columns; /* labels of the fields */
    size_t column_count;
    const char *const *rows; /* labels of the wavelengths */
    size_t row_count;
    const char *unit; /* of the errors: "um" */
};

/*
 * Draw a pupil for each field and wavelength as a whole SVG document into `svg`, which must be
 * empty. A dot is a ray: its colour tells how far it is off, its arrow whereto. The longest arrow
 * of all is a quarter of the pupil's radius. A pupil without a point is labelled so.
 *
 * Errors    ERROR_DOMAIN: no point at all, or more than 12 fields or 8 wavelengths
 */
bool ray_map_draw(const struct ray_map *map, struct svg *svg, struct error *error);

#endif
