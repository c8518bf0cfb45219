/* tests/unit/test_lights.c - rays to lights: irradiances in closed form, densities that make 1. */
/* SPDX-License-Identifier: MIT */
#include "base/constants.h"
#include "base/sobol.h"
#include "check.h"
#include "light/illuminant.h"
#include "light_stage.h"
#include "scene/sky.h"

enum { POINTS = 1 << 14 };

/* Three numbers of point i, scrambled. */
static struct sobol dimensions[3];

static void point(uint32_t i, double u[3])
{
    for (uint32_t k = 0; k < 3; k++) {
        u[k] = sobol_point(&dimensions[k], sobol_scrambling(7, 0, k), i);
    }
}

static double luminance(const struct radiance *light)
{
    return 0.2126 * light->of[0] + 0.7152 * light->of[1] + 0.0722 * light->of[2];
}

/* Illuminance of a plane, lx: the mean of samples; things hide one another as they do for rays. */
static double illuminance(const struct stage *stage, struct vector from, struct vector normal,
                          double time)
{
    double sum = 0;
    for (uint32_t i = 0; i < POINTS; i++) {
        double u[3];
        struct light_sample sample;
        point(i, u);
        if (lights_sample(&stage->lights, from, time, u, &stage->lanes, &sample)) {
            const struct world_ray ray = {from, sample.direction, time,
                                          sample.distance * (1 - 1e-9)};
            const double cosine = vector_dot(sample.direction, normal);
            sum += cosine > 0 && world_is_unoccluded(&stage->world, &ray)
                       ? luminance(&sample.light) * cosine / sample.pdf
                       : 0;
        }
    }
    return sum / POINTS;
}

/* The same by ways all around, as likely as each other, and what rays meet there. */
static double met_illuminance(const struct stage *stage, struct vector from, struct vector normal)
{
    double sum = 0;
    for (uint32_t i = 0; i < POINTS; i++) {
        double u[3];
        struct world_hit hit;
        struct radiance light = {{0}};
        point(i, u);
        const double z = 2 * u[0] - 1, across = sqrt(1 - z * z), angle = 2 * PI * u[1];
        const struct world_ray ray = {
            from, {across * cos(angle), across * sin(angle), z}, 0, (double)INFINITY};
        if (!world_intersect(&stage->world, &ray, &hit)) {
            lights_background(&stage->lights, ray.direction, &stage->lanes, &light);
        } else if (materials_shines(&stage->lights.materials, hit.thing)) {
            materials_shine(&stage->lights.materials, hit.thing, hit.place, &stage->lanes, &light);
        }
        sum += luminance(&light) * fmax(0, vector_dot(ray.direction, normal));
    }
    return 4 * PI * sum / POINTS;
}

/* The integral of the density over all ways: 1 where things do not hide one another. */
static double all_density(const struct stage *stage, struct vector from, double time)
{
    double sum = 0;
    for (uint32_t i = 0; i < POINTS; i++) {
        double u[3];
        struct world_hit hit;
        point(i, u);
        const double z = 2 * u[0] - 1, across = sqrt(1 - z * z), angle = 2 * PI * u[1];
        const struct world_ray ray = {
            from, {across * cos(angle), across * sin(angle), z}, time, (double)INFINITY};
        const bool meets = world_intersect(&stage->world, &ray, &hit);
        sum += lights_pdf(&stage->lights, from, ray.direction, time, meets ? &hit : NULL);
    }
    return 4 * PI * sum / POINTS;
}

/* The density that comes with a sample is that of its way, and the light what is met there. */
static void check_samples(const struct stage *stage, struct vector from, double time)
{
    int wrong = 0, seen = 0;
    for (uint32_t i = 0; i < 1024; i++) {
        double u[3];
        struct light_sample sample;
        struct world_hit hit;
        struct radiance light = {{0}};
        point(i, u);
        if (!lights_sample(&stage->lights, from, time, u, &stage->lanes, &sample) ||
            sample.is_point) {
            continue;
        }
        const struct world_ray ray = {from, sample.direction, time, (double)INFINITY};
        const bool meets = world_intersect(&stage->world, &ray, &hit);
        if (meets && fabs(hit.distance - sample.distance) > 1e-6 * hit.distance) {
            continue; /* hidden */
        }
        if (meets) {
            materials_shine(&stage->lights.materials, hit.thing, hit.place, &stage->lanes, &light);
        } else {
            lights_background(&stage->lights, sample.direction, &stage->lanes, &light);
        }
        const double density =
            lights_pdf(&stage->lights, from, sample.direction, time, meets ? &hit : NULL);
        seen++;
        wrong += fabs(density - sample.pdf) > 1e-6 * density ||
                 fabs(luminance(&light) - luminance(&sample.light)) > 1e-6 * luminance(&light);
    }
    CHECK(seen > 100 && wrong <= seen / 200); /* at the edges of cells and discs either may be */
}

