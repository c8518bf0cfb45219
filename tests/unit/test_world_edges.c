/* tests/unit/test_world_edges.c - scenes where rounding decides: edges, sizes, thin things. */
/* SPDX-License-Identifier: MIT */
#include "scene/world.h"

#include "check.h"
#include "stream.h"

#include <math.h>

static const double span[2] = {0, 0};
static const struct frame upright = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

static void open_world(const struct scene *scene, struct arena *arena, struct world *world)
{
    struct error error;
    CHECK(world_open(scene, span, arena, world, &error));
}

/* -------- closed meshes -------- */

/* A globe with hills: points of a pole lie together, so that half the triangles there are none. */
enum { ROWS = 24, COLUMNS = 48 };

struct globe {
    struct vector corners[(ROWS + 1) * COLUMNS];
    size_t triangles[2 * ROWS * COLUMNS][3];
    struct scene_mesh mesh;
};

static void fill_globe(struct globe *globe, double size, double hills)
{
    size_t count = 0;
    for (size_t i = 0; i <= ROWS; i++) {
        for (size_t j = 0; j < COLUMNS; j++) {
            const double down = PI * (double)i / ROWS, turn = 2 * PI * (double)j / COLUMNS;
            const bool is_pole = i == 0 || i == ROWS;
            const double r = size * (1 + (is_pole ? 0 : hills * sin(5 * turn) * sin(9 * down)));
            const double side = is_pole ? 0 : r * sin(down);
            globe->corners[i * COLUMNS + j] =
                (struct vector){side * cos(turn), r * cos(down), side * sin(turn)};
        }
    }
    for (size_t i = 0; i < ROWS; i++) {
        for (size_t j = 0; j < COLUMNS; j++) {
            const size_t a = i * COLUMNS + j, b = i * COLUMNS + (j + 1) % COLUMNS;
            const size_t of[2][3] = {{a, b, a + COLUMNS}, {b, b + COLUMNS, a + COLUMNS}};
            for (size_t k = 0; k < 6; k++) {
                globe->triangles[count + k / 3][k % 3] = of[k / 3][k % 3];
            }
            count += 2;
        }
    }
    globe->mesh = (struct scene_mesh){.file = "globe.obj",
                                      .corner_count = (ROWS + 1) * COLUMNS,
                                      .triangle_count = count,
                                      .corners = globe->corners,
                                      .triangles = (const size_t(*)[3])globe->triangles};
}

/* From within towards a corner, to somewhere on an edge, or anywhere: on the globe itself. */
static struct vector aim(const struct globe *globe, struct stream *stream, size_t i)
{
    const size_t *of = globe->triangles[(size_t)(next(stream) * 2 * ROWS * COLUMNS)];
    const struct vector a = globe->corners[of[0]], b = globe->corners[of[1]];
    const double share = i % 4 == 0 ? 0 : i % 4 == 1 ? 0.5 : next(stream);
    return i % 4 < 3 ? vector_along(vector_times(1 - share, a), share, b)
                     : vector_times(vector_length(a), direction(stream));
}

static const struct tight_case {
    const char *what;
    double size;
    struct vector at;
    size_t rays;
} tight_cases[] = {
    {"at the origin", 1, {0, 0, 0}, 600000},     {"small", 1e-3, {0, 0, 0}, 100000},
    {"large", 1e9, {0, 0, 0}, 100000},           {"far away", 1, {1e6, -1e7, 1e5}, 100000},
    {"small and far", 1e-3, {1e6, 0, 0}, 50000}, {"large and far", 1e9, {1e12, 1e9, 0}, 50000},
};

