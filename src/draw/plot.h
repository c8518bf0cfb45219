/* draw/plot.h - line plots of several series, as in a textbook, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PLOT_H
#define LENSCALC_DRAW_PLOT_H

#include "draw/ticks.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

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
    const char *label; /* beside the right end of the curve, of several with one label one has it,
                          and of one alone none; null = none */
    const double *y;   /* count values; NaN = gap, +-inf = off the edge */
    size_t style;      /* 0, 1, ...; after seven the colours come again with other dashes */
    size_t dash;       /* 1, 2, ...: those dashes in place of the style's; 0 = the style's */
    const double *x;   /* its own; null: those of the plot */
    size_t count;      /* of x, where it has its own; else that of the plot */
    const unsigned char *places; /* enum plot_place of each; null: all are samples */
};

/* What a point of a series is. */
enum plot_place {
    PLOT_SAMPLE,  /* asked for: a dot, where they are few */
    PLOT_BETWEEN, /* between samples, for the curve */
    PLOT_BEYOND   /* the same, where the curve runs off the page: the y axis need not reach there */
};

/* The area between two curves of the same x, tinted in the colour of `low`. */
struct plot_band {
    size_t low, high; /* indices of series */
};

/* In place of `high`: the area has no upper bound. */
#define PLOT_UNBOUNDED SIZE_MAX

struct plot {
    const char *title, *subtitle;  /* null = none */
    const char *x_label, *y_label; /* with units, as "distance (m)"; null = none */
    const double *x;
    size_t count;          /* of x, and of every y that has no x of its own */
    const double *x_ticks; /* where to mark x, ascending; null = chosen here */
    size_t x_tick_count;
    const struct plot_series *series;
    size_t series_count;
    const struct plot_band *bands;
    size_t band_count;
    bool is_share;   /* y is a part of a whole: its axis has 0 and 1 */
    bool is_limited; /* y beyond these two is far: the axis does not reach there, an arrow does */
    double y_least, y_most;
    enum ticks_kind x_kind, y_kind; /* of logarithmic axes */
    bool is_ordered; /* the labels are in an order of their own, as f/4, f/8, f/16 are */
    bool log_x, log_y;
};

/*
 * Set log_x and log_y: all finite values are positive and the largest is over 50 times the least,
 * of f-numbers and ISO speeds 1.9 times, of times 10 times. Else the y axis is limited where a
 * tenth of the values at one end is more than five times as far off as the others spread.
 */
void plot_choose_axes(struct plot *plot);

/*
 * Draw the plot as a whole SVG document into `svg`, which must be empty.
 *
 * Result    A curve that becomes infinite runs off the edge at its last finite x, with an arrow
 *           and an infinity sign. On a logarithmic axis values <= 0 are gaps. Up to 30 samples are
 *           marked with dots. Above 2000 points a curve is thinned to the least and the greatest
 *           value of each of at most 1000 stretches
 * Errors    no point with finite x and y (and positive where logarithmic)
 * Limits    |y| above 1e200 counts as infinite, below 1e-200 as 0; the same for x
 */
bool plot_draw(const struct plot *plot, struct svg *svg, struct error *error);

#endif
