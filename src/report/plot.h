/* report/plot.h - line plots of several series, as in a textbook, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_PLOT_H
#define LENSCALC_REPORT_PLOT_H

#include <stdbool.h>
#include <stddef.h>

struct arena;
struct error;
struct svg;

/* The page, px. */
#define PLOT_WIDTH  800.0
#define PLOT_HEIGHT 500.0

/*
 * One curve. Curves of the same style look alike (one colour, one dash pattern): give the near and
 * the far limit of one f-number the same style and only one of them a label.
 */
struct plot_series {
    const char *label; /* beside the right end of the curve; null = none */
    const double *y;   /* plot.count values; NaN = gap, +-inf = off the edge */
    size_t style;      /* 0, 1, ...; after seven the colours come again with other dashes */
};

/* The area between two curves, tinted in the colour of `low`. */
struct plot_band {
    size_t low, high; /* indices of series */
};

struct plot {
    const char *title, *subtitle;  /* null = none */
    const char *x_label, *y_label; /* with units, as "distance (m)"; null = none */
    const double *x;
    size_t count;          /* of x and of every y */
    const double *x_ticks; /* where to mark x, ascending; null = chosen here */
    size_t x_tick_count;
    const struct plot_series *series;
    size_t series_count;
    const struct plot_band *bands;
    size_t band_count;
    double y_limit; /* a y above it is drawn like infinity; 0 = none */
    bool log_x, log_y;
};

/* Ticks of an axis, ascending. */
#define PLOT_TICKS 12
struct plot_ticks {
    double value[PLOT_TICKS];
    size_t count;
    double step; /* between two ticks; 0 on a logarithmic axis */
};

/*
 * Round numbers for a linear axis: multiples of 1, 2 or 5 x 10^n.
 *
 * Given     low, high  the range, low <= high, absolute values 0 or 1e-200 .. 1e200
 * Result    4 to 11 ticks, the first at or below low, the last at or above high. A range below
 *           1e-9 of the values is widened to 10 % on both sides
 */
void plot_ticks_linear(double low, double high, struct plot_ticks *ticks);

/*
 * Round numbers for a logarithmic axis: 1, 2 and 5 in every decade as long as at most 12 are
 * needed, then decades, then every second decade and so on; below a factor of 4 as a linear axis.
 *
 * Given     low, high  the range, 1e-200 <= low <= high <= 1e200
 */
void plot_ticks_log(double low, double high, struct plot_ticks *ticks);

/* How tick i is written: the same number of decimals on all, powers of ten where shorter. */
const char *plot_tick_text(struct arena *arena, const struct plot_ticks *ticks, size_t i);

/* Set log_x and log_y: all finite values are positive and the largest is over 50 times the least.
 */
void plot_choose_axes(struct plot *plot);

/*
 * Draw the plot as a whole SVG document into `svg`, which must be empty.
 *
 * Result    A curve that becomes infinite runs off the edge at its last finite x, with an arrow
 *           and an infinity sign. On a logarithmic axis values <= 0 are gaps. Up to 30 points are
 *           marked with dots. Above 2000 points a curve is thinned to the least and the greatest
 *           value of each of at most 1000 stretches
 * Errors    no point with finite x and y (and positive where logarithmic)
 * Limits    |y| above 1e200 counts as infinite, below 1e-200 as 0; the same for x
 */
bool plot_draw(const struct plot *plot, struct svg *svg, struct error *error);

#endif
