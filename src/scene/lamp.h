/* scene/lamp.h - one flat or round thing that shines, or a point: where rays may go to it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_LAMP_H
#define LENSCALC_SCENE_LAMP_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>

/* A side of a box, a triangle, all of another thing, or a light that is a point. */
struct lamp {
    size_t thing; /* of the scene; SCENE_NONE: a light */
    size_t part;  /* of a box the side, 2 axis + 1 if it is the upper; a triangle; the light */
};

/* How many lamps a thing is that shines; a plane is none of them. */
size_t lamp_parts(const struct scene_thing *thing);

/* Where a lamp is at the time 0, and its size. */
struct lamp_bounds {
    struct vector middle;
    double radius; /* mm, about all of it */
    double area;   /* mm^2 of what is seen from any side: of a sphere all of it; 0 of a point */
};

struct lamp_bounds lamp_bounds(const struct scene *scene, const struct lamp *lamp);

/* A ray to a lamp. */
struct lamp_ray {
    struct vector way;
    double distance; /* mm */
    double density;  /* of such ways, per sr */
    double place[2]; /* of a card: in its picture */
};

/*
 * A way to a lamp that is no point.
 *
 * Given     pose  of its thing at the time of the ray
 *           u     two numbers in 0..1
 * Result    false: it is not seen from there, or from its edge only
 * Formula   spheres by the solid angle of their cone, or all around from within; flat things by
 *           their area: density r^2/(A |cos|)
 * Source    [Shirley96] 2 and 3
 */
bool lamp_sample(const struct scene *scene, const struct lamp *lamp, const struct scene_pose *pose,
                 struct vector from, const double u[2], struct lamp_ray *ray);

/* The density of lamp_sample for a way that meets the lamp at a distance; 0 where it has none. */
double lamp_density(const struct scene *scene, const struct lamp *lamp,
                    const struct scene_pose *pose, struct vector from, struct vector way,
                    double distance);

#endif
