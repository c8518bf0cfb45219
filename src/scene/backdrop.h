/* scene/backdrop.h - uniform background: where rays of a cone meet nothing but one even light. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_BACKDROP_H
#define LENSCALC_SCENE_BACKDROP_H

#include "scene/lights.h"
#include "scene/world.h"

#include <stdbool.h>

/* Rays that begin in a ball and stay within a cone about one direction. */
struct backdrop_rays {
    struct vector center;    /* the middle of the ball, mm */
    double radius;           /* mm */
    struct vector direction; /* of length 1 */
    double angle;            /* rad, less than a right one */
};

/* Read-only: threads share it. */
struct backdrop {
    const struct world *world;
    const struct lights *lights;
    bool is_dark;   /* nothing but suns and stars shines behind everything */
    bool has_views; /* pictures all around, not of one colour: it is never even */
};

struct backdrop backdrop_open(const struct world *world, const struct lights *lights);

/*
 * Do all of these rays, at any time of the world's span, go past everything to the same light?
 *
 * Result    light  it, in the lanes. False also where that is so, but not easily seen
 * Formula   none meets the ball about a box of the world's tree, as seen from the middle with the
 *           radii of both together; nor a plane, from which the ball is away and all go on; and no
 *           sun or star, nor the horizon of a sky, lies within the cone
 */
bool backdrop_is_uniform(const struct backdrop *backdrop, const struct backdrop_rays *rays,
                         const struct lanes *lanes, struct radiance *light);

#endif
