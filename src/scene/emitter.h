/* scene/emitter.h - area and point emitters, sampled from a point. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_EMITTER_H
#define LENSCALC_SCENE_EMITTER_H

#include "scene/scene.h"
#include "scene/world.h"

#include <stdbool.h>
#include <stddef.h>

/* A triangle, all of another thing, or a light that is a point. */
struct emitter {
    size_t thing; /* of the scene; SCENE_NONE: a light */
    size_t part;  /* the triangle, or the light */
};

/* How many emitters a thing is that shines; a plane is none of them. */
size_t emitter_parts(const struct scene_thing *thing);

/* Where an emitter is at the time 0, and its size. */
struct emitter_bounds {
    struct vector middle;
    double radius; /* mm, about all of it */
    double area;   /* mm^2 that are seen from where it is seen best, of a box in the mean */
};

struct emitter_bounds emitter_bounds(const struct scene *scene, const struct emitter *emitter);

/* A direction sampled towards an emitter. */
struct emitter_sample {
    struct vector direction;
    double distance; /* mm */
    double pdf;      /* of such directions, per sr */
    double place[2]; /* of a card: in its picture */
};

/*
 * Sample a direction to an emitter that is no point.
 *
 * Given     part  of it, a triangle
 *           pose  of it at the time of the ray
 *           u     two numbers in 0..1
 * Result    false: it is not seen from there, or from its edge only
 * Formula   spheres by the solid angle of their cone, or all around from within; cards and the
 *           sides of boxes that are in front by their solid angle; discs and triangles by their
 *           area: pdf r^2/(A |cos|)
 * Source    [Shirley96] 2 and 3; [Urena13]
 */
bool emitter_sample(const struct scene_thing *thing, size_t part, const struct scene_pose *pose,
                    struct vector from, const double u[2], struct emitter_sample *ray);

/* The pdf of emitter_sample for a direction in which a ray met the emitter; 0 where it has none. */
double emitter_pdf(const struct scene_thing *thing, const struct scene_pose *pose,
                   struct vector from, const struct world_hit *hit, struct vector direction);

#endif
