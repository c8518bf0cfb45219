/* draw/outlines.h - closed shapes side by side at one scale, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_OUTLINES_H
#define LENSCALC_DRAW_OUTLINES_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

/* One shape. Lengths in the unit of the drawing, y up. */
struct pupil_outline {
    const char *label, *note; /* above and below it; null = none */
    const double (*points)[2];
    size_t count;              /* 0: nothing is left of it; the note says why */
    const double (*dashed)[2]; /* another to compare it with */
    size_t dashed_count;
};

struct outlines {
    const char *title, *subtitle; /* null = none */
    const char *unit;             /* of the scale bar: "mm" */
    const char *legend[2];        /* what the area and the dashed line are; null = none */
    const struct pupil_outline *shapes;
    size_t count;
};

/*
 * Draw the shapes as a whole SVG document into `svg`, which must be empty: in rows of up to five,
 * each with its axes through the origin, one scale for all, and a scale bar.
 *
 * Errors    ERROR_DOMAIN: no shape has an extent; ERROR_USAGE: more than 100 shapes
 */
bool outlines_draw(const struct outlines *outlines, struct svg *svg, struct error *error);

#endif
