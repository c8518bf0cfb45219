/* draw/barrel.h - the depth-of-field scale of a lens barrel, drawn flat, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_BARREL_H
#define LENSCALC_DRAW_BARREL_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

/* The page, px. */
#define BARREL_WIDTH  900.0
#define BARREL_HEIGHT 400.0

/* Limits of sharpness at one f-number. */
struct barrel_mark {
    double fnumber;
    double near_diopter; /* 1/m, >= focus_diopter */
    double far_diopter;  /* 1/m, <= focus_diopter; 0 = infinity, below 0 = past infinity */
};

struct barrel {
    const char *title, *subtitle; /* null = none */
    double focus_diopter;         /* 1/m, >= 0; 0 = focused at infinity */
    double nearest_diopter;       /* 1/m, where the distance scale begins, >= focus_diopter;
                                     0 = just before the nearest mark, for a close look */
    const struct barrel_mark *marks;
    size_t mark_count;
    size_t chosen; /* the mark in use, shown as the band of sharpness */
};

/*
 * Draw the scale as a whole SVG document into `svg`, which must be empty: the focus ring with feet
 * and metres (closest distance left, infinity right), the fixed ring with the index and a pair of
 * marks for each f-number, and the reciprocal distance as an axis.
 *
 * Result    x is linear in 1/distance, as on a lens that is focused by a screw. The scale goes on
 *           past infinity and past the closest distance as far as the marks do, but not beyond
 *           half and a quarter of its length; marks still farther out are left out. Numbers and
 *           ticks that would overlap are left out: less round distances give way to rounder
 *           ones, wide f-numbers to narrow ones, all to the chosen one
 * Errors    a number that is not finite or outside the ranges above, no mark, chosen >= mark_count
 * Source    derived: from near = s f^2 / (f^2 + N c (s - f)) and far with the minus sign follows
 *           1/near - 1/s = 1/s - 1/far = N c (s - f) / (f^2 s), so pairs lie symmetric in 1/s
 */
bool barrel_draw(const struct barrel *barrel, struct svg *svg, struct error *error);

#endif