/* Not one ray leaves a closed mesh. */
static void test_tight(void)
{
    static struct globe globe;
    struct stream stream = {3, 0};
    for (size_t k = 0; k < sizeof tight_cases / sizeof tight_cases[0]; k++) {
        const struct tight_case *c = &tight_cases[k];
        fill_globe(&globe, c->size, 0.1);
        struct scene_thing thing = {.shape = SHAPE_MESH, .mesh = &globe.mesh};
        /* straight ones meet edges exactly, turned ones by rounded numbers */
        thing.where = (struct scene_place){.at = c->at,
                                           .turned = k % 2 == 0 ? upright : random_frame(&stream)};
        const struct scene scene = {.things = &thing, .thing_count = 1};
        struct arena arena = {0};
        struct world world;
        open_world(&scene, &arena, &world);
        CHECK(world.degenerate == 2 * COLUMNS);
        size_t leaks = 0;
        for (size_t i = 0; i < c->rays; i++) {
            const struct vector to = frame_out(&thing.where.turned, aim(&globe, &stream, i));
            const struct vector from = vector_in(&stream, 0.4 * c->size);
            struct world_ray ray = {i % 8 < 4 ? c->at : vector_along(c->at, 1, from),
                                    vector_unit(vector_minus(to, from)), 0, INFINITY};
            leaks += world_is_unoccluded(&world, &ray) ? 1 : 0;
        }
        CHECK_NEAR((double)leaks, 0, 0, c->what);
        arena_free(&arena);
    }
}

/* -------- rays that leave a surface -------- */

/* Directions over a face, steep, shallow and along it. */
static struct vector over(struct stream *stream, struct vector face, size_t i)
{
    static const double rises[] = {1, 0.1, 1e-3, 1e-6, 1e-9, 1e-15};
    const struct vector any = direction(stream);
    const struct vector along =
        vector_unit(vector_minus(any, vector_times(vector_dot(any, face), face)));
    return vector_unit(vector_along(along, rises[i % 6], face));
}

/* Convex things seen from outside are never met again. */
static void leave_thing(const struct scene_thing *thing, struct stream *stream, const char *what)
{
    const struct scene scene = {.things = (struct scene_thing *)thing, .thing_count = 1};
    struct arena arena = {0};
    struct world world;
    open_world(&scene, &arena, &world);
    size_t met = 0, again = 0;
    double worst = 0;
    for (size_t i = 0; i < 3000; i++) {
        const double away = pow(10, between(stream, 0.6, 3)) * thing->radius;
        const struct vector to = vector_in(stream, 0.8 * thing->radius);
        const struct vector from = vector_times(away, direction(stream));
        struct world_ray ray = {vector_along(thing->where.at, 1, from),
                                vector_unit(vector_minus(to, from)), 0, INFINITY};
        struct world_hit hit;
        if (!world_intersect(&world, &ray, &hit)) {
            continue;
        }
        met++;
        worst = fmax(worst, hit.slack / (vector_length(hit.at) + vector_length(thing->where.at)));
        ray.origin = world_ray_origin(&hit);
        /* the least rise is less than a unit of rounding: without end it may go down */
        ray.direction = over(stream, hit.face, thing->shape == SHAPE_PLANE ? i % 6 % 5 : i);
        again += world_is_unoccluded(&world, &ray) ? 0 : 1;
    }
    check_at(met > 200, __FILE__, __LINE__, what);
    CHECK_NEAR((double)again, 0, 0, what);
    CHECK(worst < 1e-13);
    arena_free(&arena);
}

static void test_leaving(void)
{
    static const char *const names[] = {"plane", "disc", "card", "sphere", "box", "mesh"};
    static const double sizes[] = {1e-3, 1, 1e4, 1e9};
    static struct globe globe;
    struct stream stream = {4, 0};
    for (size_t i = 0; i < 24; i++) {
        const double size = sizes[i / 6];
        fill_globe(&globe, size, 0);
        for (size_t far = 0; far < 3; far++) {
            struct scene_thing thing = {.shape = (enum scene_shape)(i % 6),
                                        .where = {.turned = random_frame(&stream)},
                                        .radius = size,
                                        .size = {size, 2 * size, 1.5 * size},
                                        .mesh = &globe.mesh};
            const double away = far == 0 ? 0 : far == 1 ? 100 * size : 1e6 * size;
            thing.where.at = vector_times(away, direction(&stream));
            leave_thing(&thing, &stream, names[i % 6]);
        }
    }
}

