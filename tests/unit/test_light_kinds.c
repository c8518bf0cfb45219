/* tests/unit/test_light_kinds.c - how often a ray goes to each kind of light. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "light_stage.h"
#include "scene/sky.h"

/* The chance of all of a kind beside the sun's, from the half of it that is even: of/all. */
static double part_of(double chance)
{
    return (chance - 0.25) / (0.75 - chance);
}

/*
 * Which of two kinds of light a ray goes to: half of its chance is even, half as the light of each,
 * luminance times solid angle. A sky and the sun, a plane without end and the sun: the chance is
 * the density of a direction away from the sun over that without it.
 */
static void test_kinds(void)
{
    static const double suns[] = {0, 1, 40, 1000, 1e9}, luminances[] = {1, 7, 500};
    const struct vector from = {0, 0, 0}, aside = {0.6, 0.8, 0};
    for (size_t i = 0; i < 15; i++) {
        const double amount = suns[i / 3], luminance = luminances[i % 3];
        struct scene_light lights[] = {{.kind = LIGHT_SUN,
                                        .spectrum = spectrum_white(),
                                        .direction = {0, 1, 0},
                                        .diameter = 0.01,
                                        .amount = amount},
                                       {.kind = LIGHT_SKY,
                                        .spectrum = spectrum_white(),
                                        .sky = SKY_UNIFORM,
                                        .amount = luminance}};
        struct scene_thing plane = {.shape = SHAPE_PLANE, .where = lying(0, 5, 0)};
        struct stage stage;
        stage_open(&stage, NULL, 0, lights, 2);
        const double sky = lights_pdf(&stage.lights, from, aside, 0, NULL);
        const double alone = environment_light_pdf(&stage.lights.environments[0], aside);
        arena_free(&stage.arena);
        stage_open(&stage, &plane, 1, lights, 1);
        struct world_hit hit;
        const struct world_ray ray = {from, aside, 0, (double)INFINITY};
        CHECK(world_intersect(&stage.world, &ray, &hit));
        const double flat = lights_pdf(&stage.lights, from, aside, 0, &hit);
        arena_free(&stage.arena);
        if (amount == 0) {
            CHECK_RELATIVE(sky, alone, 1e-12, "a sky alone");
            CHECK_RELATIVE(flat, 1 / (2 * PI), 1e-12, "a plane alone");
        } else {
            CHECK_RELATIVE(part_of(sky / alone), 2 * PI * luminance / amount, 1e-6, "a sky");
            CHECK_RELATIVE(part_of(flat * 2 * PI), 2 * PI * 100 / amount, 1e-6, "a plane");
        }
    }
}

int main(void)
{
    test_kinds();
    return check_report();
}
