/* draw/panels_cell.h - one of many small plots: its axes, curves and words. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PANELS_CELL_H
#define LENSCALC_DRAW_PANELS_CELL_H

#include "draw/ticks.h"

#include <stdbool.h>

struct panel;
struct panels;
struct svg;

/* Px beside a panel that has numbers of its own. */
#define PANELS_NUMBERS 46.0

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

/* The width of the widest number of an axis, px. */
double panels_cell_number(struct svg *svg, const struct ticks *ticks);

/* Draw one panel. */
void panels_cell_draw(const struct panels *panels, struct svg *svg, const struct panels_cell *cell,
                      const struct panel *panel);

#endif
