/* draw/panels_cell.h - one of many small plots: its axes, curves and words. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PANELS_CELL_H
#define LENSCALC_DRAW_PANELS_CELL_H

#include "draw/ticks.h"

#include <stdbool.h>
#include <stddef.h>

struct panel;
struct panels;
struct svg;

/* Px beside a panel that has numbers of its own. */
#define PANELS_NUMBERS 46.0

/* Of the letters of numbers, px. */
#define PANELS_NUMBER_SIZE 11.0

struct panels_scale {
    double low, high; /* values at the ends */
    struct ticks ticks;
};

/* Where a panel lies, px, and its scales. */
struct panels_cell {
    double left, top, width, height;
    double room; /* for words above and below it */
    struct panels_scale x, y;
    bool x_numbers, y_numbers;
};

/* Draw one panel. */
void panels_cell_draw(const struct panels *panels, struct svg *svg, const struct panels_cell *cell,
                      const struct panel *panel);

/* -------- what the curves and spots of panels look like -------- */

/* A curve, or spots, through points on the page (px); gaps where one is not finite. */
struct panels_mark {
    const double *x, *y;
    size_t count;
    size_t key;
    bool spots;
    bool large; /* for the legend: spots that are seen at a glance */
};

void panels_marks_draw(const struct panels *panels, struct svg *svg,
                       const struct panels_mark *mark);

#endif
