/* tests/unit/light_stage.h - scenes of a few lights. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_LIGHT_STAGE_H
#define LENSCALC_TESTS_UNIT_LIGHT_STAGE_H

#include "check.h"
#include "light/illuminant.h"
#include "scene/lights.h"

static struct scene_place upright(double x, double y, double z)
{
    return (struct scene_place){
        .at = {x, y, z}, .turned = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, .axis = {0, 1, 0}};
}

/* Turned so that its z is the scene's y: what lies in x and y of its own lies flat. */
static struct scene_place lying(double x, double y, double z)
{
    struct scene_place place = upright(x, y, z);
    place.turned = (struct frame){{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    return place;
}

static struct scene_material lamp_material(double luminance)
{
    return (struct scene_material){.kind = MATERIAL_BLACK,
                                   .colour = {.kind = SPECTRUM_RGB},
                                   .emission = spectrum_white(),
                                   .luminance = luminance};
}

/* A scene with its lights and its world made ready. */
struct stage {
    struct arena arena;
    struct bands bands;
    struct scene scene;
    struct scene_material material;
    struct world world;
    struct lights lights;
    struct lanes lanes;
};

static void stage_open(struct stage *stage, struct scene_thing *things, size_t thing_count,
                       struct scene_light *lights, size_t light_count)
{
    static const double span[2] = {-1, 1};
    struct error error;
    *stage = (struct stage){.material = lamp_material(100), .lanes = {3, {0, 1, 2}}};
    stage->scene = (struct scene){.materials = &stage->material,
                                  .material_count = 1,
                                  .things = things,
                                  .thing_count = thing_count,
                                  .lights = lights,
                                  .light_count = light_count};
    bands_three(&stage->bands);
    CHECK(world_open(&stage->scene, span, &stage->arena, &stage->world, &error));
    CHECK(lights_open(&stage->scene, &stage->bands, &stage->arena, &stage->lights, &error));
}

#endif
