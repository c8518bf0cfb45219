/* draw/tally_plot.h - how figures are spread, and how many of them pass, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_TALLY_PLOT_H
#define LENSCALC_DRAW_TALLY_PLOT_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

struct tally_plot {
    const char *title, *subtitle;  /* null = none */
    const char *x_label, *y_label; /* with units; null = none */
    double low, high;              /* of the figures, low < high */
    const double *values;          /* of `count` equal parts: bars; of a curve at their count + 1
                                      edges */
    size_t count;                  /* 1 at least */
    bool is_curve;
    double nominal;       /* marked; NaN: not */
    double limit;         /* marked; NaN: not. Bars beyond it have another colour: */
    bool fails_above;     /* those above it, else those below */
    const char *marks[2]; /* beside the marks: of the nominal figure, of the limit */
};

/*
 * Draw it as a whole SVG document into `svg`, which must be empty. The range is widened to hold the
 * marks.
 *
 * Errors    ERROR_DOMAIN: no value is above 0; a range without a width
 */
bool tally_plot_draw(const struct tally_plot *plot, struct svg *svg, struct error *error);

#endif
