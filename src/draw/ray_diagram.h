/* draw/ray_diagram.h - the textbook construction of an image by thin lenses or a mirror, in SVG. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DRAW_RAY_DIAGRAM_H
#define LENSCALC_DRAW_RAY_DIAGRAM_H

#include <stdbool.h>
#include <stddef.h>

struct error;
struct svg;

enum { RAY_DIAGRAM_MOST = 24 };

/* A thin lens on the axis; or the one mirror. */
struct ray_diagram_element {
    double z;     /* from the first, mm */
    double power; /* 1/f, 1/mm; 0 = a plane mirror */
};

struct ray_diagram {
    const char *title;
    const struct ray_diagram_element *elements;
    size_t count; /* 1 .. RAY_DIAGRAM_MOST */
    bool is_mirror;
    double object; /* in front of the first, mm; negative: a virtual object; inf */
    double height; /* of the object, mm, not 0; drawn to a scale of its own */
    bool has_height;
};

/*
 * Draw it as a whole document into `svg`, which must be empty: the ray parallel to the axis, that
 * through the centre of the first lens and that through its focal point, each through all lenses;
 * dashed where there is no light; object, images, focal points and distances with their names.
 *
 * Formula   u' = u - y/f and 1/s' = 1/f - 1/s at each lens
 * Source    [OpenStax16] ch. 2.2, 2.4
 * Errors    ERROR_DOMAIN: the object lies in the first lens
 * Limits    heights have another scale than distances; images farther away than some times the
 *           rest are named, not shown
 */
bool ray_diagram_draw(const struct ray_diagram *diagram, struct svg *svg, struct error *error);

#endif
