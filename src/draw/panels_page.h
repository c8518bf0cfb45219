/* draw/panels_page.h - the page that panels lie on: its measures and words. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PANELS_PAGE_H
#define LENSCALC_DRAW_PANELS_PAGE_H

#include "draw/panels_cell.h"

#include <stddef.h>

struct panels;
struct svg;

/* Given: panels, svg and the shared scales; the rest is set by panels_page_begin. */
struct panels_page {
    const struct panels *panels;
    struct svg *svg;
    struct panels_scale x, y;
    double left, top;        /* px, of the first panel */
    double width, height;    /* of a panel */
    double across, down;     /* from one panel to the next */
    double bottom;           /* px, below the notes and numbers of the last panels */
    double total_x, total_y; /* of the page */
};

/* Measure the page and draw title, subtitle and legend. */
void panels_page_begin(struct panels_page *page);

/* Where panel i lies, with the shared scales. */
struct panels_cell panels_page_cell(const struct panels_page *page, size_t i);

/* Draw heads, labels of the axes and the scale bar, and end the drawing. */
void panels_page_end(const struct panels_page *page);

#endif
