/* draw/wedge_view.h - how a tilted lens and its scene lie on the page, for draw/wedge.c. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_WEDGE_VIEW_H
#define LENSCALC_DRAW_WEDGE_VIEW_H

#include "draw/wedge.h"

#include <stdbool.h>
#include <stddef.h>

struct arena;
struct svg;

/* Millimetres to px: x = x0 + scale u, y = y0 - scale height. */
struct view {
    double x0, y0, scale;
    double left, right, top, bottom; /* px, the frame */
};

/* A convex area, mm. */
#define AREA_CORNERS 12
struct area {
    double u[AREA_CORNERS], y[AREA_CORNERS];
    size_t count;
};

/* A stretch of a line, mm, from left to right. */
struct stretch {
    double u[2], y[2];
    bool shown; /* false: none of it is in the view */
};

double view_x(const struct view *view, double u);
double view_y(const struct view *view, double y);
bool view_holds(const struct view *view, double u, double y);

/* A line between two points given in mm. */
void view_line(const struct view *view, struct svg *svg, double u1, double y1, double u2,
               double y2);

/* Where a plane A u - B y = f is met straight ahead, mm; inf if it is not, before the lens. */
double wedge_ahead(const struct wedge *wedge, double A);

/* The view of the scene inside the frame whose sides (px) are set in `view`. */
void view_choose(struct view *view, const struct wedge *wedge, double names_px);

/* What is sharp: the view before the lens, behind the near limit and before the far limit. */
struct area view_sharp(const struct view *view, const struct wedge *wedge);

/* The part of the plane A u - B y = f that is in the view, before the lens. */
struct stretch view_plane(const struct view *view, const struct wedge *wedge, double A);

/* Numbers as the drawing shows them: "0.18", "5°". */
const char *wedge_digits(struct arena *arena, double x);
const char *wedge_degrees(struct arena *arena, double angle);

/* -------- draw/wedge_camera.c -------- */

/* Bellows, sensor and lens to scale. */
void wedge_draw_camera(struct svg *svg, const struct view *view, const struct wedge *wedge);

/* The camera enlarged inside the frame set in `view` (px), with its tilt and image distance. */
void wedge_draw_close_view(struct svg *svg, struct view *view, const struct wedge *wedge);

#endif
