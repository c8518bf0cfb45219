/* draw/pareto.h - who has how large a share, the largest first, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PARETO_H
#define LENSCALC_DRAW_PARETO_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

/* One row: two bars, the second of which holds the first. */
struct pareto_bar {
    const char *label;
    double part, whole; /* 0 <= part <= whole, shares of 1 */
};

struct pareto {
    const char *title, *subtitle, *x_label; /* null = none */
    const char *part_name, *whole_name;     /* the legend */
    const struct pareto_bar *bars;          /* in the order of the rows */
    size_t count;
    size_t most; /* rows at most: the others are one, "12 others" */
};

/*
 * Draw the rows as a whole SVG document into `svg`, which must be empty. The page grows with the
 * number of rows, so that no label touches another; long ones are cut.
 *
 * Errors    ERROR_DOMAIN: no bar has a length
 */
bool pareto_draw(const struct pareto *pareto, struct svg *svg, struct error *error);

#endif
