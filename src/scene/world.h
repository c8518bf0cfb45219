/* scene/world.h - scene geometry made ready for rays: intersection and occlusion. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_WORLD_H
#define LENSCALC_SCENE_WORLD_H

#include "base/arena.h"
#include "base/error.h"
#include "scene/bvh.h"
#include "scene/mesh.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>

struct world_ray {
    struct vector origin, direction; /* of length 1 */
    double time;                     /* s, within the world's span */
    double farthest;                 /* mm; INFINITY */
};

/* The nearest intersection of a ray. */
struct world_hit {
    double distance;      /* mm */
    struct vector at;     /* on it, mm */
    struct vector normal; /* of length 1, towards the side that the ray came from; smooth */
    struct vector face;   /* the same of the surface itself */
    bool is_back;         /* the ray came from behind a flat thing, or from within another */
    size_t thing;         /* of the scene */
    size_t triangle;      /* of a mesh */
    double place[2];      /* in a texture, from the left and from below, 0 to 1 */
    double slack;         /* mm: how far from the surface `at` may lie at most, see world_leave */
};

/* A thing of the scene, where it is at the time 0 or always. */
struct world_thing {
    const struct scene_thing *thing;
    const struct mesh *mesh; /* null: of none */
    struct scene_pose pose;
    bool moves;
};

/* Read-only afterwards: threads share it. */
struct world {
    const struct scene *scene;
    double span[2]; /* s */
    struct world_thing *things;
    struct bvh tree;         /* of all things but planes */
    const uint32_t *bounded; /* its items: which things they are */
    const uint32_t *endless; /* planes */
    size_t endless_count;
    size_t degenerate; /* triangles without area, which no ray meets */
};

/*
 * Make a scene ready.
 *
 * Given     scene  as scene.h has it: its promises are the caller's, also those on lengths, axes
 *                  and numbers of corners
 *           span   times of all rays, from .. to, s
 * Errors    ERROR_DOMAIN: a thing reaches farther from the middle than WORLD_REACH, with its place;
 *           more things than WORLD_MOST, or triangles or corners of a mesh
 */
bool world_open(const struct scene *scene, const double span[2], struct arena *arena,
                struct world *world, struct error *error);

#define WORLD_REACH 1e30 /* mm */
#define WORLD_MOST  4294967295U

/* The nearest intersection; false: the ray meets nothing. */
bool world_intersect(const struct world *world, const struct world_ray *ray, struct world_hit *hit);

/* Is nothing on the ray up to its farthest? */
bool world_is_unoccluded(const struct world *world, const struct world_ray *ray);

/*
 * The nearest thing that is all around a place: a box, say, that somebody stands in.
 *
 * Given     time   s
 * Result    false: there is none, a gap in it that one of 256 directions has found, or sixteen
 *           other surfaces before it
 */
bool world_encloses(const struct world *world, struct vector at, double time, size_t *thing);

/*
 * Where a ray starts that leaves a surface to the side of its face: it doesn't meet that surface
 * where it left it.
 *
 * Formula   with u = 2^-53 and |.| the sum of a vector's parts: the point is computed on the
 *           surface in the thing's own frame within 4 u |local|; turned out, moved, set off, and
 *           turned back for the next ray it takes up 9 u |local|, 2 u |world|, and 16 u |local|
 *           that the frame's axes lack in length and squareness: less than 32 u (|local| + |world|)
 *           along each axis, sqrt(3) times that along the normal; `slack` is 128 u
 */
static inline struct vector world_ray_origin(const struct world_hit *hit)
{
    return vector_along(hit->at, hit->slack, hit->face);
}

#endif
