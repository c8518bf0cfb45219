/* tests/unit/test_path.c - light of lamps on surfaces, against closed forms. */
/* SPDX-License-Identifier: MIT */
#include "scene/path.h"

#include "looked.h"

#define L   300.0 /* cd/m^2 of lamps */
#define RHO 0.6

enum { GROUND, LAMP, MIRROR, WALL, GLOSSY };
static struct scene_material materials[] = {
    [GROUND] = {.name = "ground", .kind = MATERIAL_LAMBERT, .colour = LOOKED_GREY(RHO)},
    [LAMP] = {.name = "lamp", .kind = MATERIAL_BLACK, .emission = LOOKED_GREY(1), .luminance = L},
    [MIRROR] = {.name = "mirror", .kind = MATERIAL_MIRROR, .colour = LOOKED_GREY(0.8)},
    [WALL] = {.name = "wall",
              .kind = MATERIAL_LAMBERT,
              .colour = LOOKED_GREY(0.5),
              .emission = LOOKED_GREY(1),
              .luminance = L},
    [GLOSSY] = {.name = "glossy",
                .kind = MATERIAL_GLOSSY,
                .colour = LOOKED_GREY(0.3),
                .roughness = 0.3,
                .index = 1.5},
};

static const struct frame looked_level = LOOKED_LEVEL;

/* A level plane through the origin, and others. */
static const struct scene_thing ground = {
    .shape = SHAPE_PLANE, .where = LOOKED_PLACE(LOOKED_LEVEL, 0, 0, 0), .material = GROUND};

static struct scene scene_of(struct scene_thing *things, size_t count)
{
    return (struct scene){.materials = materials,
                          .material_count = sizeof materials / sizeof *materials,
                          .things = things,
                          .thing_count = count};
}

/* What the ground at (x, 0, 0) sends up, where only `lamp` is there besides. */
static void check_lamp(struct scene_thing lamp, double x, double irradiance, const char *what)
{
    struct scene_thing things[] = {ground, lamp};
    struct scene scene = scene_of(things, 2);
    struct looked looked;
    const struct world_ray ray =
        looked_ray((struct vector){x - 30, 20, 15}, (struct vector){x, 0, 0});
    looked_open(&scene, 1, &looked);
    looked_check(&looked, &ray, 512, RHO * irradiance / PI, what);
    arena_free(&looked.arena);
}

/* A disc of radius R, h above and x beside: [Foote15]. */
static double by_disc(double R, double h, double x)
{
    const double a = x * x + h * h;
    return PI * L / 2 * (1 - (a - R * R) / sqrt((a + R * R) * (a + R * R) - 4 * R * R * x * x));
}

/* A rectangle h above, with a corner upright over the place. */
static double by_corner(double a, double b, double h)
{
    const double p = sqrt(a * a + h * h), q = sqrt(b * b + h * h);
    return L / 2 * (a / p * atan(b / p) + b / q * atan(a / q));
}

static void test_lamps(void)
{
    const struct scene_thing disc = {.shape = SHAPE_DISC,
                                     .where = LOOKED_PLACE(LOOKED_DOWN, 0, 100, 0),
                                     .radius = 40,
                                     .material = LAMP};
    check_lamp(disc, 0, by_disc(40, 100, 0), "disc, on its axis");
    check_lamp(disc, 70, by_disc(40, 100, 70), "disc, beside");
    struct scene_thing large = disc;
    large.radius = 2000;
    check_lamp(large, 0, by_disc(2000, 100, 0), "wide disc");
    const struct scene_thing sphere = {.shape = SHAPE_SPHERE,
                                       .where = LOOKED_PLACE(LOOKED_UPRIGHT, 0, 100, 0),
                                       .radius = 30,
                                       .material = LAMP};
    /* a sphere that is whole above the horizon: pi L sin^2 cos */
    check_lamp(sphere, 0, PI * L * 0.09, "sphere, above");
    check_lamp(sphere, 100, PI * L * 900 / 2e4 * sqrt(0.5), "sphere, beside");
    const struct scene_thing card = {.shape = SHAPE_CARD,
                                     .where = LOOKED_PLACE(LOOKED_DOWN, 0, 50, 0),
                                     .size = {60, 80, 0},
                                     .material = LAMP};
    check_lamp(card, 0, 4 * by_corner(30, 40, 50), "card, above");
    check_lamp(card, 30, 2 * by_corner(60, 40, 50), "card, above its edge");
    const struct scene_thing box = {.shape = SHAPE_BOX,
                                    .where = LOOKED_PLACE(LOOKED_UPRIGHT, 0, 60, 0),
                                    .size = {60, 20, 80},
                                    .material = LAMP};
    check_lamp(box, 0, 4 * by_corner(30, 40, 50), "box, below");
}

