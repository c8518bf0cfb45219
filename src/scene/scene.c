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

bool scene_reflects(const struct scene *scene, const struct scene_thing *thing)
{
    return thing->material == SCENE_NONE ? !thing->shines
                                         : scene->materials[thing->material].kind != MATERIAL_BLACK;
}

/* What a scene has, seen by itself or not. */
struct scene_light_content {
    bool seen, points, black, surface;
};

static struct scene_light_content look_over(const struct scene *scene)
{
    struct scene_light_content has = {false, false, false, false};
    for (size_t i = 0; i < scene->light_count; i++) {
        const struct scene_light *light = &scene->lights[i];
        const bool is_point = light->kind == LIGHT_POINT;
        const bool is_black = light->kind == LIGHT_ENVIRONMENT && !(light->mean > 0);
        has.points = has.points || is_point;
        has.black = has.black || is_black;
        has.seen = has.seen || !(is_point || is_black);
    }
    for (size_t i = 0; i < scene->thing_count; i++) {
        const struct scene_thing *thing = &scene->things[i];
        has.seen = has.seen || ((thing->shines && thing->mean > 0) ||
                                (thing->material != SCENE_NONE &&
                                 scene->materials[thing->material].emission.kind != SPECTRUM_NONE));
        has.black = has.black || thing->shines;
        has.surface = has.surface || scene_reflects(scene, thing);
    }
    return has;
}

bool scene_check(const struct scene *scene, int bounces, struct error *error)
{
    const struct scene_light_content has = look_over(scene);
    if (has.seen || (has.points && has.surface && bounces > 0)) {
        return true;
    }
    if (!has.points && has.black) {
        fail(error, ERROR_DATA, "the scene has no light: the pictures that would shine are black");
    } else if (!has.points) {
        fail(error, ERROR_DATA,
             "the scene has no light: a line 'light', or a material with luminance=");
    } else if (!has.surface) {
        fail(error, ERROR_DATA, "the light of points falls on nothing that would reflect it");
    } else {
        fail(error, ERROR_DATA,
             "points of light are not seen by themselves: without any bounce all is dark");
    }
    return error_locate(error, scene->source, 0, 0);
}
