/* tests/unit/test_world.c - rays through scenes: closed forms of each shape. */
/* SPDX-License-Identifier: MIT */
#include "scene/world.h"

#include "check.h"

#include <math.h>

static const struct frame upright = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const double whole[2] = {-1, 1};

static struct scene_thing thing_of(enum scene_shape shape, struct vector at)
{
    return (struct scene_thing){.shape = shape,
                                .where = {.at = at, .turned = upright, .axis = {0, 1, 0}},
                                .radius = 2,
                                .size = {2, 4, 6},
                                .repeat = {10, 5},
                                .material = SCENE_NONE};
}

/* Two triangles: the square 0..1 of z = 0, against the clock as seen from z > 0. */
static const struct vector corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const double places[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
static const size_t triangles[][3] = {{0, 1, 2}, {0, 2, 3}, {0, 1, 1}};
static const struct scene_mesh square = {.file = "square.obj",
                                         .corner_count = 4,
                                         .triangle_count = 3,
                                         .corners = corners,
                                         .places = places,
                                         .triangles = triangles};

static const struct shape_case {
    const char *what;
    enum scene_shape shape;
    struct vector from, to; /* the way is towards that */
    bool meets;
    struct vector at, normal;
    double place[2];
    bool is_back;
} shape_cases[] = {
    {"plane", SHAPE_PLANE, {1, 2, 5}, {1, 2, 0}, true, {1, 2, 0}, {0, 0, 1}, {0.6, 0.9}, false},
    {"plane behind",
     SHAPE_PLANE,
     {12, -7, -5},
     {12, -7, 0},
     true,
     {12, -7, 0},
     {0, 0, -1},
     {0.7, 0.1},
     true},
    {"along a plane",
     SHAPE_PLANE,
     {1, 2, 5},
     {2, 2, 5},
     false,
     {0, 0, 0},
     {0, 0, 0},
     {0, 0},
     false},
    {"on a plane", SHAPE_PLANE, {1, 2, 0}, {2, 2, -1}, false, {0, 0, 0}, {0, 0, 0}, {0, 0}, false},
    {"away from it", SHAPE_PLANE, {1, 2, 5}, {1, 2, 6}, false, {0, 0, 0}, {0, 0, 0}, {0, 0}, false},
    {"disc", SHAPE_DISC, {1, 0, 3}, {1, 1, 0}, true, {1, 1, 0}, {0, 0, 1}, {0.75, 0.75}, false},
    {"its rim", SHAPE_DISC, {2, 0, 3}, {2, 0, 0}, true, {2, 0, 0}, {0, 0, 1}, {1, 0.5}, false},
    {"beside it",
     SHAPE_DISC,
     {1.5, 1.5, 3},
     {1.5, 1.5, 0},
     false,
     {0, 0, 0},
     {0, 0, 0},
     {0, 0},
     false},
    {"card",
     SHAPE_CARD,
     {0, 0, -1},
     {0.5, 1, 0},
     true,
     {0.5, 1, 0},
     {0, 0, -1},
     {0.75, 0.75},
     true},
    {"beside it", SHAPE_CARD, {1.1, 0, 1}, {1.1, 0, 0}, false, {0, 0, 0}, {0, 0, 0}, {0, 0}, false},
    {"above it", SHAPE_CARD, {0, 2.1, 1}, {0, 2.1, 0}, false, {0, 0, 0}, {0, 0, 0}, {0, 0}, false},
    {"sphere", SHAPE_SPHERE, {0, 0, 9}, {0, 0, 0}, true, {0, 0, 2}, {0, 0, 1}, {0.5, 0.5}, false},
    {"its right",
     SHAPE_SPHERE,
     {9, 0, 0},
     {0, 0, 0},
     true,
     {2, 0, 0},
     {1, 0, 0},
     {0.75, 0.5},
     false},
    {"its top", SHAPE_SPHERE, {0, 9, 0}, {0, 0, 0}, true, {0, 2, 0}, {0, 1, 0}, {0.5, 1}, false},
    {"from within",
     SHAPE_SPHERE,
     {0, 0, 1},
     {0, 0, 0},
     true,
     {0, 0, -2},
     {0, 0, 1},
     {1, 0.5},
     true},
    {"away from it",
     SHAPE_SPHERE,
     {0, 0, 9},
     {0, 0, 10},
     false,
     {0, 0, 0},
     {0, 0, 0},
     {0, 0},
     false},
    {"past it",
     SHAPE_SPHERE,
     {2.001, 0, 9},
     {2.001, 0, 0},
     false,
     {0, 0, 0},
     {0, 0, 0},
     {0, 0},
     false},
    {"box", SHAPE_BOX, {0.5, 1, 9}, {0.5, 1, 0}, true, {0.5, 1, 3}, {0, 0, 1}, {0.75, 0.75}, false},
    {"its right",
     SHAPE_BOX,
     {9, 1, 1.5},
     {0, 1, 1.5},
     true,
     {1, 1, 1.5},
     {1, 0, 0},
     {0.25, 0.75},
     false},
    {"its left",
     SHAPE_BOX,
     {-9, 1, 1.5},
     {0, 1, 1.5},
     true,
     {-1, 1, 1.5},
     {-1, 0, 0},
     {0.75, 0.75},
     false},
    {"its back",
     SHAPE_BOX,
     {0.5, 1, -9},
     {0.5, 1, 0},
     true,
     {0.5, 1, -3},
     {0, 0, -1},
     {0.25, 0.75},
     false},
    {"its lid",
     SHAPE_BOX,
     {0.5, 9, 1.5},
     {0.5, 0, 1.5},
     true,
     {0.5, 2, 1.5},
     {0, 1, 0},
     {0.75, 0.25},
     false},
    {"its ground",
     SHAPE_BOX,
     {0.5, -9, 1.5},
     {0.5, 0, 1.5},
     true,
     {0.5, -2, 1.5},
     {0, -1, 0},
     {0.75, 0.75},
     false},
    {"from within", SHAPE_BOX, {0, 0, 0}, {0, 1, 0}, true, {0, 2, 0}, {0, -1, 0}, {0.5, 0.5}, true},
    {"past its edge",
     SHAPE_BOX,
     {0.001, 3, 0},
     {4.001, -1, 0},
     false,
     {0, 0, 0},
     {0, 0, 0},
     {0, 0},
     false},
    {"through its edge",
     SHAPE_BOX,
     {-0.001, 3, 0},
     {3.999, -1, 0},
     true,
     {0.999, 2, 0},
     {0, 1, 0},
     {0.9995, 0.5},
     false},
    {"along a side of it",
     SHAPE_BOX,
     {1, 0, 9},
     {1, 0, 0},
     true,
     {1, 0, 3},
     {0, 0, 1},
     {1, 0.5},
     false},
    {"beside it",
     SHAPE_BOX,
     {1.001, 0, 9},
     {1.001, 0, 0},
     false,
     {0, 0, 0},
     {0, 0, 0},
     {0, 0},
     false},
    {"mesh",
     SHAPE_MESH,
     {0.75, 0.25, 9},
     {0.75, 0.25, 0},
     true,
     {0.75, 0.25, 0},
     {0, 0, 1},
     {0.75, 0.25},
     false},
    {"behind it",
     SHAPE_MESH,
     {0, 0, -1},
     {0.25, 0.75, 0},
     true,
     {0.25, 0.75, 0},
     {0, 0, -1},
     {0.25, 0.75},
     true},
    {"between two",
     SHAPE_MESH,
     {0.5, 0.5, 9},
     {0.5, 0.5, 0},
     true,
     {0.5, 0.5, 0},
     {0, 0, 1},
     {0.5, 0.5},
     false},
    {"beside it",
     SHAPE_MESH,
     {1.001, 0.5, 9},
     {1.001, 0.5, 0},
     false,
     {0, 0, 0},
     {0, 0, 0},
     {0, 0},
     false},
};

/* A world of one thing, at (100, -50, 7). */
static void test_shapes(void)
{
    const struct vector place = {100, -50, 7};
    for (size_t i = 0; i < sizeof shape_cases / sizeof shape_cases[0]; i++) {
        const struct shape_case *c = &shape_cases[i];
        struct scene_thing thing = thing_of(c->shape, place);
        thing.mesh = &square;
        const struct scene scene = {.things = &thing, .thing_count = 1};
        struct arena arena = {0};
        struct world world;
        struct error error;
        CHECK(world_open(&scene, whole, &arena, &world, &error));
        struct world_ray ray = {vector_along(c->from, 1, place),
                                vector_unit(vector_minus(c->to, c->from)), 0, INFINITY};
        struct world_hit hit;
        check_at(world_intersect(&world, &ray, &hit) == c->meets, __FILE__, __LINE__, c->what);
        check_at(world_is_unoccluded(&world, &ray) != c->meets, __FILE__, __LINE__, c->what);
        if (c->meets) {
            const struct vector at = vector_minus(hit.at, place);
            const double distance = vector_length(vector_minus(c->at, c->from));
            CHECK_NEAR(vector_length(vector_minus(at, c->at)), 0, 1e-13, c->what);
            CHECK_NEAR(vector_length(vector_minus(hit.normal, c->normal)), 0, 1e-15, c->what);
            CHECK_NEAR(vector_length(vector_minus(hit.face, c->normal)), 0, 1e-15, c->what);
            CHECK_RELATIVE(hit.distance, distance, 1e-14, c->what);
            CHECK_NEAR(hit.place[0], c->place[0], 1e-13, c->what);
            CHECK_NEAR(hit.place[1], c->place[1], 1e-13, c->what);
            check_at(hit.is_back == c->is_back, __FILE__, __LINE__, c->what);
            ray.farthest = distance * (1 - 1e-12);
            check_at(world_is_unoccluded(&world, &ray), __FILE__, __LINE__, c->what);
            check_at(!world_intersect(&world, &ray, &hit), __FILE__, __LINE__, c->what);
        }
        arena_free(&arena);
    }
}

/* Within a box behind a ball that stands in it too, and outside; a square has no inside. */
static void test_enclosed(void)
{
    struct scene_thing things[] = {thing_of(SHAPE_SPHERE, (struct vector){0, 0, 0}),
                                   thing_of(SHAPE_BOX, (struct vector){0, 0, 0}),
                                   thing_of(SHAPE_MESH, (struct vector){0, 0, 0})};
    things[0].radius = 0.4;
    things[2].mesh = &square;
    const struct scene scene = {.things = things, .thing_count = 3};
    struct arena arena = {0};
    struct world world;
    struct error error;
    size_t which;
    CHECK(world_open(&scene, whole, &arena, &world, &error));
    CHECK(world_encloses(&world, (struct vector){0.7, 0.3, 1}, 0, &which) && which == 1);
    CHECK(world_encloses(&world, (struct vector){0.1, 0.2, 0.1}, 0, &which) && which == 0);
    CHECK(!world_encloses(&world, (struct vector){1.3, 0.3, 1}, 0, &which));
    arena_free(&arena);
}

/* What turns by a quarter about z in a second, while it goes up by 3. */
static void test_motion(void)
{
    struct scene_thing thing = thing_of(SHAPE_BOX, (struct vector){10, 0, 0});
    struct scene scene = {.things = &thing, .thing_count = 1};
    CHECK(!scene_moves(&scene));
    thing.where.velocity = (struct vector){0, 3, 0};
    thing.where.axis = (struct vector){0, 0, 1};
    thing.where.spin = acos(0);
    CHECK(scene_moves(&scene));
    struct arena arena = {0};
    struct world world;
    struct error error;
    CHECK(world_open(&scene, whole, &arena, &world, &error));
    /* its right side, x = 1 of itself, looks up after a second, its size of 4 lies along x */
    struct world_ray ray = {{11.9, 20, 0}, {0, -1, 0}, 1, INFINITY};
    struct world_hit hit;
    CHECK(world_intersect(&world, &ray, &hit));
    CHECK_NEAR(hit.at.y, 4, 1e-13, "upper side");
    CHECK_NEAR(hit.normal.y, 1, 1e-15, "its normal");
    CHECK_NEAR(hit.place[1], 0.5 - 1.9 / 4, 1e-13, "upwards in it is to the left now");
    ray.time = 0;
    CHECK(!world_intersect(&world, &ray, &hit));
    thing.shape = SHAPE_SPHERE;
    const struct shape_box box = shape_box(&thing);
    CHECK_NEAR(box.high.z, 2, 0, "half a sphere");
    arena_free(&arena);
}

/* Places that go on beyond a picture begin anew. */
static void test_tiles(void)
{
    static const double tiled[][2] = {{-1, 0}, {2, 0}, {2, 3}, {-1, 3}};
    struct scene_mesh mesh = square;
    mesh.places = tiled;
    struct scene_thing thing = thing_of(SHAPE_MESH, (struct vector){0, 0, 0});
    thing.mesh = &mesh;
    const struct scene scene = {.things = &thing, .thing_count = 1};
    struct arena arena = {0};
    struct world world;
    struct world_hit hit;
    struct error error;
    CHECK(world_open(&scene, whole, &arena, &world, &error));
    const struct world_ray ray = {{0.25, 0.75, 1}, {0, 0, -1}, 0, INFINITY};
    CHECK(world_intersect(&world, &ray, &hit));
    CHECK_NEAR(hit.place[0], 0.75, 1e-15, "-1 + 3 x");
    CHECK_NEAR(hit.place[1], 0.25, 1e-15, "3 y");
    arena_free(&arena);
}

/* Normals that lean to the right by 45 degrees at the left edge, upwards and downwards. */
static void test_normals(void)
{
    const double half = sqrt(0.5);
    for (int sign = -1; sign <= 1; sign += 2) {
        const struct vector left = {sign * half, 0, sign * half}, right = {0, 0, sign};
        const struct vector normals[] = {left, right, right, left};
        struct scene_mesh mesh = square;
        mesh.normals = normals;
        struct scene_thing thing = thing_of(SHAPE_MESH, (struct vector){0, 0, 0});
        thing.mesh = &mesh;
        const struct scene scene = {.things = &thing, .thing_count = 1};
        struct arena arena = {0};
        struct world world;
        struct world_hit hit;
        struct error error;
        CHECK(world_open(&scene, whole, &arena, &world, &error));
        struct world_ray ray = {{1e-9, 0.5, 1}, {0, 0, -1}, 0, INFINITY};
        CHECK(world_intersect(&world, &ray, &hit) && !hit.is_back);
        CHECK_NEAR(hit.normal.x, half, 1e-8, "leans to the right");
        CHECK_NEAR(hit.normal.z, half, 1e-8, "towards the ray");
        CHECK_NEAR(hit.face.z, 1, 1e-15, "the surface itself");
        ray = (struct world_ray){{1e-9, 0.5, -1}, {0, 0, 1}, 0, INFINITY};
        CHECK(world_intersect(&world, &ray, &hit) && hit.is_back);
        CHECK_NEAR(hit.normal.x, -half, 1e-8, "from behind");
        CHECK_NEAR(hit.normal.z, -half, 1e-8, "towards the ray from behind");
        /* a ray that a smooth normal turns away from still sees the surface */
        ray = (struct world_ray){{1, 0.5, 0.5}, vector_unit((struct vector){-1, 0, -0.5}), 0, 9};
        ray.origin.x += 1e-9;
        CHECK(world_intersect(&world, &ray, &hit));
        CHECK(vector_dot(hit.normal, ray.direction) < 0);
        ray =
            (struct world_ray){{-1, 0.5, 0.5}, vector_unit((struct vector){1.001, 0, -0.5}), 0, 9};
        CHECK(world_intersect(&world, &ray, &hit));
        CHECK(vector_dot(hit.normal, ray.direction) < 0);
        CHECK_NEAR(vector_length(hit.normal), 1, 1e-15, "its length");
        arena_free(&arena);
    }
}

int main(void)
{
    test_normals();
    test_tiles();
    test_enclosed();
    test_motion();
    test_shapes();
    return check_report();
}
