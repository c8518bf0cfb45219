/* tests/unit/test_path_sky.c - sun, sky, points and pictures all around, on surfaces. */
/* SPDX-License-Identifier: MIT */
#include "scene/path.h"

#include "looked.h"

#define RHO 0.6

enum { GROUND, WHITE_GLOSSY, LAMP };
static struct scene_material materials[] = {
    [GROUND] = {.name = "ground", .kind = MATERIAL_LAMBERT, .colour = LOOKED_GREY(RHO)},
    [WHITE_GLOSSY] = {.name = "white",
                      .kind = MATERIAL_GLOSSY,
                      .colour = LOOKED_GREY(1),
                      .roughness = 0.2,
                      .index = 1.5},
    [LAMP] = {.name = "lamp", .kind = MATERIAL_BLACK, .emission = LOOKED_GREY(1), .luminance = 300},
};
static struct scene_thing ground[] = {
    {.shape = SHAPE_PLANE, .where = LOOKED_PLACE(LOOKED_LEVEL, 0, 0, 0), .material = GROUND}};

static struct scene scene_of(struct scene_light *lights, size_t count)
{
    return (struct scene){.materials = materials,
                          .material_count = sizeof materials / sizeof *materials,
                          .things = ground,
                          .thing_count = 1,
                          .lights = lights,
                          .light_count = count};
}

static const struct vector eye = {-30, 20, 15};

/* What the ground at the origin sends to the eye. */
static void check_ground(struct scene_light *lights, size_t count, double irradiance,
                         const char *what)
{
    struct scene scene = scene_of(lights, count);
    struct looked looked;
    const struct world_ray ray = looked_ray(eye, (struct vector){0, 0, 0});
    looked_open(&scene, 1, &looked);
    looked_check(&looked, &ray, 512, RHO * irradiance / PI, what);
    arena_free(&looked.arena);
}

static double once(struct scene_light *lights, size_t count, struct vector from, struct vector way)
{
    struct scene scene = scene_of(lights, count);
    struct looked looked;
    const struct world_ray ray = looked_ray(from, vector_along(from, 1, way));
    looked_open(&scene, 1, &looked);
    const double found = looked_once(&looked, &ray, 0, 0);
    arena_free(&looked.arena);
    return found;
}

#define SUN_HEIGHT 0.6 /* sine */
static const struct vector sunwards = {0.8, SUN_HEIGHT, 0};
#define SUN(wide)                                                                                  \
    {                                                                                              \
        .kind = LIGHT_SUN, .spectrum = LOOKED_GREY(1), .direction = sunwards, .diameter = (wide),  \
        .amount = 1e5                                                                              \
    }
#define SKY                                                                                        \
    {                                                                                              \
        .kind = LIGHT_SKY, .spectrum = LOOKED_GREY(1), .sky = SKY_UNIFORM, .direction = sunwards,  \
        .amount = 5000                                                                             \
    }

static void test_sun_and_sky(void)
{
    struct scene_light lights[] = {SUN(0.0093), SKY};
    check_ground(lights, 1, 1e5 * SUN_HEIGHT, "sun");
    check_ground(lights + 1, 1, PI * 5000, "sky");
    check_ground(lights, 2, 1e5 * SUN_HEIGHT + PI * 5000, "sun and sky");
    struct scene_light wide[] = {SUN(0.5)};
    check_ground(wide, 1, 1e5 * SUN_HEIGHT, "a sun of 29 degrees");
    /* the disc itself: E = pi L sin^2 */
    const double seen = once(wide, 1, eye, sunwards), angle = 0.25;
    CHECK_RELATIVE(seen, 1e5 / (PI * sin(angle) * sin(angle)), 1e-9, "the sun");
    CHECK_RELATIVE(once(lights + 1, 1, eye, (struct vector){0, 1, 0}), 5000.0, 1e-9, "the zenith");
    CHECK_RELATIVE(once(lights + 1, 1, eye, (struct vector){1, 0.01, 0}), 5000.0, 1e-9, "low");
    CHECK(once(lights + 1, 1, (struct vector){0, -5, 0}, (struct vector){1, -0.01, 0}) == 0);
}

/* CIE's overcast sky, (1 + 4 e^(-0.7/sin h))/(1 + 4 e^-0.7) of its zenith, on the ground. */
static void test_overcast(void)
{
    enum { STEPS = 2000 };
    struct scene_light lights[] = {SKY};
    double sum = 0;
    lights->sky = SKY_OVERCAST;
    for (int i = 0; i < STEPS; i++) {
        const double sine = (i + 0.5) / STEPS;
        sum += 2 * PI * sine * (1 + 4 * exp(-0.7 / sine)) / STEPS;
    }
    check_ground(lights, 1, 5000 * sum / (1 + 4 * exp(-0.7)), "an overcast sky");
}

