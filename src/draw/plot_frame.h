/* draw/plot_frame.h - the axes of a plot, and its points as they can be drawn. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PLOT_FRAME_H
#define LENSCALC_DRAW_PLOT_FRAME_H

#include "draw/plot.h"
#include "draw/ticks.h"

struct plot_axis {
    bool log;
    enum ticks_kind kind; /* of a logarithmic axis: its ticks are the stops of a camera */
    double low, high;     /* values at the ends */
    double start, stop;   /* px, where they lie */
    struct ticks ticks;
};

/* How many points a series has, and one of them: NaN = gap, +-inf = off the edge. */
size_t plot_series_count(const struct plot *plot, const struct plot_series *series);
double plot_x_at(const struct plot *plot, const struct plot_series *series, size_t i);
double plot_y_at(const struct plot *plot, const struct plot_series *series, size_t i);
enum plot_place plot_place_at(const struct plot_series *series, size_t i);

/* A value as it can be drawn on an axis: NaN = gap, +-inf = off the edge. */
double plot_drawable(double value, bool log);

/* The range of all points that count for it; false if there is none. */
bool plot_find_range(const struct plot *plot, struct plot_axis *x, struct plot_axis *y);

/* Round ticks: the axis reaches from tick to tick; the x axis of a plot ends where data end. */
void plot_axis_to_ticks(struct plot_axis *axis);
void plot_set_x_axis(struct plot_axis *x);

/* Where a value lies, px. */
double plot_page_at(const struct plot_axis *axis, double value);

/* The same, but no farther from the frame than a viewer's numbers take. */
double plot_near_page(const struct plot_axis *axis, double at);

/* The inverse of plot_page_at. */
double plot_value_at(const struct plot_axis *axis, double at);

/* Lines at the ticks of both axes, and a frame about them; numbers beside it, `size` px. */
void plot_axes_grid(struct svg *svg, const struct plot_axis *x, const struct plot_axis *y);
void plot_axes_numbers(struct svg *svg, const struct plot_axis *x, const struct plot_axis *y,
                       double size);

#endif