/* Triangles a million times as long as wide: the next ray is not even in doubt about them. */
static void test_slivers(void)
{
    static const size_t one[][3] = {{0, 1, 2}};
    struct stream stream = {8, 0};
    size_t met = 0, again = 0;
    for (size_t i = 0; i < 3000; i++) {
        const struct frame frame = random_frame(&stream);
        const struct vector at = vector_in(&stream, 10);
        const struct vector corners[] = {
            at, vector_along(at, 100, frame.x),
            vector_along(vector_along(at, between(&stream, 0, 100), frame.x), 1e-4, frame.y)};
        const struct scene_mesh sliver = {
            .corner_count = 3, .triangle_count = 1, .corners = corners, .triangles = one};
        struct scene_thing thing = {.shape = SHAPE_MESH, .where.turned = upright, .mesh = &sliver};
        const struct scene scene = {.things = &thing, .thing_count = 1};
        struct arena arena = {0};
        struct world world;
        open_world(&scene, &arena, &world);
        const struct vector middle =
            vector_along(vector_times(0.4, corners[0]), 1,
                         vector_along(vector_times(0.3, corners[1]), 0.3, corners[2]));
        const struct vector from = vector_along(middle, 1000, direction(&stream));
        struct world_ray ray = {from, vector_unit(vector_minus(middle, from)), 0, INFINITY};
        struct world_hit hit;
        if (world_intersect(&world, &ray, &hit)) {
            met++;
            ray.origin = world_ray_origin(&hit);
            ray.direction = over(&stream, hit.face, i);
            again += world_is_unoccluded(&world, &ray) ? 0 : 1;
        }
        arena_free(&arena);
    }
    CHECK(met > 2900);
    CHECK_NEAR((double)again, 0, 0, "slivers met again");
}

/* Within a sphere: a ray at the angle c to the normal ends 2 r c farther. */
static void test_within(void)
{
    struct stream stream = {5, 0};
    struct scene_thing thing = {
        .shape = SHAPE_SPHERE, .where = {.at = {1e3, 0, 0}, .turned = upright}, .radius = 7};
    const struct scene scene = {.things = &thing, .thing_count = 1};
    struct arena arena = {0};
    struct world world;
    open_world(&scene, &arena, &world);
    for (size_t i = 0; i < 2000; i++) {
        struct world_ray ray = {thing.where.at, direction(&stream), 0, INFINITY};
        struct world_hit hit;
        CHECK(world_intersect(&world, &ray, &hit) && hit.is_back);
        ray.origin = world_ray_origin(&hit);
        ray.direction = over(&stream, hit.face, i % 6 < 4 ? i : 0);
        const double c = vector_dot(ray.direction, hit.face), slack = hit.slack;
        CHECK(world_intersect(&world, &ray, &hit) && hit.is_back);
        const double more = fmin(slack / c, sqrt(14 * slack));
        CHECK_NEAR(hit.distance, 14 * c, 1.01 * more + 1e-13, "chord");
    }
    arena_free(&arena);
}

/* -------- thin, flat, far and grazing -------- */

static void test_thin(void)
{
    static const double thin[] = {1e-3, 1e-9, 1e-15, 1e-300};
    for (size_t i = 0; i < 4; i++) {
        struct scene_thing thing = {.shape = SHAPE_BOX,
                                    .where = {.at = {10, 20, 30}, .turned = upright},
                                    .radius = 1,
                                    .size = {1, 1, thin[i]}};
        const struct scene scene = {.things = &thing, .thing_count = 1};
        struct stream stream = {6, 0};
        struct arena arena = {0};
        struct world world;
        open_world(&scene, &arena, &world);
        size_t missed = 0;
        for (size_t k = 0; k < 1000; k++) {
            const struct vector to = {between(&stream, 9.501, 10.499),
                                      between(&stream, 19.501, 20.499), 30};
            const struct vector from = vector_along(to, k % 2 == 0 ? 5 : -5, direction(&stream));
            const struct world_ray ray = {from, vector_unit(vector_minus(to, from)), 0, INFINITY};
            missed += world_is_unoccluded(&world, &ray) ? 1 : 0;
        }
        CHECK_NEAR((double)missed, 0, 0, "thin box");
        leave_thing(&thing, &stream, "thin box");
        arena_free(&arena);
    }
}

