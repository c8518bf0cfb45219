/* draw/abbe.h - the Abbe diagram: glasses by index and Abbe number, as in a textbook, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_ABBE_H
#define LENSCALC_DRAW_ABBE_H

#include <stdbool.h>
#include <stddef.h>

struct arena;
struct error;
struct svg;

/* The page, px. */
#define ABBE_WIDTH  900.0
#define ABBE_HEIGHT 640.0

struct abbe_point {
    double Vd, nd;
    size_t group;      /* index into groups */
    const char *label; /* its name */
    bool chosen;       /* drawn larger, labelled first and in any case */
};

/* A family of glasses: the area that its members span, tinted, with its name. */
struct abbe_family {
    const char *name;
    double *Vd, *nd;
    size_t count;
};

struct abbe {
    const char *title, *subtitle;
    const struct abbe_family *families; /* behind the points; the axes do not reach for them */
    size_t family_count;
    const struct abbe_point *points;
    size_t count;
    const char *const *groups; /* names for the legend, each a colour and a shape */
    size_t group_count;
};

/*
 * Draw the diagram as a whole SVG document into `svg`, which must be empty: nd upwards, Vd falling
 * to the right, crown and flint parted at Vd = 55 (50 from nd = 1.6 on).
 *
 * Result    points that are not finite are left out. Chosen points are labelled, where it is
 *           crowded at the end of a line; up to 400 others too, where their names find room. A
 *           family is the convex hull of its members, three at least, with a margin
 * Errors    no point that can be drawn
 */
bool abbe_draw(const struct abbe *abbe, struct svg *svg, struct error *error);

#endif