/* A square of two triangles. */
static void test_mesh(void)
{
    static const struct vector corners[] = {{-30, -40, 0}, {30, -40, 0}, {30, 40, 0}, {-30, 40, 0}};
    static const size_t triangles[][3] = {{0, 1, 2}, {0, 2, 3}};
    static const struct scene_mesh square = {.file = "square.obj",
                                             .corner_count = 4,
                                             .triangle_count = 2,
                                             .corners = corners,
                                             .triangles = triangles};
    const struct scene_thing mesh = {.shape = SHAPE_MESH,
                                     .where = LOOKED_PLACE(LOOKED_DOWN, 0, 50, 0),
                                     .mesh = &square,
                                     .material = LAMP};
    check_lamp(mesh, 0, 4 * by_corner(30, 40, 50), "mesh, above");
    check_lamp(mesh, 30, 2 * by_corner(60, 40, 50), "mesh, above its edge");
}

/* Each band by itself: a coloured lamp over a coloured ground. */
static void test_bands(void)
{
    static const double lamp_rgb[3] = {1, 0.4, 0.1}, ground_rgb[3] = {0.2, 0.5, 0.7};
    const double luminance = 0.2126 * 1 + 0.7152 * 0.4 + 0.0722 * 0.1;
    static struct scene_material coloured[] = {
        {.name = "ground",
         .kind = MATERIAL_LAMBERT,
         .colour = {SPECTRUM_RGB, {0.2, 0.5, 0.7}, 0, 0, NULL, NULL}},
        {.name = "lamp",
         .kind = MATERIAL_BLACK,
         .emission = {SPECTRUM_RGB, {1, 0.4, 0.1}, 0, 0, NULL, NULL},
         .luminance = L},
    };
    struct scene_thing things[] = {ground,
                                   {.shape = SHAPE_DISC,
                                    .where = LOOKED_PLACE(LOOKED_DOWN, 0, 100, 0),
                                    .radius = 40,
                                    .material = 1}};
    struct scene scene = {
        .materials = coloured, .material_count = 2, .things = things, .thing_count = 2};
    static const struct lanes lanes = {3, {0, 1, 2}};
    const struct world_ray ray = looked_ray((struct vector){-30, 20, 15}, (struct vector){0, 0, 0});
    struct looked looked;
    double mean[3] = {0};
    enum { COUNT = 8192 };
    looked_open(&scene, 1, &looked);
    struct sampler_sequence sequence;
    sampler_sequence_open(looked.table, 1, 0, &sequence);
    for (uint32_t i = 0; i < COUNT; i++) {
        struct sampler sampler = sampler_of(&sequence, i, 0);
        struct radiance light;
        path_radiance(&looked.path, &ray, &lanes, &sampler, &light);
        for (int k = 0; k < 3; k++) {
            mean[k] += light.of[k] / COUNT;
        }
    }
    for (int k = 0; k < 3; k++) {
        /* 0.2 %: a net of 8192 points over a smooth integrand; the luminance has four digits */
        CHECK_RELATIVE(mean[k], ground_rgb[k] * lamp_rgb[k] / luminance * by_disc(40, 100, 0) / PI,
                       2e-3, "a band");
    }
    arena_free(&looked.arena);
}