/* -------- far away -------- */

static void test_sun(void)
{
    struct stage stage;
    const double height = 0.6, radius = 0.2;
    struct scene_light sun = {.kind = LIGHT_SUN,
                              .spectrum = spectrum_white(),
                              .direction = {cos(height), sin(height), 0},
                              .diameter = 2 * radius,
                              .amount = 80000};
    stage_open(&stage, NULL, 0, &sun, 1);
    const struct vector from = {3, 4, 5}, up = {0, 1, 0};
    CHECK_RELATIVE(illuminance(&stage, from, sun.direction, 0), 80000.0, 1e-4, "facing the sun");
    CHECK_RELATIVE(illuminance(&stage, from, up, 0), 80000 * sin(height), 1e-3, "E sin h");
    CHECK_NEAR(all_density(&stage, from, 0), 1, 0.02, "density of a sun");
    check_samples(&stage, from, 0);
    struct radiance light;
    lights_background(&stage.lights, sun.direction, &stage.lanes, &light);
    CHECK_RELATIVE(luminance(&light), 80000 / (PI * sin(radius) * sin(radius)), 1e-12, "its disc");
    lights_background(&stage.lights, up, &stage.lanes, &light);
    CHECK(luminance(&light) == 0);
    arena_free(&stage.arena);
}

/* Five hundred stars, some at the poles and at the seam: found where they are, and only there. */
static void test_stars(void)
{
    enum { STARS = 500 };
    static struct scene_light stars[STARS];
    struct stage stage;
    double u[3], all = 0;
    for (uint32_t i = 0; i < STARS; i++) {
        point(i, u);
        const double y = 2 * u[0] - 1, across = sqrt(1 - y * y), angle = 2 * PI * u[1];
        stars[i] = (struct scene_light){.kind = LIGHT_STAR,
                                        .spectrum = spectrum_white(),
                                        .direction = {across * sin(angle), y, across * cos(angle)},
                                        .diameter = i % 7 == 0 ? 0.1 : 3e-4,
                                        .amount = illuminant_star(6 * u[2])};
        all += stars[i].amount;
    }
    stars[0].direction = (struct vector){0, 1, 0};
    stars[1].direction = (struct vector){0, -1, 0};
    stars[2].direction = (struct vector){0, 0, -1};
    stars[7].direction = vector_unit((struct vector){1e-3, 0.2, -1});
    stars[14].direction = vector_unit((struct vector){0.02, -1, 0.01});
    stage_open(&stage, NULL, 0, stars, STARS);
    CHECK_RELATIVE(stage.lights.distant.total, all, 1e-12, "all stars");
    int wrong = 0;
    for (uint32_t i = 0; i < 20 * STARS; i++) {
        const struct scene_light *star = &stars[i % STARS];
        point(i, u);
        struct vector way = {2 * u[0] - 1, 2 * u[1] - 1, 2 * u[2] - 1};
        way = vector_unit(vector_along(star->direction, star->diameter * 0.8, way));
        double expected = 0;
        struct radiance light;
        for (size_t k = 0; k < STARS; k++) {
            const struct vector off = vector_minus(way, stars[k].direction);
            const double angle = 2 * asin(vector_length(off) / 2), r = stars[k].diameter / 2;
            expected += angle <= r ? stars[k].amount / (PI * sin(r) * sin(r)) : 0;
        }
        lights_background(&stage.lights, way, &stage.lanes, &light);
        wrong += fabs(luminance(&light) - expected) > 1e-9 * expected;
    }
    CHECK(wrong == 0);
    check_samples(&stage, (struct vector){0, 0, 0}, 0);
    arena_free(&stage.arena);
}

