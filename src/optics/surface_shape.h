/* optics/surface_shape.h - surfaces and the glass between two: slopes, edges, volumes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_SURFACE_SHAPE_H
#define LENSCALC_OPTICS_SURFACE_SHAPE_H

#include "optics/lens.h"

#include <stddef.h>

/* A surface at a distance from its axis; NaN where it does not reach so far. */
struct surface_shape {
    double sag;       /* z, mm: surface_sag */
    double slope;     /* dz/dr */
    double departure; /* sag less that of the sphere of its vertex, mm; NaN: that ends before */
};

/*
 * Given     height  r from the axis, mm; in the curved section of a cylinder
 * Formula   dz/dr = c r/sqrt(1 - (1+k) c^2 r^2) + 2 r dS/du of the departure S of u = r^2
 * Source    derived here: the derivative of surface_sag
 */
struct surface_shape surface_shape_at(const struct surface *surface, double height);

/* A piece of glass between two surfaces. Its rim is the larger of their semi-diameters. */
struct glass_shape {
    double semi_diameter;  /* of the rim, mm; NaN: a surface states no diameter */
    double edge_thickness; /* parallel to the axis at the rim, mm; negative: the surfaces meet */
    double volume;         /* mm^3; NaN: it has no rotational symmetry, or the surfaces meet */
};

/*
 * The glass behind a surface of a lens in one position.
 *
 * Given     surface  its index; glass behind it, and another surface behind that
 * Result    a surface with the smaller diameter is flat from there to the rim
 * Formula   pi b^2 t + V(right) - V(left), b the rim, t the thickness on the axis,
 *           V = 2 pi integral of z r dr to the semi-diameter a + pi (b^2 - a^2) z(a), by Gauss's
 *           points in the angle whose sine is r/a: smooth up to a hemisphere
 * Source    of a sphere V = pi h^2 (R - h/3), h its sag, less than a cylinder's: tests have it
 */
struct glass_shape glass_shape_behind(const struct lens *lens, size_t surface);

#endif
