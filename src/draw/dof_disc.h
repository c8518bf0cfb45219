/* draw/dof_disc.h - a depth-of-field calculator to cut out: two discs, in SVG and true size. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_DOF_DISC_H
#define LENSCALC_DRAW_DOF_DISC_H

#include "base/error.h"
#include "draw/svg.h"

#include <stdbool.h>
#include <stddef.h>

/* A calculator of one lens and one circle of confusion. */
struct dof_disc_drawing {
    const char *title, *lens, *sharpness; /* of the page; on the discs: "50 mm", "c = 0.03 mm" */
    double f, P, c;                       /* mm, -, mm */
    double nearest;                       /* from the front principal plane, mm, > f */
    const double *fnumbers;               /* ascending */
    size_t fnumber_count;
};

/* The page, mm. */
#define DOF_DISC_WIDTH  190.0
#define DOF_DISC_HEIGHT 128.0

/*
 * Draw the large disc, with an arrow and a pair of marks for each f-number, and the small one, with
 * the distances in metres and feet, that turns on it; a bar of 50 mm shows whether a print is in
 * true size.
 *
 * Result    angles are those of photo/dof_turn, so the marks are exact at every distance. Numbers
 *           that would overlap are left out: less round distances give way to rounder ones, small
 *           f-numbers to large ones
 * Errors    ERROR_DOMAIN: distances or f-numbers that leave the scale no room
 */
bool dof_disc_draw(const struct dof_disc_drawing *disc, struct svg *svg, struct error *error);

#endif
