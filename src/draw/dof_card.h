/* draw/dof_card.h - a card of depth of field to print and carry: A6, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_DOF_CARD_H
#define LENSCALC_DRAW_DOF_CARD_H

#include "base/error.h"
#include "draw/svg.h"

#include <stdbool.h>
#include <stddef.h>

/* Limits of sharpness at one f-number, or why there are none: m; NaN = none. */
struct dof_card_cell {
    double hyperfocal, near, far;
};

/* Lenses in blocks, distances in rows, f-numbers in columns. */
struct dof_card {
    const char *title, *subtitle;
    const char *const *lenses;
    const double *distances; /* m */
    const double *fnumbers;
    size_t lens_count, distance_count, fnumber_count;
    const struct dof_card_cell *cells; /* [lens][distance][fnumber] */
};

/* The page, mm. */
#define DOF_CARD_WIDTH  105.0
#define DOF_CARD_HEIGHT 148.0

/*
 * Draw the card: for each lens its hyperfocal distances, and near and far limit for each distance
 * in focus.
 *
 * Errors    ERROR_USAGE: more columns or rows than can be read on a page of this size
 */
bool dof_card_draw(const struct dof_card *card, struct svg *svg, struct error *error);

#endif
