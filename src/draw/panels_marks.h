/* draw/panels_marks.h - what the curves and spots of panels look like. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_PANELS_MARKS_H
#define LENSCALC_DRAW_PANELS_MARKS_H

#include <stdbool.h>
#include <stddef.h>

struct panels;
struct svg;

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