/* Far away a ray still knows on which side of the rim it passes. */
static void test_grazing(void)
{
    struct scene_thing thing = {.shape = SHAPE_SPHERE, .where = {.turned = upright}, .radius = 1};
    const struct scene scene = {.things = &thing, .thing_count = 1};
    struct arena arena = {0};
    struct world world;
    open_world(&scene, &arena, &world);
    for (double away = 2; away < 1e10; away *= 10) {
        for (double rim = 1e-3; rim > 1e-14; rim /= 10) {
            struct world_hit hit;
            struct world_ray ray = {{1 - rim, 0, away}, {0, 0, -1}, 0, INFINITY};
            CHECK(world_intersect(&world, &ray, &hit));
            const double x = ray.origin.x, z = sqrt((1 - x) * (1 + x));
            CHECK_NEAR(hit.distance, away - z, 4e-16 * away, "distance");
            CHECK_NEAR(hit.at.z, z, 1e-9 + 4e-16 * away, "height over the middle");
            ray.origin.x = 1 + rim;
            CHECK(world_is_unoccluded(&world, &ray));
        }
    }
    arena_free(&arena);
}

/* -------- trees that cannot be balanced -------- */

static void test_piles(void)
{
    enum { PILE = 3000 };
    static struct scene_thing things[PILE];
    struct scene scene = {.things = things, .thing_count = PILE};
    struct arena arena = {0};
    struct world world;
    struct world_hit hit;
    const struct world_ray ray = {{0.1, 0.2, -1e20}, {0, 0, 1}, 0, INFINITY};
    /* all in one place */
    for (size_t i = 0; i < PILE; i++) {
        things[i] =
            (struct scene_thing){.shape = SHAPE_SPHERE, .where.turned = upright, .radius = 1};
    }
    open_world(&scene, &arena, &world);
    CHECK(world_intersect(&world, &ray, &hit));
    CHECK(!world_intersect(&world, &(struct world_ray){{2, 0, -9}, {0, 0, 1}, 0, INFINITY}, &hit));
    /* each a hundredth larger and farther than the one before it: the first is met first */
    for (size_t i = 0; i < PILE; i++) {
        const double far = pow(1.015, (double)i);
        things[i].where.at = (struct vector){0, 0, far};
        things[i].radius = 0.005 * far;
    }
    open_world(&scene, &arena, &world);
    const struct world_ray along = {{0, 0, -1}, {0, 0, 1}, 0, INFINITY};
    CHECK(world_intersect(&world, &along, &hit) && hit.thing == 0);
    CHECK_NEAR(hit.distance, 1.995, 1e-15, "the first of them");
    const struct world_ray back = {{0, 0, 1e20}, {0, 0, -1}, 0, INFINITY};
    CHECK(world_intersect(&world, &back, &hit) && hit.thing == PILE - 1);
    arena_free(&arena);
}

/* -------- what isn't there -------- */

static const struct vector line[] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
static const size_t flat[][3] = {{0, 1, 2}, {0, 0, 3}, {1, 1, 1}};

