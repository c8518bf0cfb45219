/* scene/rectangle.h - rectangles sampled evenly in solid angle. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_RECTANGLE_H
#define LENSCALC_SCENE_RECTANGLE_H

#include "scene/vector.h"

#include <stdbool.h>

struct rectangle {
    struct vector at;  /* its middle */
    struct frame axes; /* along its edges; z across it */
    double half[2];    /* of its edges, mm */
};

/*
 * Its solid angle from a point, sr; of small ones as good as their middle tells it.
 *
 * Formula   atan(x y/(z r)) of the four corners, with their signs
 */
double rectangle_solid_angle(const struct rectangle *rectangle, struct vector from);

/*
 * A place on it.
 *
 * Given     u       two numbers in 0..1
 *           shares  receives the place: -1 to 1 along both axes
 * Formula   even in the solid angle, or in the area where it is small
 * Source    [Urena13] 3
 */
struct vector rectangle_sample(const struct rectangle *rectangle, struct vector from,
                               const double u[2], double shares[2]);

/* The pdf of these places by their direction, per sr; 0 along the plane of the rectangle. */
double rectangle_pdf(const struct rectangle *rectangle, struct vector from, struct vector direction,
                     double distance);

#endif
