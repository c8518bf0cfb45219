/* scene/lights_open.c - the lights of a scene, collected and made ready. */
/* SPDX-License-Identifier: MIT */
#include "scene/lights.h"

#include "base/constants.h"

static bool open_units(struct lights *lights, struct spectra *spectra, struct error *error)
{
    const struct scene *scene = lights->scene;
    lights->units = ARENA_ARRAY(spectra->arena, scene->light_count, const struct banded *);
    for (size_t i = 0; i < scene->light_count; i++) {
        const struct scene_light *light = &scene->lights[i];
        if (light->amount > 0) {
            lights->units[i] = spectra_light(spectra, &light->spectrum, &light->place, error);
            if (lights->units[i] == NULL) {
                return false;
            }
        }
    }
    return true;
}

static void open_arounds(struct lights *lights, struct arena *arena)
{
    const struct scene *scene = lights->scene;
    size_t count = 0;
    for (size_t i = 0; i < scene->light_count; i++) {
        count += is_environment_light(&scene->lights[i]) ? 1 : 0;
    }
    lights->environments = ARENA_ARRAY(arena, count, struct environment_light);
    lights->environment_below = ARENA_ARRAY(arena, count + 1, double);
    for (size_t i = 0; i < scene->light_count; i++) {
        struct environment_light *around = &lights->environments[lights->environment_count];
        double *below = &lights->environment_below[lights->environment_count];
        if (is_environment_light(&scene->lights[i])) {
            *around = environment_light_open(&scene->lights[i], lights->units[i], arena);
            below[1] = below[0] + around->total;
            lights->environment_count++;
        }
    }
}

/* -------- things that shine -------- */

/* In the mean over it. */
static double thing_luminance(const struct scene *scene, const struct scene_thing *thing)
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
                lights->plane_below[number] + thing_luminance(scene, &scene->things[i]);
        }
    }
}

static bool is_emitter(const struct lights *lights, size_t thing)
{
    return lights->scene->things[thing].shape != SHAPE_PLANE &&
           materials_shines(&lights->materials, thing);
}

/* Points that give no light are none. */
static bool is_point(const struct lights *lights, size_t light)
{
    return lights->scene->lights[light].kind == LIGHT_POINT && lights->units[light] != NULL;
}

static void open_emitters(struct lights *lights, struct arena *arena)
{
    const struct scene *scene = lights->scene;
    struct arena spare = arena_within(arena);
    size_t room = 0, count = 0;
    for (size_t i = 0; i < scene->thing_count; i++) {
        room += is_emitter(lights, i) ? emitter_parts(&scene->things[i]) : 0;
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        room += is_point(lights, i);
    }
    struct emitter *emitters = ARENA_ARRAY(&spare, room, struct emitter);
    double *power = ARENA_ARRAY(&spare, room, double);
    for (size_t i = 0; i < scene->thing_count; i++) {
        const struct scene_thing *thing = &scene->things[i];
        if (is_emitter(lights, i)) {
            const size_t parts = emitter_parts(thing);
            const double luminance = thing_luminance(scene, thing);
            lights->first[i] = count;
            for (size_t part = 0; part < parts; part++, count++) {
                emitters[count] = (struct emitter){i, part};
                power[count] = luminance * emitter_bounds(scene, &emitters[count]).area;
            }
        }
    }
    for (size_t i = 0; i < scene->light_count; i++) {
        if (is_point(lights, i)) {
            emitters[count] = (struct emitter){SCENE_NONE, i};
            power[count++] = scene->lights[i].amount * MM2_PER_M2;
        }
    }
    light_tree_open(scene, emitters, power, count, arena, &lights->tree);
    arena_free(&spare);
}

bool lights_open(const struct scene *scene, const struct bands *bands, struct arena *arena,
                 struct lights *lights, struct error *error)
{
    struct spectra spectra = {.bands = bands, .arena = arena};
    *lights = (struct lights){.scene = scene, .bands = bands};
    if (!materials_open(scene, &spectra, &lights->materials, error) ||
        !open_units(lights, &spectra, error)) {
        return false;
    }
    distant_lights_open(scene, lights->units, arena, &lights->distant);
    open_arounds(lights, arena);
    lights->first = ARENA_ARRAY(arena, scene->thing_count, size_t);
    for (size_t i = 0; i < scene->thing_count; i++) {
        lights->first[i] = SCENE_NONE;
    }
    open_planes(lights, arena);
    open_emitters(lights, arena);
    return true;
}
