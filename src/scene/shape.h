/* scene/shape.h - intersections of rays with shapes, in their own frames. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_SHAPE_H
#define LENSCALC_SCENE_SHAPE_H

#include "scene/scene.h"

/* In the frame of a thing; its direction has length 1. */
struct shape_ray {
    struct vector origin, direction;
    double farthest; /* mm */
};

/* The intersection: enough to tell all the rest. */
struct shape_hit {
    double distance; /* mm, above 0 and below the ray's farthest */
    size_t part;     /* of a mesh the triangle; of a box the side, 2 axis + 1 if it is the upper */
    double share[2]; /* of a triangle's second and third corner */
};

/* What is there, in the frame of the thing. */
struct shape_surface {
    struct vector at;     /* on the surface itself, not only near it */
    struct vector normal; /* of length 1, outwards; of flat things to their front, z > 0 */
    struct vector face;   /* the same of the surface itself, of meshes without smoothness */
    double place[2];      /* in a texture, from the left and from below, 0 to 1 */
    double size;          /* of the numbers that `at` was computed of: sums of its parts, mm */
};

/* The sum of its parts: what rounding errors of turned and moved points are shares of. */
static inline double vector_taxi(struct vector a)
{
    return fabs(a.x) + fabs(a.y) + fabs(a.z);
}

/* Axis by axis, mm. */
struct shape_box {
    struct vector low, high;
};

/*
 * The nearest intersection of a ray with a thing.
 *
 * Given     thing  anything but a mesh
 *           ray    its direction may have parts of 0
 * Result    false: nowhere before its farthest. What starts on a plane does not meet it; spheres
 *           and boxes are met from within as well. Where a card's alpha a is below 1, a share a of
 *           all places is there, picked by enciphering the place itself: it is so for every ray and
 *           at all times, and right in the mean
 * Formula   sphere: from the point of the ray that is nearest to the middle, so that neither far
 *           nor grazing rays lose digits [Haines19]
 */
bool shape_intersect(const struct scene_thing *thing, const struct shape_ray *ray,
                     struct shape_hit *meeting);

/*
 * The surface where they met.
 *
 * Result    places: of a disc in the square about it; of a sphere by longitude and latitude, y up,
 *           z in the middle; of a box on each side, as one looks at it; of a plane what `repeat`
 *           leaves
 */
struct shape_surface shape_surface(const struct scene_thing *thing, const struct shape_ray *ray,
                                   const struct shape_hit *meeting);

/* All of it lies within; a plane has none, and a mesh its own. */
struct shape_box shape_box(const struct scene_thing *thing);

#endif
