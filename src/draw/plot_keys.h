/* draw/plot_keys.h - what the curves of a plot are called, at their ends. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PLOT_KEYS_H
#define LENSCALC_DRAW_PLOT_KEYS_H

#include "draw/plot_frame.h"
#include "draw/svg.h"

/* How a curve is drawn. */
struct svg_style plot_line_of(const struct plot_series *series);

/* Room that the labels take right of the frame, px; 0: there are none. */
double plot_keys_width(const struct plot *plot);

/*
 * Draw the labels, each once.
 *
 * Result    of several curves with one label that has it which keeps the labels farthest apart.
 *           Each stands at its curve's end where all have room there; else they are moved apart,
 *           or if plot->is_ordered they are a list in the order of the series, or its reverse,
 *           whichever is nearer to that of the ends
 */
void plot_keys_draw(struct svg *svg, const struct plot *plot, const struct plot_axis *x,
                    const struct plot_axis *y);

#endif
