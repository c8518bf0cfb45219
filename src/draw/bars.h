/* draw/bars.h - groups of bars up and down from zero, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_BARS_H
#define LENSCALC_DRAW_BARS_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

/* Bars side by side. */
struct bar_group {
    const char *label;    /* below the axis: "3"; null = none */
    const double *values; /* one a kind; not finite = no bar */
    const double *marks;  /* a line across each bar, where own_scales; null = none */
    bool apart;           /* stands by itself on a tinted ground: a sum */
};

struct bars {
    const char *title, *subtitle;  /* null = none */
    const char *x_label, *y_label; /* with units; null = none */
    const char *const *kinds;      /* the legend: one colour a kind, at most seven */
    bool own_scales;               /* each kind in a strip of its own, at its own scale */
    size_t kind_count;
    const struct bar_group *groups;
    size_t group_count;
};

/*
 * Draw the bars as a whole SVG document into `svg`, which must be empty. The page widens with the
 * number of groups.
 *
 * Errors    ERROR_DOMAIN: no bar has a finite length, or one is longer than 1e100;
 *           ERROR_USAGE: more than 200 groups
 */
bool bars_draw(const struct bars *bars, struct svg *svg, struct error *error);

#endif
