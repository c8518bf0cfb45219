/* draw/raster.h - false-colour maps with their scale, in SVG; or one as a picture. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_RASTER_H
#define LENSCALC_DRAW_RASTER_H

#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

struct arena;
struct error;
struct svg;

/* A square map. */
struct raster_map {
    const char *title;    /* above it; null = none */
    const char *note;     /* small, below it; null = none */
    size_t size;          /* pixels along a side */
    const double *values; /* size * size, rows from below; NaN = nothing there */
    double half;          /* half a side, in units of the axes */
    double centre[2];     /* of the map, in the same */
    double step;          /* between contour lines; 0: there are none */
};

/* Which colours the values have. */
enum raster_colours {
    RASTER_SIGNED, /* blue below 0, red above, the scale as long on both sides */
    RASTER_LIGHT,  /* dark to bright, from 0 */
    RASTER_LOG,    /* the same of the logarithm, `decades` below the highest */
    RASTER_FRINGES /* grey: the interference of waves of these phases, in cycles, with a flat one */
};

struct rasters {
    const char *title, *subtitle;                /* null = none */
    const char *x_label, *y_label, *scale_label; /* with units */
    enum raster_colours colours;
    double decades;
    double highest;   /* of the scale at least; 0: from the values */
    bool own_scale;   /* maps with values of different size: the scale is the share of the highest,
                        which the note tells */
    const char *unit; /* of a bar of round length in each map; null = none */
    size_t columns;
    const struct raster_map *maps;
    size_t count;
};

enum { RASTER_MAPS_MOST = 100 };

/*
 * Draw maps as a whole SVG document into `svg`, which must be empty: one scale of colours for all,
 * the axes of each by itself.
 *
 * Result    small maps are interpolated. RASTER_SIGNED: the scale ends where ticks_reach says of
 *           absolute values. RASTER_FRINGES: intensities are the means over pixels, so that fringes
 *           too fine for them are grey; no scale of colours
 * Errors    ERROR_DOMAIN: no value in any of them; ERROR_USAGE: more than RASTER_MAPS_MOST
 */
bool rasters_draw(const struct rasters *rasters, struct svg *svg, struct error *error);

/*
 * One map alone as a PNG, a pixel a value, the uppermost row first; nothing is transparent white.
 *
 * Errors    ERROR_DOMAIN: no value
 */
bool raster_png(const struct rasters *rasters, size_t map, struct arena *arena, struct text *file,
                struct error *error);

#endif