/* Stars of one place, size and colour are one as bright as all; others are not. */
static void test_joined(void)
{
    enum { STARS = 9 };
    static struct scene_light stars[STARS];
    const double radius = 0.01;
    struct stage stage;
    struct radiance light;
    for (size_t i = 0; i < STARS; i++) {
        stars[i] = (struct scene_light){.kind = LIGHT_STAR,
                                        .spectrum = spectrum_white(),
                                        .direction = {0, 0, i % 3 == 1 ? 1 : -1},
                                        .diameter = (i == 8 ? 4 : 2) * radius,
                                        .amount = (double)(i + 1)};
    }
    stars[5].spectrum.kind = SPECTRUM_BLACKBODY;
    stars[5].spectrum.kelvin = 3000;
    stage_open(&stage, NULL, 0, stars, STARS);
    /* behind: 2 + 5 + 8; before: 1 + 3 + 4 + 7, 6 of another colour and 9 of another size */
    const struct distant_lights *discs = &stage.lights.distant;
    static const double amounts[] = {15, 15, 6, 9};
    CHECK(discs->count == 4);
    for (size_t i = 0; i < discs->count; i++) {
        CHECK_RELATIVE(discs->below[i + 1] - discs->below[i], amounts[i], 1e-14, "lx");
    }
    lights_background(&stage.lights, stars[1].direction, &stage.lanes, &light);
    CHECK_RELATIVE(luminance(&light), 15 / (PI * sin(radius) * sin(radius)), 1e-12, "behind");
    check_samples(&stage, (struct vector){0, 0, 0}, 0);
    arena_free(&stage.arena);
}

/* Horizontal: pi L; on a slope pi L (1 + cos)/2. The others by integrals of their formula. */
static void test_sky(void)
{
    const struct vector from = {0, 0, 0}, up = {0, 1, 0};
    const struct vector slope = {sin(0.7), cos(0.7), 0}, sun = {cos(0.5), sin(0.5), 0};
    struct stage stage;
    struct scene_light sky = {
        .kind = LIGHT_SKY, .spectrum = spectrum_white(), .sky = SKY_UNIFORM, .amount = 5000};
    stage_open(&stage, NULL, 0, &sky, 1);
    CHECK_RELATIVE(illuminance(&stage, from, up, 0), PI * 5000, 1e-3, "pi L");
    CHECK_RELATIVE(illuminance(&stage, from, slope, 0), PI * 5000 * (1 + cos(0.7)) / 2, 1e-3,
                   "a slope");
    CHECK_NEAR(all_density(&stage, from, 0), 1, 1e-3, "density of a sky");
    check_samples(&stage, from, 0);
    arena_free(&stage.arena);
    /* sums of 2e5 and 800 x 800 midpoints of the formulas of CIE S 011, times c s */
    sky.sky = SKY_OVERCAST;
    stage_open(&stage, NULL, 0, &sky, 1);
    CHECK_RELATIVE(illuminance(&stage, from, up, 0), 5000 * 2.44954087, 1e-3, "overcast");
    CHECK_RELATIVE(sky_share(SKY_OVERCAST, sun, (struct vector){1, 1e-9, 0}), 1 / 2.98634, 1e-5,
                   "three times as bright in the zenith");
    CHECK_NEAR(all_density(&stage, from, 0), 1, 1e-3, "density of an overcast sky");
    arena_free(&stage.arena);
    sky.sky = SKY_CLEAR;
    sky.direction = sun;
    stage_open(&stage, NULL, 0, &sky, 1);
    CHECK_RELATIVE(illuminance(&stage, from, up, 0), 5000 * 6.50666, 1e-3, "clear");
    CHECK(sky_share(SKY_CLEAR, sun, up) == 1);
    CHECK_NEAR(all_density(&stage, from, 0), 1, 2e-3, "density of a clear sky");
    check_samples(&stage, from, 0);
    arena_free(&stage.arena);
}