/* Lamps themselves; the ground without a single bounce. */
static void test_emission(void)
{
    struct scene_thing things[] = {ground,
                                   {.shape = SHAPE_DISC,
                                    .where = LOOKED_PLACE(LOOKED_DOWN, 0, 100, 0),
                                    .radius = 40,
                                    .material = LAMP}};
    struct scene scene = scene_of(things, 2);
    struct looked looked;
    const struct vector eye = {0, 50, 200};
    for (int bounces = 0; bounces < 3; bounces++) {
        const struct world_ray lamp = looked_ray(eye, (struct vector){0, 100, 30});
        const struct world_ray past = looked_ray(eye, (struct vector){0, 200, 0});
        const struct world_ray low = looked_ray(eye, (struct vector){0, 0, 30});
        looked_open(&scene, bounces, &looked);
        CHECK(looked_once(&looked, &lamp, 0, 0) == L);
        CHECK(looked_once(&looked, &past, 0, 0) == 0);
        CHECK((looked_mean(&looked, &low, 16).mean > 0) == (bounces > 0));
        arena_free(&looked.arena);
    }
}

/* Within a sphere that shines and reflects half: L (1 + rho + ..), as often as asked for. */
static void test_furnace(void)
{
    struct scene_thing things[] = {{.shape = SHAPE_SPHERE,
                                    .where = LOOKED_PLACE(LOOKED_UPRIGHT, 5, 0, 0),
                                    .radius = 50,
                                    .material = WALL}};
    struct scene scene = scene_of(things, 1);
    const struct world_ray ray = looked_ray((struct vector){20, 10, 0}, (struct vector){-3, 4, 12});
    struct looked looked;
    for (int bounces = 0; bounces < 6; bounces++) {
        looked_open(&scene, bounces, &looked);
        looked_check(&looked, &ray, 512, L * 2 * (1 - pow(0.5, bounces + 1)), "furnace");
        arena_free(&looked.arena);
    }
    looked_open(&scene, 1000, &looked);
    looked_check(&looked, &ray, 1024, 2 * L, "furnace without end");
    arena_free(&looked.arena);
}

/*
 * A lamp beside a wall that is a mirror: it is seen there with the mirror's share, and the ground
 * is lit by it and by what the mirror shows of it.
 */
