/* tests/unit/test_backdrop.c - where nothing stands before a background that is even. */
/* SPDX-License-Identifier: MIT */
#include "scene/backdrop.h"

#include "looked.h"

static struct scene_material materials[] = {
    {.name = "ground", .kind = MATERIAL_LAMBERT, .colour = LOOKED_GREY(0.5)}};
static struct scene_thing ball = {
    .shape = SHAPE_SPHERE, .radius = 10, .where = LOOKED_PLACE(LOOKED_UPRIGHT, 0, 0, -100)};
static struct scene_thing ground = {.shape = SHAPE_PLANE,
                                    .where = LOOKED_PLACE(LOOKED_LEVEL, 0, -50, 0)};

/* Do rays from a ball of 1 mm, within 5 degrees of a way so far above -z, see one light? */
static bool is_even(struct scene_thing *thing, struct scene_light *light, double degrees,
                    double *luminance)
{
    const struct scene scene = {.materials = materials,
                                .material_count = 1,
                                .things = thing,
                                .thing_count = thing != NULL,
                                .lights = light,
                                .light_count = light != NULL};
    const struct lanes lanes = {3, {0, 1, 2}};
    const double up = degrees * PI / 180;
    struct radiance radiance = {{0}};
    struct looked looked;
    looked_open(&scene, 0, &looked);
    const struct backdrop backdrop = backdrop_open(&looked.world, &looked.lights);
    const struct backdrop_rays rays = {
        .radius = 1, .direction = {0, sin(up), -cos(up)}, .angle = 5 * PI / 180};
    const bool even = backdrop_is_uniform(&backdrop, &rays, &lanes, &radiance);
    *luminance = radiance.of[1];
    arena_free(&looked.arena);
    return even;
}

static void test_things(void)
{
    double found;
    /* the ball and the rays' own, of 11 mm together, are seen within 6.3 degrees */
    CHECK(!is_even(&ball, NULL, 0, &found));
    CHECK(!is_even(&ball, NULL, 11.2, &found) && !is_even(&ball, NULL, -11.2, &found));
    CHECK(is_even(&ball, NULL, 20, &found) && found == 0);
    CHECK(is_even(&ball, NULL, 180, &found));
    struct scene_thing moving = ball;
    moving.where.velocity = (struct vector){0, 30, 0}; /* 1 s before and after */
    CHECK(!is_even(&moving, NULL, 20, &found) && is_even(&moving, NULL, 60, &found));
    /* a camera within it */
    struct scene_thing around = ball;
    around.where.at.z = -9;
    CHECK(!is_even(&around, NULL, 180, &found));
    /* rays that go up by themselves never come to the ground */
    CHECK(is_even(&ground, NULL, 5.1, &found) && !is_even(&ground, NULL, 4.9, &found));
    CHECK(!is_even(&ground, NULL, -30, &found));
    ground.where.at.y = 0.5; /* within the ball that they start from */
    CHECK(!is_even(&ground, NULL, 60, &found) && !is_even(&ground, NULL, -60, &found));
    ground.where.at.y = 50;
    CHECK(is_even(&ground, NULL, -5.1, &found) && !is_even(&ground, NULL, 60, &found));
}

static void test_light(void)
{
    double found;
    struct scene_light sky = {
        .kind = LIGHT_SKY, .spectrum = LOOKED_GREY(1), .amount = 700, .direction = {0, 1, 0}};
    CHECK(is_even(NULL, &sky, 5.1, &found));
    CHECK_RELATIVE(found, 700.0, 1e-12, "the sky");
    CHECK(!is_even(NULL, &sky, 4.9, &found) && !is_even(NULL, &sky, -4.9, &found));
    CHECK(is_even(NULL, &sky, -5.1, &found) && found == 0);
    CHECK(is_even(NULL, &sky, 174.9, &found) && found > 0);
    sky.sky = SKY_OVERCAST;
    CHECK(!is_even(NULL, &sky, 45, &found) && is_even(NULL, &sky, -45, &found) && found == 0);

    struct scene_light sun = {.kind = LIGHT_SUN,
                              .spectrum = LOOKED_GREY(1),
                              .amount = 1e5,
                              .direction = {0, 0, -1},
                              .diameter = 2 * PI / 180};
    CHECK(!is_even(NULL, &sun, 5.9, &found) && is_even(NULL, &sun, 6.1, &found) && found == 0);
    struct scene_light point = {
        .kind = LIGHT_POINT, .spectrum = LOOKED_GREY(1), .amount = 1, .at = {0, 0, -50}};
    CHECK(is_even(NULL, &point, 0, &found) && found == 0);

    float pixels[] = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
    const struct image picture = {.width = 2, .height = 1, .channels = 3, .pixels = pixels};
    struct scene_light view = {
        .kind = LIGHT_ENVIRONMENT, .spectrum = LOOKED_GREY(1), .amount = 800, .picture = &picture};
    CHECK(is_even(NULL, &view, 0, &found));
    CHECK_RELATIVE(found, 400.0, 1e-6, "all around");
    pixels[4] = 0.4f;
    CHECK(!is_even(NULL, &view, 0, &found));
}

/* Does nothing but what shines from one way stand behind everything? */
static void test_dark(void)
{
    static float pixel[] = {0, 0, 0};
    static const struct image black = {.width = 1, .height = 1, .channels = 3, .pixels = pixel};
    struct scene_light lights[] = {
        {.kind = LIGHT_POINT, .spectrum = LOOKED_GREY(1), .amount = 1, .at = {0, 0, -50}},
        {.kind = LIGHT_SUN,
         .spectrum = LOOKED_GREY(1),
         .amount = 1e5,
         .direction = {0, 0, -1},
         .diameter = 0.01},
        {.kind = LIGHT_SKY, .spectrum = LOOKED_GREY(1), .amount = 700, .direction = {0, 1, 0}},
        {.kind = LIGHT_ENVIRONMENT, .spectrum = LOOKED_GREY(1), .amount = 1, .picture = &black},
    };
    const bool expected[] = {true, true, false, false};
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        const struct scene scene = {.lights = &lights[i], .light_count = 1};
        struct looked looked;
        looked_open(&scene, 0, &looked);
        CHECK(backdrop_open(&looked.world, &looked.lights).is_dark == expected[i]);
        arena_free(&looked.arena);
    }
}

int main(void)
{
    test_things();
    test_light();
    test_dark();
    return check_report();
}
