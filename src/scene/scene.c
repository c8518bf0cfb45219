/* scene/scene.c - where things are while time passes. */
/* SPDX-License-Identifier: MIT */
#include "scene/scene.h"

static struct vector vector_rotated(struct vector a, struct vector axis, double cosine, double sine)
{
    const double along = (1 - cosine) * vector_dot(axis, a);
    const struct vector across = vector_along(vector_times(cosine, a), sine, vector_cross(axis, a));
    return vector_along(across, along, axis);
}

struct scene_pose scene_pose_at(const struct scene_place *place, double time)
{
    struct scene_pose pose = {vector_along(place->at, time, place->velocity), place->turned};
    if (place->spin != 0) {
        const double cosine = cos(place->spin * time), sine = sin(place->spin * time);
        pose.turned.x = vector_rotated(place->turned.x, place->axis, cosine, sine);
        pose.turned.y = vector_rotated(place->turned.y, place->axis, cosine, sine);
        pose.turned.z = vector_rotated(place->turned.z, place->axis, cosine, sine);
    }
    return pose;
}

bool scene_moves(const struct scene *scene)
{
    bool moves = scene_place_moves(&scene->camera.where);
    for (size_t i = 0; i < scene->thing_count && !moves; i++) {
        moves = scene_place_moves(&scene->things[i].where);
    }
    for (size_t i = 0; i < scene->light_count && !moves; i++) {
        const struct vector v = scene->lights[i].velocity;
        moves = v.x != 0 || v.y != 0 || v.z != 0;
    }
    return moves;
}
