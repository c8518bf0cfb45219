/* draw/plot_sample.h - curves sampled as finely as a plot of them shows. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PLOT_SAMPLE_H
#define LENSCALC_DRAW_PLOT_SAMPLE_H

#include "draw/plot.h"

/* What gives the values of several curves at any x. */
struct plot_source {
    size_t curves;
    /* Fill y[0 .. curves - 1], NaN where there is none; false: no more are to be asked for. */
    bool (*at)(void *context, double x, double *y);
    void *context;
    size_t most;     /* times it may be asked */
    bool is_stepped; /* whole numbers: where they jump is looked for */
};

/* Curves of common x. */
struct plot_curves {
    double *x, **y;
    unsigned char *places; /* enum plot_place */
    size_t count;
};

/*
 * Points between the samples of curves, where these are bent, end, or become infinite.
 *
 * Given     plot    with the samples of all that is drawn, and its kinds of axes: the page that
 *                   what is seen is measured on
 *           x, y    the samples: `count` x in any order of size, of each curve as many y
 *           curves  receives samples and points between, in the order of the samples
 * Result    between neighbours the curve is off a straight line by less than a tenth of a pixel,
 *           or they are a third of a pixel apart. The x where a curve begins, ends, becomes
 *           infinite or jumps is met to 0.002 pixels. At a pole, which it leaves at one edge and
 *           comes back from at the other, it is broken
 * Formula   halving in the axis's own measure: an interval is halved while its middle is off the
 *           chord, at least twice where it is over 8 pixels wide
 * Limits    a bend narrower than a quarter of the way from sample to sample may be missed
 */
void plot_sample(const struct plot *plot, const double *x, const double *const *y, size_t count,
                 const struct plot_source *source, struct plot_curves *curves, struct arena *arena);

#endif
