/* scene/mesh.h - where rays meet triangles. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_MESH_H
#define LENSCALC_SCENE_MESH_H

#include "base/arena.h"
#include "scene/shape.h"

/* Read-only afterwards: threads and things share it. */
struct mesh {
    const struct scene_mesh *triangles;
    struct shape_box box;
    size_t degenerate; /* triangles without area, which no ray meets */
};

void mesh_open(const struct scene_mesh *triangles, struct arena *arena, struct mesh *mesh);

/*
 * Where does a ray first meet a mesh?
 *
 * Result    as of shape_meet; both sides count. Rays through an edge or a corner that triangles
 *           share meet one of them: a closed mesh is tight [Woop13]
 */
bool mesh_meet(const struct mesh *mesh, const struct shape_ray *ray, struct shape_meeting *meeting);

/* The surface where they met; outwards is where corners 0, 1, 2 go round against the clock. */
struct shape_spot mesh_spot(const struct mesh *mesh, const struct shape_meeting *meeting);

#endif
