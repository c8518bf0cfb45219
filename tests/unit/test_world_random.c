/* tests/unit/test_world_random.c - rays through random scenes, against every thing in turn. */
/* SPDX-License-Identifier: MIT */
#include "scene/world.h"

#include "check.h"
#include "stream.h"

#include <math.h>

enum { THINGS = 60, SCENES = 30, RAYS = 400, FANS = 40 };

static const double span[2] = {-0.5, 0.5};

/* -------- every thing in turn, in longer numbers and by other formulas -------- */

struct far_vector {
    long double x, y, z;
};

static struct far_vector far_of(struct vector a)
{
    return (struct far_vector){a.x, a.y, a.z};
}

static struct far_vector far_along(struct far_vector a, long double s, struct far_vector b)
{
    return (struct far_vector){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static long double far_dot(struct far_vector a, struct far_vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct far_vector far_cross(struct far_vector a, struct far_vector b)
{
    return (struct far_vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* Turned by an angle about an axis, as a product of quaternions. */
static struct far_vector far_turn(struct far_vector a, struct far_vector axis, long double angle)
{
    const long double w = cosl(angle / 2), s = sinl(angle / 2);
    const struct far_vector q = {s * axis.x, s * axis.y, s * axis.z};
    const struct far_vector t = far_cross(q, a), twice = {2 * t.x, 2 * t.y, 2 * t.z};
    return far_along(far_along(a, w, twice), 1, far_cross(q, twice));
}

/* A ray turned back by the motion of a thing, into its own axes. */
static struct far_vector far_in(const struct scene_place *place, double time, struct far_vector a)
{
    const struct far_vector back =
        far_turn(a, far_of(place->axis), -(long double)place->spin * time);
    return (struct far_vector){far_dot(back, far_of(place->turned.x)),
                               far_dot(back, far_of(place->turned.y)),
                               far_dot(back, far_of(place->turned.z))};
}

static long double first_above(long double one, long double other)
{
    return one > 0 && (one < other || !(other > 0)) ? one : other;
}

static long double meet_flat(const struct scene_thing *thing, struct far_vector from,
                             struct far_vector way)
{
    const long double t = -from.z / way.z;
    const struct far_vector at = far_along(from, t, way);
    const bool inside = thing->shape == SHAPE_PLANE ||
                        (thing->shape == SHAPE_DISC && hypotl(at.x, at.y) <= thing->radius) ||
                        (thing->shape == SHAPE_CARD && fabsl(at.x) <= thing->size.x / 2 &&
                         fabsl(at.y) <= thing->size.y / 2);
    return inside ? t : -1;
}

static long double meet_ball(const struct scene_thing *thing, struct far_vector from,
                             struct far_vector way)
{
    const long double b = far_dot(from, way), a = far_dot(way, way);
    const long double c = far_dot(from, from) - (long double)thing->radius * thing->radius;
    const long double root = sqrtl(b * b - a * c);
    return first_above((-b - root) / a, (-b + root) / a);
}

/* Each of the six sides by itself. */
static long double meet_block(const struct scene_thing *thing, struct far_vector from,
                              struct far_vector way)
{
    const long double f[] = {from.x, from.y, from.z}, w[] = {way.x, way.y, way.z};
    const double half[] = {thing->size.x / 2, thing->size.y / 2, thing->size.z / 2};
    long double best = -1;
    for (int side = 0; side < 6; side++) {
        const int k = side / 2, i = (k + 1) % 3, j = (k + 2) % 3;
        const long double t = ((side % 2 == 0 ? half[k] : -half[k]) - f[k]) / w[k];
        if (fabsl(f[i] + t * w[i]) <= half[i] && fabsl(f[j] + t * w[j]) <= half[j]) {
            best = first_above(t, best);
        }
    }
    return best;
}

/* Moeller and Trumbore, triangle by triangle. */
static long double meet_mesh(const struct scene_mesh *mesh, struct far_vector from,
                             struct far_vector way)
{
    long double best = -1;
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const size_t *of = mesh->triangles[i];
        const struct far_vector a = far_of(mesh->corners[of[0]]);
        const struct far_vector e = far_along(far_of(mesh->corners[of[1]]), -1, a);
        const struct far_vector f = far_along(far_of(mesh->corners[of[2]]), -1, a);
        const struct far_vector p = far_cross(way, f), s = far_along(from, -1, a);
        const long double over = 1 / far_dot(e, p), u = far_dot(s, p) * over;
        const struct far_vector q = far_cross(s, e);
        const long double v = far_dot(way, q) * over;
        if (u >= 0 && v >= 0 && u + v <= 1) {
            best = first_above(far_dot(f, q) * over, best);
        }
    }
    return best;
}

static long double meet_thing(const struct scene_thing *thing, const struct world_ray *ray)
{
    const struct scene_place *place = &thing->where;
    const struct far_vector at =
        far_along(far_of(place->at), (long double)ray->time, far_of(place->velocity));
    const struct far_vector from = far_in(place, ray->time, far_along(far_of(ray->origin), -1, at));
    const struct far_vector way = far_in(place, ray->time, far_of(ray->direction));
    return thing->shape == SHAPE_SPHERE ? meet_ball(thing, from, way)
           : thing->shape == SHAPE_BOX  ? meet_block(thing, from, way)
           : thing->shape == SHAPE_MESH ? meet_mesh(thing->mesh, from, way)
                                        : meet_flat(thing, from, way);
}

static long double meet_first(const struct scene *scene, const struct world_ray *ray, size_t *which)
{
    long double best = -1;
    *which = SCENE_NONE;
    for (size_t i = 0; i < scene->thing_count; i++) {
        const long double t = meet_thing(&scene->things[i], ray);
        if (t > 0 && (best < 0 || t < best)) {
            best = t;
            *which = i;
        }
    }
    return best;
}

/* -------- random scenes -------- */

/* Triangles of random corners. */
struct soup {
    struct vector corners[3 * FANS];
    size_t triangles[FANS][3];
    struct scene_mesh mesh;
};

static void fill_soup(struct stream *stream, struct soup *soup)
{
    for (size_t i = 0; i < FANS; i++) {
        const struct vector middle = vector_in(stream, 8);
        for (size_t k = 0; k < 3; k++) {
            soup->corners[3 * i + k] = vector_along(middle, 1, vector_in(stream, 3));
            soup->triangles[i][k] = 3 * i + k;
        }
    }
    soup->mesh = (struct scene_mesh){.file = "soup.obj",
                                     .corner_count = 3 * FANS,
                                     .triangle_count = FANS,
                                     .corners = soup->corners,
                                     .triangles = (const size_t(*)[3])soup->triangles};
}

static void fill_scene(struct stream *stream, struct scene *scene, const struct soup soups[2])
{
    for (size_t i = 0; i < scene->thing_count; i++) {
        const bool moves = next(stream) < 0.5, spins = next(stream) < 0.5;
        struct scene_thing *thing = &scene->things[i];
        *thing = (struct scene_thing){
            .shape = (enum scene_shape)(next(stream) * 6),
            .where = {.at = vector_in(stream, 100),
                      .turned = random_frame(stream),
                      .velocity = vector_in(stream, moves ? 80 : 0),
                      .axis = direction(stream),
                      .spin = spins ? between(stream, -6, 6) : 0},
            .radius = between(stream, 1, 15),
            .size = {between(stream, 1, 30), between(stream, 1, 30), between(stream, 1, 30)},
            .mesh = &soups[next(stream) < 0.5].mesh,
        };
        if (thing->shape == SHAPE_PLANE && i > 2) {
            thing->shape = SHAPE_CARD;
        }
    }
}

/* Distances agree to 1e-10; the point lies there. */
static void check_look(const struct scene *scene, const struct world *world,
                       const struct world_ray *ray)
{
    size_t which;
    struct world_hit hit = {0};
    const long double expected = meet_first(scene, ray, &which);
    const bool met = world_intersect(world, ray, &hit);
    CHECK(met == (which != SCENE_NONE));
    if (met && which != SCENE_NONE) {
        CHECK(hit.thing == which);
        CHECK_RELATIVE(hit.distance, (double)expected, 1e-10, "distance");
        const struct vector at = vector_along(ray->origin, hit.distance, ray->direction);
        CHECK_NEAR(vector_length(vector_minus(hit.at, at)), 0, 1e-9, "place");
        CHECK(vector_dot(hit.face, ray->direction) < 0 &&
              vector_dot(hit.normal, ray->direction) < 0);
    }
    struct world_ray part = *ray;
    part.farthest = which == SCENE_NONE ? 1e9 : (double)expected * (1 - 1e-9);
    CHECK(world_is_unoccluded(world, &part));
    part.farthest = which == SCENE_NONE ? 1e9 : (double)expected * (1 + 1e-9);
    CHECK(world_is_unoccluded(world, &part) == (which == SCENE_NONE));
}

static void test_random(void)
{
    struct stream stream = {1, 0};
    for (size_t i = 0; i < SCENES; i++) {
        struct scene_thing things[THINGS];
        /* none, one, and more and more of them */
        struct scene scene = {.things = things, .thing_count = i * THINGS / (SCENES - 1)};
        struct soup soups[2];
        fill_soup(&stream, &soups[0]);
        fill_soup(&stream, &soups[1]);
        fill_scene(&stream, &scene, soups);
        struct arena arena = {0};
        struct world world;
        struct error error;
        CHECK(world_open(&scene, span, &arena, &world, &error));
        for (size_t k = 0; k < RAYS; k++) {
            const struct vector from = vector_in(&stream, 120);
            const struct vector to = vector_in(&stream, 90);
            const struct world_ray ray = {from, vector_unit(vector_minus(to, from)),
                                          between(&stream, span[0], span[1]), INFINITY};
            check_look(&scene, &world, &ray);
        }
        arena_free(&arena);
    }
}

/* The same scene at rest, where it was at the time of the ray. */
static void test_moved_by_hand(void)
{
    struct stream stream = {2, 0};
    struct scene_thing things[THINGS], still[THINGS];
    struct scene scene = {.things = things, .thing_count = THINGS};
    struct soup soups[2];
    fill_soup(&stream, &soups[0]);
    fill_soup(&stream, &soups[1]);
    fill_scene(&stream, &scene, soups);
    const double time = 0.375;
    for (size_t i = 0; i < THINGS; i++) {
        const struct scene_pose pose = scene_pose_at(&things[i].where, time);
        still[i] = things[i];
        still[i].where = (struct scene_place){.at = pose.at, .turned = pose.turned};
    }
    const struct scene stopped = {.things = still, .thing_count = THINGS};
    struct arena arena = {0};
    struct world moving, resting;
    struct error error;
    CHECK(scene_moves(&scene) && !scene_moves(&stopped));
    CHECK(world_open(&scene, span, &arena, &moving, &error));
    CHECK(world_open(&stopped, span, &arena, &resting, &error));
    for (size_t k = 0; k < RAYS; k++) {
        const struct world_ray ray = {vector_in(&stream, 100), direction(&stream), time, INFINITY};
        struct world_hit a = {0}, b = {0};
        CHECK(world_intersect(&moving, &ray, &a) == world_intersect(&resting, &ray, &b));
        CHECK_NEAR(a.distance, b.distance, 0, "distance, moving and at rest");
    }
    arena_free(&arena);
}

int main(void)
{
    test_random();
    test_moved_by_hand();
    return check_report();
}
