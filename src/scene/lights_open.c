/* scene/lights_open.c - the lights of a scene, collected and made ready. */
/* SPDX-License-Identifier: MIT */
#include "scene/lights.h"

#define MM2_PER_M2 1e6

static bool open_arounds(struct lights *lights, struct arena *arena, struct error *error)
{
    const struct scene *scene = lights->scene;
    size_t count = 0;
    for (size_t i = 0; i < scene->light_count; i++) {
        count += light_around_is(&scene->lights[i]) ? 1 : 0;
    }
    lights->arounds = ARENA_ARRAY(arena, count, struct light_around);
    lights->around_below = ARENA_ARRAY(arena, count + 1, double);
    for (size_t i = 0; i < scene->light_count; i++) {
        struct light_around *around = &lights->arounds[lights->around_count];
        double *below = &lights->around_below[lights->around_count];
        if (!light_around_is(&scene->lights[i])) {
            continue;
        }
        if (!light_around_open(&scene->lights[i], lights->bands, arena, around, error)) {
            return false;
        }
        below[1] = below[0] + around->total;
        lights->around_count++;
    }
    return true;
}

static bool open_points(struct lights *lights, struct arena *arena, struct error *error)
{
    const struct scene *scene = lights->scene;
    lights->points = ARENA_ARRAY(arena, scene->light_count, const double *);
    for (size_t i = 0; i < scene->light_count; i++) {
        const struct scene_light *light = &scene->lights[i];
        if (light->kind == LIGHT_POINT) {
            double *unit = ARENA_ARRAY(arena, BANDS_MOST, double);
            if (!bands_of_light(lights->bands, &light->spectrum, unit, error)) {
                return error_locate(error, light->place.source, light->place.line,
                                    light->place.column);
            }
            lights->points[i] = unit;
        }
    }
    return true;
}

/* -------- things that shine -------- */

/* In the mean over it. */
static double luminance_of(const struct scene *scene, const struct scene_thing *thing)
{
    return thing->picture != NULL ? thing->luminance * thing->mean
                                  : scene->materials[thing->material].luminance;
}

static void open_planes(struct lights *lights, struct arena *arena)
{
    const struct scene *scene = lights->scene;
    lights->planes = ARENA_ARRAY(arena, scene->thing_count, size_t);
    lights->plane_below = ARENA_ARRAY(arena, scene->thing_count + 1, double);
    for (size_t i = 0; i < scene->thing_count; i++) {
        if (scene->things[i].shape == SHAPE_PLANE && materials_shines(&lights->materials, i)) {
            const size_t number = lights->plane_count++;
            lights->first[i] = number;
            lights->planes[number] = i;
            lights->plane_below[number + 1] =
                lights->plane_below[number] + luminance_of(scene, &scene->things[i]);
        }
    }
}

static bool is_lamp(const struct lights *lights, size_t thing)
{
    return lights->scene->things[thing].shape != SHAPE_PLANE &&
           materials_shines(&lights->materials, thing);
}

static size_t count_lamps(const struct lights *lights)
{
    const struct scene *scene = lights->scene;
    size_t count = 0;
    for (size_t i = 0; i < scene->thing_count; i++) {
        count += is_lamp(lights, i) ? lamp_parts(&scene->things[i]) : 0;
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        count += lights->points[i] != NULL ? 1 : 0;
    }
    return count;
}

static void open_lamps(struct lights *lights, struct arena *arena)
{
    const struct scene *scene = lights->scene;
    struct arena spare = arena_within(arena);
    const size_t room = count_lamps(lights);
    struct lamp *lamps = ARENA_ARRAY(&spare, room, struct lamp);
    double *power = ARENA_ARRAY(&spare, room, double);
    size_t count = 0;
    for (size_t i = 0; i < scene->thing_count; i++) {
        const struct scene_thing *thing = &scene->things[i];
        if (is_lamp(lights, i)) {
            const size_t parts = lamp_parts(thing);
            const double luminance = luminance_of(scene, thing);
            lights->first[i] = count;
            for (size_t part = 0; part < parts; part++, count++) {
                lamps[count] = (struct lamp){i, part};
                power[count] = luminance * lamp_bounds(scene, &lamps[count]).area;
            }
        }
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        if (lights->points[i] != NULL) {
            lamps[count] = (struct lamp){SCENE_NONE, i};
            power[count++] = scene->lights[i].amount * MM2_PER_M2;
        }
    }
    lamp_tree_open(scene, lamps, power, count, arena, &lights->lamps);
    arena_free(&spare);
}

bool lights_open(const struct scene *scene, const struct bands *bands, struct arena *arena,
                 struct lights *lights, struct error *error)
{
    *lights = (struct lights){.scene = scene, .bands = bands};
    if (!materials_open(scene, bands, arena, &lights->materials, error) ||
        !light_discs_open(scene, bands, arena, &lights->discs, error) ||
        !open_arounds(lights, arena, error) || !open_points(lights, arena, error)) {
        return false;
    }
    lights->first = ARENA_ARRAY(arena, scene->thing_count, size_t);
    for (size_t i = 0; i < scene->thing_count; i++) {
        lights->first[i] = SCENE_NONE;
    }
    open_planes(lights, arena);
    open_lamps(lights, arena);
    return true;
}