/* A mesh of triangles without area, and one of none. */
static void test_nothing(void)
{
    struct scene_mesh meshes[2] = {
        {.corner_count = 4, .triangle_count = 3, .corners = line, .triangles = flat}, {0}};
    struct scene_thing things[2];
    for (size_t i = 0; i < 2; i++) {
        things[i] =
            (struct scene_thing){.shape = SHAPE_MESH, .where.turned = upright, .mesh = &meshes[i]};
    }
    const struct scene scene = {.things = things, .thing_count = 2};
    struct arena arena = {0};
    struct world world;
    open_world(&scene, &arena, &world);
    CHECK(world.degenerate == 3);
    const struct world_ray ray = {{0.5, 0, 1}, {0, 0, -1}, 0, INFINITY};
    CHECK(world_is_unoccluded(&world, &ray));
    const struct world_ray lost = {{NAN, 0, 1}, {0, NAN, -1}, 0, INFINITY};
    CHECK(world_is_unoccluded(&world, &lost));
    arena_free(&arena);
}

/* A third of a card is there, and what is there for one ray is there for all. */
static void test_alpha(void)
{
    enum { RAYS = 40000 };
    float pixels[] = {1, 1, 1, 1.0F / 3};
    const struct image picture = {.width = 1, .height = 1, .channels = 4, .pixels = pixels};
    struct scene_thing thing = {.shape = SHAPE_CARD,
                                .where = {.at = {0, 0, -5}, .turned = upright},
                                .size = {2, 2, 0},
                                .picture = &picture};
    const struct scene scene = {.things = &thing, .thing_count = 1};
    struct stream stream = {7, 0};
    struct arena arena = {0};
    struct world world;
    open_world(&scene, &arena, &world);
    size_t met = 0;
    for (size_t i = 0; i < RAYS; i++) {
        const struct vector to = {between(&stream, -1, 1), between(&stream, -1, 1), -5};
        const struct world_ray ray = {{to.x, to.y, 3}, {0, 0, -1}, 0, INFINITY};
        const struct world_ray back = {{to.x, to.y, -9}, {0, 0, 1}, 0, INFINITY};
        const bool meets = !world_is_unoccluded(&world, &ray);
        met += meets ? 1 : 0;
        CHECK(meets == !world_is_unoccluded(&world, &back));
    }
    CHECK_NEAR((double)met / RAYS, 1.0 / 3, 4 * sqrt(2.0 / 9 / RAYS), "share of the card");
    arena_free(&arena);
}

static void test_too_far(void)
{
    struct scene_thing thing = {.shape = SHAPE_SPHERE,
                                .where = {.at = {0, -2e30, 0}, .turned = upright},
                                .radius = 1,
                                .place = {"far.scene", 7, 3}};
    const struct scene scene = {.things = &thing, .thing_count = 1};
    struct arena arena = {0};
    struct world world;
    struct error error;
    CHECK(!world_open(&scene, span, &arena, &world, &error));
    CHECK(error.code == ERROR_DOMAIN && error.line == 7);
    CHECK_TEXT(error.source, "far.scene");
    thing.where.at.y = NAN;
    CHECK(!world_open(&scene, span, &arena, &world, &error));
    /* a mesh whose own numbers are too large, or none */
    static const double bad[] = {3e300, NAN, -INFINITY};
    for (size_t i = 0; i < 3; i++) {
        const struct vector corners[] = {{0, 0, 0}, {1, 0, 0}, {0, bad[i], 0}};
        static const size_t one[][3] = {{0, 1, 2}};
        const struct scene_mesh mesh = {
            .corner_count = 3, .triangle_count = 1, .corners = corners, .triangles = one};
        thing.shape = SHAPE_MESH;
        thing.where.at.y = 0;
        thing.mesh = &mesh;
        CHECK(!world_open(&scene, span, &arena, &world, &error));
        CHECK(error.code == ERROR_DOMAIN && error.line == 7);
    }
    arena_free(&arena);
}

int main(void)
{
    test_tight();
    test_leaving();
    test_slivers();
    test_within();
    test_thin();
    test_grazing();
    test_piles();
    test_nothing();
    test_alpha();
    test_too_far();
    return check_report();
}
