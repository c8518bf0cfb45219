/* draw/terminal/page_paint.h - the lines, areas and images of a drawing, as dots of a terminal. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TERMINAL_PAGE_PAINT_H
#define LENSCALC_DRAW_TERMINAL_PAGE_PAINT_H

#include "draw/terminal/page.h"
#include "draw/terminal/svg_read.h"

enum { STROKES_MOST = 16 };

/* A drawing on its way to a terminal. */
struct page {
    const struct page_view *view;
    struct arena *arena;
    struct svg_shape *shapes;
    size_t count, room;
    double width, height;    /* of the drawing, px */
    struct svg_colour paper; /* colour of the page */
    struct svg_bounds drawn; /* what is drawn but words, px */
    double scale, left, top; /* columns a px; the column of x = 0; the y of the first row, px */
    struct svg_colour strokes[STROKES_MOST]; /* colours that curves have, as they come */
    size_t stroke_count;
    struct cells cells;
};

/* All of a shape but words. */
void page_paint(const struct page *page, const struct svg_shape *shape);

#endif