static void test_environment(void)
{
    enum { WIDTH = 16, HEIGHT = 8 };
    static float pixels[WIDTH * HEIGHT * 3];
    struct image picture = {.width = WIDTH, .height = HEIGHT, .channels = 3, .pixels = pixels};
    struct scene_light light = {
        .kind = LIGHT_ENVIRONMENT, .spectrum = spectrum_white(), .picture = &picture, .amount = 40};
    const struct vector from = {0, 0, 0}, side = {0.6, 0, -0.8};
    struct stage stage;
    struct radiance seen;
    for (size_t i = 0; i < sizeof pixels / sizeof pixels[0]; i++) {
        pixels[i] = 1;
    }
    stage_open(&stage, NULL, 0, &light, 1);
    CHECK_RELATIVE(illuminance(&stage, from, side, 0), PI * 40, 1e-3, "evenly bright");
    CHECK_NEAR(all_density(&stage, from, 0), 1, 1e-7, "density all around");
    arena_free(&stage.arena);
    /* dark but for the pixel right of the middle, below the horizon, which is red */
    for (size_t i = 0; i < sizeof pixels / sizeof pixels[0]; i++) {
        pixels[i] = 0;
    }
    pixels[(4 * WIDTH + 8) * 3] = 10;
    light.turn = -0.3;
    stage_open(&stage, NULL, 0, &light, 1);
    const double azimuth = 2 * PI / WIDTH / 2 + 0.3, down = PI / HEIGHT / 2;
    const struct vector way = {cos(down) * sin(azimuth), -sin(down), -cos(down) * cos(azimuth)};
    lights_background(&stage.lights, way, &stage.lanes, &seen);
    CHECK_RELATIVE(seen.of[0], 400.0, 1e-6, "a red pixel");
    CHECK(seen.of[1] == 0 && seen.of[2] == 0);
    const double by_ways = met_illuminance(&stage, from, way);
    CHECK_RELATIVE(illuminance(&stage, from, way, 0), by_ways, 0.02, "by ways all around");
    CHECK_NEAR(all_density(&stage, from, 0), 1, 0.02, "density of a pixel");
    check_samples(&stage, from, 0);
    arena_free(&stage.arena);
}

/* -------- things -------- */

/* Luminance 100: a sphere, a disc, a card, a triangle and a box, from a plane below them. */
static void test_lamps(void)
{
    static const struct vector corners[3] = {{-5, -5, 0}, {15, -5, 0}, {-5, 15, 0}};
    static const size_t triangles[2][3] = {{0, 1, 2}, {0, 1, 1}};
    static const struct scene_mesh mesh = {
        .corner_count = 3, .triangle_count = 2, .corners = corners, .triangles = triangles};
    const struct vector from = {0, 0, 0}, up = {0, 1, 0};
    const double r = 10, d = 30;
    struct scene_thing things[] = {
        {.shape = SHAPE_SPHERE, .where = upright(0, d, 0), .radius = r},
        {.shape = SHAPE_DISC, .where = lying(0, d, 0), .radius = r},
        {.shape = SHAPE_CARD, .where = lying(0, d, 0), .size = {20, 12, 0}},
        {.shape = SHAPE_MESH, .where = lying(0, d, 0), .mesh = &mesh},
        {.shape = SHAPE_BOX, .where = upright(0, d, 0), .size = {20, 8, 12}},
        {.shape = SHAPE_PLANE, .where = lying(0, d, 0)},
    };
    /* pi L sin^2; the same; four corners of (a/sqrt(1+a^2) atan(b/sqrt(1+a^2)) + ...)/2;
       Lambert's formula over the edges of the triangle; of a box the lower side; pi L */
    const double expected[] = {PI * 100 * r * r / (d * d),
                               PI * 100 * r * r / (r * r + d * d),
                               24.25017906,
                               20.08021005,
                               31.35659448,
                               PI * 100};
    for (size_t i = 0; i < sizeof things / sizeof things[0]; i++) {
        struct stage stage;
        stage_open(&stage, &things[i], 1, NULL, 0);
        CHECK_RELATIVE(illuminance(&stage, from, up, 0), expected[i], 2e-3, "a lamp");
        CHECK_NEAR(all_density(&stage, from, 0), 1, 0.02, "density of a lamp");
        check_samples(&stage, from, 0);
        arena_free(&stage.arena);
    }
}

/* Part of the half space's light that a rectangle with a corner above gives a parallel plane. */
static double corner_share(double x, double y, double height)
{
    const double a = x / height, b = y / height, p = sqrt(1 + a * a), q = sqrt(1 + b * b);
    return (a / p * atan(b / p) + b / q * atan(a / q)) / (2 * PI);
}

/* A card near and far, above and beside: by the four corners of Howell's factor C-11. */
static void test_cards(void)
{
    struct scene_thing card = {.shape = SHAPE_CARD, .where = lying(0, 0, 0), .size = {20, 12, 0}};
    static const struct vector places[] = {{0, -1, 0},    {9, -0.05, 5.9}, {15, -3, 1},
                                           {40, -2, -30}, {0, -800, 100},  {9.9, 2, -5.5}};
    struct stage stage;
    stage_open(&stage, &card, 1, NULL, 0);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const struct vector from = places[i];
        const double height = fabs(from.y);
        double share = 0;
        for (int k = 0; k < 4; k++) {
            const double x = (k % 2 == 0 ? -10 : 10) - from.x, z = (k < 2 ? -6 : 6) - from.z;
            share += (k % 3 == 0 ? 1 : -1) * corner_share(x, z, height);
        }
        CHECK_RELATIVE(illuminance(&stage, from, (struct vector){0, copysign(1, -from.y), 0}, 0),
                       PI * 100 * share, 1e-3, "a card");
        check_samples(&stage, from, 0);
    }
    arena_free(&stage.arena);
}