static void test_mirror(void)
{
    static const struct frame sideways = {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    struct scene_thing things[] = {
        ground,
        {.shape = SHAPE_DISC,
         .where = LOOKED_PLACE(LOOKED_DOWN, 50, 100, 0),
         .radius = 40,
         .material = LAMP},
        {.shape = SHAPE_PLANE, .where = LOOKED_PLACE(sideways, -20, 0, 0), .material = MIRROR}};
    struct scene scene = scene_of(things, 3);
    struct looked looked;
    const struct world_ray mirrored =
        looked_ray((struct vector){30, 40, 0}, (struct vector){-90, 100, 0});
    const struct world_ray low = looked_ray((struct vector){30, 40, 0}, (struct vector){10, 0, 0});
    looked_open(&scene, 1, &looked);
    CHECK_NEAR(looked_once(&looked, &mirrored, 0, 0), 0.8 * L, 1e-9, "in the mirror");
    looked_check(&looked, &low, 512, RHO / PI * by_disc(40, 100, 40), "one bounce");
    arena_free(&looked.arena);
    looked_open(&scene, 2, &looked);
    looked_check(&looked, &low, 4096,
                 RHO / PI * (by_disc(40, 100, 40) + 0.8 * by_disc(40, 100, 100)), "and the mirror");
    arena_free(&looked.arena);
    looked_open(&scene, 0, &looked);
    CHECK(looked_once(&looked, &mirrored, 0, 0) == 0);
    arena_free(&looked.arena);
}

/* A card that is half there in the lamp's way lets half of it through, wherever it is hidden. */
static void test_alpha(void)
{
    static float pixel[] = {0, 0, 0, 0.5f};
    static const struct image image = {.width = 1, .height = 1, .channels = 4, .pixels = pixel};
    struct scene_thing things[] = {ground,
                                   {.shape = SHAPE_DISC,
                                    .where = LOOKED_PLACE(LOOKED_DOWN, 0, 100, 0),
                                    .radius = 40,
                                    .material = LAMP},
                                   {.shape = SHAPE_CARD,
                                    .where = LOOKED_PLACE(LOOKED_DOWN, 0, 50, 0),
                                    .size = {500, 500, 0},
                                    .picture = &image,
                                    .material = SCENE_NONE}};
    struct scene scene = scene_of(things, 3);
    struct looked looked;
    const struct world_ray ray = looked_ray((struct vector){30, 40, 0}, (struct vector){0, 0, 0});
    looked_open(&scene, 1, &looked);
    looked_check(&looked, &ray, 4096, RHO / PI * by_disc(40, 100, 0) / 2, "half a card");
    arena_free(&looked.arena);
}

/* A glossy plane under a disc, seen along its mirror's way: against a sum over the disc. */
static void test_glossy(void)
{
    enum { RINGS = 200, TURNS = 200 };
    const double h = 100, R = 30, beside = 60;
    struct scene_thing things[] = {ground,
                                   {.shape = SHAPE_DISC,
                                    .where = LOOKED_PLACE(LOOKED_DOWN, beside, h, 0),
                                    .radius = R,
                                    .material = LAMP}};
    things[0].material = GLOSSY;
    struct scene scene = scene_of(things, 2);
    struct looked looked;
    const struct world_ray ray = looked_ray((struct vector){-70, 90, 20}, (struct vector){0, 0, 0});
    looked_open(&scene, 1, &looked);
    struct bsdf scatter;
    materials_bsdf(&looked.lights.materials, 0, (const double[]){0, 0},
                   &(const struct lanes){1, {0}}, &scatter);
    const struct vector out = frame_in(&looked_level, vector_times(-1, ray.direction));
    double sum = 0;
    for (int i = 0; i < RINGS * TURNS; i++) {
        const double r = R * sqrt((i / TURNS + 0.5) / RINGS), turn = 2 * PI * (i % TURNS) / TURNS;
        const struct vector to = {beside + r * cos(turn), h, r * sin(turn)};
        const double d2 = vector_dot(to, to), cosine = h / sqrt(d2);
        struct radiance value;
        bsdf_value(&scatter, out, frame_in(&looked_level, vector_unit(to)), &value);
        sum += value.of[0] * L * cosine / d2 * PI * R * R / (RINGS * TURNS);
    }
    looked_check(&looked, &ray, 1024, sum, "glossy");
    arena_free(&looked.arena);
}

/* Sums of one way of looking for light, over the points of a sequence. */
enum way { BY_LIGHT, BY_SURFACE, BY_BOTH, WAYS };

static double by_way(const struct looked *looked, const struct world_ray *ray, enum way way,
                     struct sampler *points)
{
    const struct lanes lanes = {1, {0}};
    struct world_hit hit;
    struct bsdf scatter;
    struct radiance value, light;
    struct light_sample to;
    struct bsdf_sample sample;
    double u[3];
    if (way == BY_BOTH) {
        path_radiance(&looked->path, ray, &lanes, points, &light);
        return light.of[0];
    }
    CHECK(world_intersect(&looked->world, ray, &hit));
    materials_bsdf(&looked->lights.materials, hit.thing, hit.place, &lanes, &scatter);
    const struct frame frame = frame_about(hit.normal);
    const struct vector out = frame_in(&frame, vector_times(-1, ray->direction));
    struct world_ray on = {.origin = world_ray_origin(&hit), .time = 0, .farthest = INFINITY};
    for (int i = 0; i < 3; i++) {
        u[i] = sampler_next(points);
    }
    if (way == BY_LIGHT) {
        return lights_sample(&looked->lights, on.origin, 0, u, &lanes, &to) &&
                       bsdf_value(&scatter, out, frame_in(&frame, to.direction), &value) > 0
                   ? value.of[0] * to.light.of[0] / to.pdf
                   : 0;
    }
    if (!bsdf_sample(&scatter, out, u, &sample)) {
        return 0;
    }
    on.direction = frame_out(&frame, sample.direction);
    return world_intersect(&looked->world, &on, &hit) && hit.thing == 1
               ? sample.throughput.of[0] * L
               : 0;
}

/*
 * Large and small lamps on rough and fine surfaces: towards the lamps, as the surface reflects, and
 * by both together the same light is found, and never with the error of the worse of them.
 */
static void test_ways(void)
{
    enum { COUNT = 256 };
    static const double radii[] = {3, 60}, alphas[] = {0.02, 0.1, 0.6};
    for (int i = 0; i < 6; i++) {
        struct scene_thing things[] = {ground,
                                       {.shape = SHAPE_DISC,
                                        .where = LOOKED_PLACE(LOOKED_DOWN, 70, 90, 0),
                                        .radius = radii[i / 3],
                                        .material = LAMP}};
        struct scene scene = scene_of(things, 2);
        struct looked looked;
        double mean[WAYS] = {0}, sigma[WAYS];
        const struct world_ray ray =
            looked_ray((struct vector){-70, 90, 0.5}, (struct vector){0, 0, 0});
        things[0].material = GLOSSY;
        materials[GLOSSY].roughness = alphas[i % 3];
        looked_open(&scene, 1, &looked);
        for (enum way way = BY_LIGHT; way < WAYS; way++) {
            double squares = 0;
            for (uint32_t s = 0; s < LOOKED_SEQUENCES; s++) {
                struct sampler_sequence of;
                double sum = 0;
                sampler_sequence_open(looked.table, 1, s, &of);
                for (uint32_t k = 0; k < COUNT; k++) {
                    struct sampler points = sampler_of(&of, k, 0);
                    sum += by_way(&looked, &ray, way, &points) / COUNT;
                }
                mean[way] += sum / LOOKED_SEQUENCES;
                squares += sum * sum / LOOKED_SEQUENCES;
            }
            sigma[way] = sqrt(fmax(0, squares - mean[way] * mean[way]) / (LOOKED_SEQUENCES - 1));
        }
        for (enum way way = BY_LIGHT; way < BY_BOTH; way++) {
            CHECK_NEAR(mean[way], mean[BY_BOTH], 4 * hypot(sigma[way], sigma[BY_BOTH]), "a way");
        }
        CHECK(sigma[BY_BOTH] < 0.5 * fmax(sigma[BY_LIGHT], sigma[BY_SURFACE]));
        CHECK(sigma[BY_BOTH] < 0.01 * mean[BY_BOTH]);
        arena_free(&looked.arena);
    }
    materials[GLOSSY].roughness = 0.3;
}

/* The same whatever was looked at before; each lane by itself as with the others. */
static void test_order(void)
{
    struct scene_thing things[] = {{.shape = SHAPE_SPHERE,
                                    .where = LOOKED_PLACE(LOOKED_UPRIGHT, 5, 0, 0),
                                    .radius = 50,
                                    .material = WALL},
                                   {.shape = SHAPE_BOX,
                                    .where = LOOKED_PLACE(LOOKED_UPRIGHT, 0, -10, 0),
                                    .size = {10, 10, 10},
                                    .material = GLOSSY}};
    struct scene scene = scene_of(things, 2);
    const struct world_ray ray = looked_ray((struct vector){20, 10, 0}, (struct vector){-3, -8, 0});
    struct looked looked;
    double first[64];
    looked_open(&scene, 6, &looked);
    for (uint32_t i = 0; i < 64; i++) {
        first[i] = looked_once(&looked, &ray, 3, i);
    }
    for (uint32_t i = 64; i-- > 0;) {
        CHECK(looked_once(&looked, &ray, 3, i) == first[i]);
        CHECK(i == 0 || first[i] != first[i - 1]);
    }
    arena_free(&looked.arena);
}

int main(void)
{
    test_lamps();
    test_mesh();
    test_bands();
    test_emission();
    test_furnace();
    test_mirror();
    test_alpha();
    test_glossy();
    test_ways();
    test_order();
    return check_report();
}