static void test_sampler(void)
{
    struct scene_light lights[] = {{.kind = LIGHT_POINT,
                                    .spectrum = LOOKED_GREY(1),
                                    .at = {300, 400, 0},
                                    .velocity = {0, 100, 0},
                                    .amount = 20}};
    /* I cos/d^2, d in metres */
    check_ground(lights, 1, 20 * 0.8 / 0.25, "a point");
    struct scene scene = scene_of(lights, 1);
    struct looked looked;
    struct world_ray ray = looked_ray(eye, (struct vector){0, 0, 0});
    looked_open(&scene, 1, &looked);
    ray.time = 1; /* 500 mm high */
    looked_check(&looked, &ray, 8, RHO / PI * 20 * 0.5 / pow(0.34, 1.5), "it has moved");
    arena_free(&looked.arena);
}

static void test_star(void)
{
    struct scene_light lights[] = {{.kind = LIGHT_STAR,
                                    .spectrum = LOOKED_GREY(1),
                                    .direction = sunwards,
                                    .diameter = 0.00029,
                                    .amount = 1e-6}};
    check_ground(lights, 1, 1e-6 * SUN_HEIGHT, "a star");
}

/* White above and black below; then white in one eighth of the whole, at x, y, z > 0. */
static void test_environment(void)
{
    enum { W = 64, H = 32 };
    static float pixels[W * H][3];
    struct image image = {.width = W, .height = H, .channels = 3, .pixels = pixels[0]};
    struct scene_light lights[] = {
        {.kind = LIGHT_ENVIRONMENT, .spectrum = LOOKED_GREY(1), .picture = &image, .amount = 70}};
    for (int i = 0; i < W * H; i++) {
        pixels[i][0] = pixels[i][1] = pixels[i][2] = 1;
    }
    check_ground(lights, 1, PI * 70, "white all around");
    /* longitude 90 to 180 degrees to the right of z = -1: x > 0 and z > 0 */
    for (int i = 0; i < W * H; i++) {
        const float light = i % W >= W * 3 / 4 && i / W < H / 2 ? 1 : 0;
        pixels[i][0] = pixels[i][1] = pixels[i][2] = light;
    }
    check_ground(lights, 1, PI * 70 / 4, "a quarter of the sky");
    CHECK_RELATIVE(once(lights, 1, eye, (struct vector){1, 1, 1}), 70.0, 1e-6, "there");
    CHECK(once(lights, 1, eye, (struct vector){1, 1, -1}) == 0);
    CHECK(once(lights, 1, eye, (struct vector){-1, 1, 1}) == 0);
    lights->turn = PI / 2;
    check_ground(lights, 1, PI * 70 / 4, "turned");
}

/* White gloss on all sides of a white sky: no light is lost, none is made. */
static void test_glossy(void)
{
    float pixel[] = {1, 1, 1};
    struct image image = {.width = 1, .height = 1, .channels = 3, .pixels = pixel};
    struct scene_light lights[] = {
        {.kind = LIGHT_ENVIRONMENT, .spectrum = LOOKED_GREY(1), .picture = &image, .amount = 70}};
    struct scene scene = scene_of(lights, 1);
    struct looked looked;
    ground->material = WHITE_GLOSSY;
    looked_open(&scene, 1, &looked);
    for (int i = 1; i < 5; i++) {
        const struct world_ray ray =
            looked_ray((struct vector){10 * i, 40 / i, 0}, (struct vector){0, 0, 0});
        looked_check(&looked, &ray, 1024, 70, "a white furnace");
    }
    arena_free(&looked.arena);
    ground->material = GROUND;
}

/* What moves is where it is at the time of the ray. */
static void test_motion(void)
{
    struct scene_thing things[] = {
        ground[0],
        {.shape = SHAPE_DISC,
         .where = {.at = {0, 100, 0}, .turned = LOOKED_DOWN, .velocity = {0, 50, 0}},
         .radius = 40,
         .material = LAMP}};
    struct scene scene = scene_of(NULL, 0);
    struct looked looked;
    struct world_ray ray = looked_ray(eye, (struct vector){0, 0, 0});
    scene.things = things;
    scene.thing_count = 2;
    looked_open(&scene, 1, &looked);
    for (int i = -1; i <= 1; i++) {
        const double h = 100 + 50 * i;
        ray.time = i;
        looked_check(&looked, &ray, 512, RHO * 300 * 1600 / (1600 + h * h), "a lamp that moves");
    }
    arena_free(&looked.arena);
}

/* How the error falls with the number of rays: faster than by chance, with the power -1/2. */
static void test_slope(void)
{
    struct scene_light lights[] = {SUN(0.5), SKY};
    struct scene scene = scene_of(lights, 2);
    struct looked looked;
    const struct world_ray ray = looked_ray(eye, (struct vector){0, 0, 0});
    looked_open(&scene, 1, &looked);
    const double few = looked_mean(&looked, &ray, 16).sigma;
    const double many = looked_mean(&looked, &ray, 1024).sigma;

    CHECK(log(many / few) / log(64) <= -0.7);
    arena_free(&looked.arena);
}

int main(void)
{
    test_sun_and_sky();
    test_overcast();
    test_sampler();
    test_star();
    test_environment();
    test_glossy();
    test_motion();
    test_slope();
    return check_report();
}