/* The sides of a box that are seen hide none of each other: from a corner of three, and of one. */
static void test_boxes(void)
{
    struct scene_thing box = {.shape = SHAPE_BOX, .where = upright(0, 0, 0), .size = {20, 16, 12}};
    static const struct vector places[] = {{14, 11, 9}, {0, 9, 0}, {300, 400, 0}, {11, 30, 0}};
    struct stage stage;
    stage_open(&stage, &box, 1, NULL, 0);
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        const struct vector from = places[i], normal = vector_times(-1, vector_unit(from));
        check_samples(&stage, from, 0);
        if (vector_length(from) < 100) {
            CHECK_RELATIVE(illuminance(&stage, from, normal, 0),
                           met_illuminance(&stage, from, normal), 0.02, "a box");
            CHECK_NEAR(all_density(&stage, from, 0), 1, 0.02, "density of a box");
        }
    }
    arena_free(&stage.arena);
}

/* From within: all around is L, so pi L on any plane. */
static void test_inside(void)
{
    struct scene_thing things[] = {
        {.shape = SHAPE_SPHERE, .where = upright(0, 0, 0), .radius = 10},
        {.shape = SHAPE_BOX, .where = upright(0, 0, 0), .size = {20, 16, 12}},
    };
    const struct vector from = {2, 3, 1}, normal = {0.6, 0, 0.8};
    for (size_t i = 0; i < 2; i++) {
        struct stage stage;
        stage_open(&stage, &things[i], 1, NULL, 0);
        CHECK_RELATIVE(illuminance(&stage, from, normal, 0), PI * 100, 5e-3, "from within");
        CHECK_NEAR(all_density(&stage, from, 0), 1, 1e-2, "density from within");
        check_samples(&stage, from, 0);
        arena_free(&stage.arena);
    }
}

/* A lamp that moves and turns is where it is at the time of the ray. */
static void test_moving(void)
{
    struct scene_thing card = {
        .shape = SHAPE_CARD, .where = upright(0, 30, 0), .size = {20, 12, 0}};
    card.where.velocity = (struct vector){0, -10, 0};
    card.where.axis = (struct vector){1, 0, 0};
    card.where.spin = PI;
    struct scene_thing still = {.shape = SHAPE_CARD, .where = lying(0, 25, 0), .size = {20, 12, 0}};
    const struct vector from = {4, 0, 1}, up = {0, 1, 0};
    struct stage stage, other;
    stage_open(&stage, &card, 1, NULL, 0);
    stage_open(&other, &still, 1, NULL, 0);
    CHECK_RELATIVE(illuminance(&stage, from, up, 0.5), illuminance(&other, from, up, 0), 2e-3,
                   "half a second later");
    check_samples(&stage, from, 0.5);
    arena_free(&stage.arena);
    arena_free(&other.arena);
}

static void test_point(void)
{
    struct scene_light light = {.kind = LIGHT_POINT,
                                .spectrum = spectrum_white(),
                                .at = {3000, 4000, 0},
                                .velocity = {0, -1000, 0},
                                .amount = 50};
    const struct vector from = {0, 0, 0}, up = {0, 1, 0};
    struct stage stage;
    stage_open(&stage, NULL, 0, &light, 1);
    /* I cos/d^2 */
    CHECK_RELATIVE(illuminance(&stage, from, up, 0), 50 * 0.8 / 25, 1e-12, "a point");
    CHECK_RELATIVE(illuminance(&stage, from, up, 1), 50 / sqrt(2) / 18, 1e-12, "later");
    CHECK(all_density(&stage, from, 0) == 0);
    arena_free(&stage.arena);
}

