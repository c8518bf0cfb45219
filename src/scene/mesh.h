/* scene/mesh.h - intersections of rays with triangle meshes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_MESH_H
#define LENSCALC_SCENE_MESH_H

#include "base/arena.h"
#include "scene/bvh.h"
#include "scene/shape.h"

/* As the tree's leaves have it. */
struct mesh_triangle {
    uint32_t corner[3], number;
};

/* Read-only afterwards: threads and things share it. */
struct mesh {
    const struct scene_mesh *triangles;
    struct shape_box box;
    struct bvh tree;
    const struct mesh_triangle *leaves;
    size_t degenerate; /* triangles without area, which no ray meets */
};

/*
 * Make a mesh ready.
 *
 * Given     triangles  numbers of corners that there are, coordinates within BVH_REACH; fewer than
 *                      2^32 of both
 */
void mesh_open(const struct scene_mesh *triangles, struct arena *arena, struct mesh *mesh);

/*
 * The nearest intersection of a ray with a mesh.
 *
 * Given     is_any  any meeting will do, it need not be the first
 * Result    as of shape_meet; both sides count. Rays through an edge or a corner that triangles
 *           share meet one of them: a closed mesh is tight
 * Formula   corners sheared so that the ray is the z axis, and the signs of the edges about it: of
 *           two triangles that share an edge both get the same numbers with opposite signs, and a
 *           difference of rounded products may be 0, which is inside, but never has the wrong sign
 *           [Woop13]. Distances within their own rounding error from 0 are none [Pharr23]
 */
bool mesh_intersect(const struct mesh *mesh, const struct shape_ray *ray, bool is_any,
                    struct shape_hit *meeting);

/*
 * The surface where they met; outwards is where corners 0, 1, 2 go round against the clock, also
 * where normals of the corners point inwards.
 */
struct shape_surface mesh_surface(const struct mesh *mesh, const struct shape_hit *meeting);

#endif
