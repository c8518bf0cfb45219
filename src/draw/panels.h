/* draw/panels.h - many small plots on one page: ray fans, spots through focus, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PANELS_H
#define LENSCALC_DRAW_PANELS_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

/* A curve, or scattered points. */
struct panel_series {
    const double *x, *y; /* count values; not finite = a gap */
    size_t count;
    size_t key; /* index into panels.keys: what it looks like */
    bool spots; /* points by themselves, not joined */
};

struct panel {
    const char *title;             /* above it; null = none */
    const char *note;              /* small; below spots, inside at the top for curves; null = none.
                                     A panel without a point shows it in its middle */
    const char *x_label, *y_label; /* where the axis is the panel's own (own_x, own_y) */
    const struct panel_series *series;
    size_t count;
    double circle;  /* radius about the origin, in units of the axes: an Airy disc; 0 = none */
    bool is_absent; /* its place stays empty */
};

/*
 * The page: a grid of panels, row by row. Axes have one scale for all panels and numbers along the
 * left and the lower edge, unless own_x or own_y gives each panel its own. With `unit` there are no
 * axes: both directions have the same scale, which a bar explains, and the origin is marked. Spots
 * of all series of a panel are drawn in turns, a part of each, so that none hides the others.
 */
struct panels {
    const char *title, *subtitle;    /* null = none */
    const char *x_label, *y_label;   /* with units, as "dy (µm)"; null = none */
    const char *unit;                /* of the scale bar, "µm"; null = axes */
    const char *const *column_heads; /* over the columns, null = none */
    const char *const *row_heads;    /* beside the rows, null = none */
    const char *const *row_captions; /* above the rows, null = none */
    const char *const *keys;         /* what the looks mean: the legend; null = none is drawn */
    size_t key_count;                /* series have key < key_count, but for null keys */
    bool light;                      /* keys are wavelengths, ascending: violet to red */
    const char *circle_label;        /* in the legend; null = none */
    double x_low, x_high, y_low,
        y_high; /* shared ranges at least; low = high = 0: from the points */
    bool own_x, own_y;
    bool tall;      /* higher than wide, for curves that run upwards */
    size_t columns; /* of the grid, >= 1 */
    const struct panel *panels;
    size_t count;
};

/*
 * Draw the page as a whole SVG document into `svg`, which must be empty.
 *
 * Result    The ranges hold all points and reach to round numbers, x only if no range was given.
 *           Colours are safe for the colour-blind; curves differ by their dashes too. A point
 *           between gaps is a dot
 *           With `unit`: where 2 % of a panel's points lie more than twice as far out as all the
 *           others the page ends before them, and the note says how many are outside
 * Errors    ERROR_DOMAIN: no panel has a point, or values beyond 1e12;
 *           ERROR_USAGE: more than 400 panels or 20 columns, which nobody can read
 */
bool panels_draw(const struct panels *panels, struct svg *svg, struct error *error);

#endif