/* Cards whose pictures shine. */
static void test_card(void)
{
    static float half[] = {1, 1, 1, 1, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 0};
    static float colours[] = {1, 0, 0, 0, 1, 0, 0.5, 0.25, 3, 1, 1, 1, 0, 0, 0.125, 2, 2, 0};
    const struct image there = {.width = 4, .height = 1, .channels = 4, .pixels = half};
    const struct image coloured = {.width = 2, .height = 3, .channels = 3, .pixels = colours};
    struct scene_thing card = {.shape = SHAPE_CARD,
                               .where = lying(0, 30, 0),
                               .size = {20, 12, 0},
                               .picture = &there,
                               .mean = 0.75,
                               .shines = true,
                               .luminance = 200,
                               .material = SCENE_NONE};
    const struct vector from = {0, 0, 0}, up = {0, 1, 0}, off = {7, 3, -2};
    struct stage stage;
    /* by symmetry half as much as all of it: a column is black, one is not there */
    stage_open(&stage, &card, 1, NULL, 0);
    CHECK_RELATIVE(illuminance(&stage, from, up, 0), 24.25017906, 2e-3, "a card that shines");
    arena_free(&stage.arena);
    card.picture = &coloured;
    card.mean = 1;
    stage_open(&stage, &card, 1, NULL, 0);
    check_samples(&stage, off, 0);
    arena_free(&stage.arena);
}

/* -------- many -------- */

/* A sun, a sky, a point, two hundred lamps: the sum of each alone. */
static void test_many(void)
{
    enum { LAMPS = 200 };
    static struct scene_thing lamps[LAMPS];
    struct scene_light lights[] = {
        {.kind = LIGHT_SUN,
         .spectrum = spectrum_white(),
         .direction = {0, 1, 0},
         .diameter = 0.01,
         .amount = 30},
        {.kind = LIGHT_SKY, .spectrum = spectrum_white(), .sky = SKY_UNIFORM, .amount = 4},
        {.kind = LIGHT_POINT, .spectrum = spectrum_white(), .at = {0, 4000, 0}, .amount = 300},
    };
    double expected = 30 + PI * 4 + 300.0 / 16, hidden = 0;
    for (uint32_t i = 0; i < LAMPS; i++) {
        double u[3];
        point(i, u);
        const double x = 4000 * u[0] - 2000, z = 4000 * u[1] - 2000, y = 300 + 10 * (double)i;
        const double square = x * x + y * y + z * z, radius = 4;
        lamps[i] = (struct scene_thing){
            .shape = SHAPE_SPHERE, .where = upright(x, y, z), .radius = radius};
        expected += PI * 100 * radius * radius / square * y / sqrt(square);
        hidden += PI * 4 * radius * radius / square * y / sqrt(square);
    }
    struct stage stage;
    stage_open(&stage, lamps, LAMPS, lights, 3);
    const struct vector from = {0, 0, 0}, up = {0, 1, 0};
    CHECK_RELATIVE(illuminance(&stage, from, up, 0), expected - hidden, 3e-3, "many lights");
    check_samples(&stage, from, 0);
    double chances = 0;
    for (size_t i = 0; i <= LAMPS; i++) {
        chances += light_tree_probability(&stage.lights.tree, from, i);
    }
    CHECK_NEAR(chances, 1, 1e-12, "chances of all lamps");
    arena_free(&stage.arena);
}

static void test_dark(void)
{
    struct scene_light off = {.kind = LIGHT_SUN,
                              .spectrum = spectrum_white(),
                              .direction = {0, 1, 0},
                              .diameter = 0.01,
                              .amount = 0};
    struct stage stage;
    struct light_sample sample;
    const double u[3] = {0.5, 0.5, 0.5};
    const struct vector from = {0, 0, 0}, up = {0, 1, 0};
    stage_open(&stage, NULL, 0, &off, 1);
    CHECK(!lights_sample(&stage.lights, from, 0, u, &stage.lanes, &sample));
    CHECK(lights_pdf(&stage.lights, from, up, 0, NULL) == 0);
    arena_free(&stage.arena);
    off.amount = 1;
    off.spectrum = (struct spectrum){.kind = SPECTRUM_RGB};
    off.place = (struct typed_place){"night.scene", 3, 7};
    struct scene scene = {.lights = &off, .light_count = 1};
    struct arena arena = {0};
    struct lights lights;
    struct error error;
    CHECK(!lights_open(&scene, &stage.bands, &arena, &lights, &error));
    CHECK(error.line == 3 && error.column == 7);
    arena_free(&arena);
}

int main(void)
{
    for (uint32_t k = 0; k < 3; k++) {
        sobol_open(k, &dimensions[k]);
    }
    test_sun();
    test_stars();
    test_joined();
    test_sky();
    test_environment();
    test_lamps();
    test_cards();
    test_boxes();
    test_inside();
    test_moving();
    test_point();
    test_card();
    test_many();
    test_dark();
    return check_report();
}
