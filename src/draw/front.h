/* draw/front.h - what costs more and errs less: points in a log-log plane with their front, SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_FRONT_H
#define LENSCALC_DRAW_FRONT_H

#include <stdbool.h>
#include <stddef.h>

struct arena;
struct error;
struct svg;

/* The page, px. */
#define FRONT_WIDTH  900.0
#define FRONT_HEIGHT 620.0

struct front_point {
    double x, y;       /* what is small where it is good; above 0 */
    const char *label; /* null: none */
    size_t group;      /* index into groups; points of one that is a line come in its order */
    bool is_best;      /* on the front */
};

struct front_group {
    const char *name;
    bool is_line; /* its points are joined */
};

struct front {
    const char *title, *subtitle, *x_label, *y_label;
    const struct front_point *points;
    size_t count;
    const struct front_group *groups;
    size_t group_count;
};

/*
 * Draw them as a whole SVG document into `svg`, which must be empty: both axes logarithmic, the
 * front as steps, below and left of which there is nothing, its points labelled first.
 *
 * Result    points that are not finite or not above 0 are left out, labels where there is no room
 * Errors    no point that can be drawn
 */
bool front_draw(const struct front *front, struct svg *svg, struct error *error);

#endif
