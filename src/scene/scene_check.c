/* scene/scene_check.c - what a scene lacks where nothing of it can be seen. */
/* SPDX-License-Identifier: MIT */
#include "scene/scene_check.h"

static bool shines(const struct scene *scene, const struct scene_thing *thing)
{
    return thing->shines || (thing->material != SCENE_NONE &&
                             scene->materials[thing->material].emission.kind != SPECTRUM_NONE);
}

bool scene_reflects(const struct scene *scene, const struct scene_thing *thing)
{
    return thing->material == SCENE_NONE ? !thing->shines
                                         : scene->materials[thing->material].kind != MATERIAL_BLACK;
}

bool scene_check(const struct scene *scene, int bounces, struct error *error)
{
    bool is_seen = false, has_points = false, has_surface = false;
    for (size_t i = 0; i < scene->light_count; i++) {
        const bool is_point = scene->lights[i].kind == LIGHT_POINT;
        has_points = has_points || is_point;
        is_seen = is_seen || !is_point;
    }
    for (size_t i = 0; i < scene->thing_count; i++) {
        is_seen = is_seen || shines(scene, &scene->things[i]);
        has_surface = has_surface || scene_reflects(scene, &scene->things[i]);
    }
    if (is_seen || (has_points && has_surface && bounces > 0)) {
        return true;
    }
    if (!has_points) {
        fail(error, ERROR_DATA,
             "the scene has no light: a line 'light', or a material with luminance=");
    } else if (!has_surface) {
        fail(error, ERROR_DATA, "the light of points falls on nothing that would reflect it");
    } else {
        fail(error, ERROR_DATA,
             "points of light are not seen by themselves: without any bounce all is dark");
    }
    return error_locate(error, scene->source, 0, 0);
}
