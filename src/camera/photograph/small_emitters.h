/* camera/photograph/small_emitters.h - lights that few rays meet, and tiles that may see them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_PHOTOGRAPH_SMALL_EMITTERS_H
#define LENSCALC_CAMERA_PHOTOGRAPH_SMALL_EMITTERS_H

#include "camera/photograph/tile_rays.h"

struct small_light {
    struct vector way; /* to its middle, from the camera's place */
    double angle;      /* from there to its edge, rad */
    double size;       /* sr */
};

struct small_emitters {
    const struct small_light *all;
    size_t count;
};

/*
 * What shines in a scene and may be small, at rest before a camera at rest: suns, stars and things;
 * no meshes of several triangles, whose light is in many places, and nothing if there are very
 * many.
 */
struct small_emitters small_emitters_open(const struct view *view, struct arena *arena);

/*
 * Rays a pixel by which a tile meets the lights in its sight some eight times each.
 *
 * Given     plan  of the tile
 * Formula   8 (pixel/light) in solid angles. In sight is what lies within the cone about the rays
 *           through the middle of the pupil from the tile's corners, and a tenth around: what is
 *           blurred beyond that has more rays
 * Result    0: none is small
 */
double small_emitters_samples(const struct small_emitters *lights, const struct tile_rays *rays,
                              const struct film_plan *plan, struct tile_scratch *scratch);

#endif
