/* draw/terminal/svg_read.h - the shapes of an SVG drawing, one after the other. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TERMINAL_SVG_READ_H
#define LENSCALC_DRAW_TERMINAL_SVG_READ_H

#include "base/arena.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* As sRGB encodes it, 0..1. */
struct svg_colour {
    bool is_none;
    double part[3];
};

enum svg_shape_kind { SVG_SHAPE_LINES, SVG_SHAPE_WORDS, SVG_SHAPE_IMAGE };

/* px, of the page. */
struct svg_bounds {
    double left, top, right, bottom;
};

/* A shape as it appears on the page. */
struct svg_shape {
    enum svg_shape_kind kind;
    struct svg_colour stroke, fill;
    bool is_dashed;
    double opacity;         /* 0..1 */
    struct svg_bounds clip; /* what of it is seen */
    /* lines, whose points are px of the page: NaN between parts; the corners of an image */
    double *x, *y;
    size_t count, room;
    /* words: anchored at x[0], y[0] */
    struct text words; /* UTF-8, without entities */
    double size, turn; /* px; degrees, clockwise */
    int anchor;        /* -1 start, 0 middle, 1 end */
    bool is_bold;
    /* an image: the bytes of its PNG file */
    struct text png;
};

enum { SVG_DEPTH = 32 };

struct svg_style_read {
    struct svg_colour stroke, fill;
    bool is_dashed;
    double opacity, size;
    double matrix[6]; /* x' = a x + c y + e, y' = b x + d y + f */
    struct svg_bounds clip;
};

/* Start with svg_read_begin. */
struct svg_reader {
    struct arena *arena;
    struct text rest;
    double width, height; /* of the page, px */
    struct svg_style_read styles[SVG_DEPTH];
    size_t depth; /* of styles that are open; deeper ones count as the last */
    size_t deeper;
    struct svg_bounds clip; /* of the last clipPath */
    bool in_clip;
};

/*
 * Read drawings as draw/svg.h writes them: groups, lines, rectangles, circles, paths, images and
 * text, with strokes, fills, dashes, opacity, transformations and rectangles that clip.
 *
 * Given     drawing  an SVG document; what is not understood in it is passed over
 */
void svg_read_begin(struct svg_reader *reader, struct text drawing, struct arena *arena);

/* The next shape, its points in the arena; false behind the last. */
bool svg_read(struct svg_reader *reader, struct svg_shape *shape);

/* Widen them to a point. */
void svg_bounds_include(struct svg_bounds *bounds, double x, double y);

#endif
