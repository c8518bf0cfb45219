/* scene/world.c - scene geometry made ready for rays: intersection and occlusion. */
/* SPDX-License-Identifier: MIT */
#include "scene/world.h"

#include "scene/bvh_traversal.h"

#include <stdlib.h>

/* -------- made ready -------- */

static bool fail_at_thing(struct error *error, const struct scene_thing *thing)
{
    return error_locate(error, thing->place.source, thing->place.line, thing->place.column);
}

/* All of it where numbers reach. */
static bool check_box(const struct scene_thing *thing, const struct shape_box *box,
                      struct error *error)
{
    const double away = fmax(vector_taxi(box->low), vector_taxi(box->high));
    if (away <= WORLD_REACH) {
        return true;
    }
    fail(error, ERROR_DOMAIN,
         "a thing reaches %.3g mm from the middle of the scene: it must be within %g mm", away,
         WORLD_REACH);
    return fail_at_thing(error, thing);
}

/* A mesh that numbers can hold. */
static bool check_mesh(const struct scene_thing *thing, struct error *error)
{
    const struct scene_mesh *mesh = thing->mesh;
    if (mesh->triangle_count > WORLD_MOST || mesh->corner_count > WORLD_MOST) {
        fail(error, ERROR_DOMAIN, "a mesh of %zu triangles and %zu corners: there may be %u",
             mesh->triangle_count, mesh->corner_count, WORLD_MOST);
        return fail_at_thing(error, thing);
    }
    for (size_t i = 0; i < mesh->corner_count; i++) {
        const double away = vector_taxi(mesh->corners[i]);
        if (!(away <= WORLD_REACH)) {
            fail(error, ERROR_DOMAIN,
                 "corner %zu of a mesh lies %.3g mm from its origin: it must be within %g mm",
                 i + 1, away, WORLD_REACH);
            return fail_at_thing(error, thing);
        }
    }
    return true;
}

static int by_mesh(const void *a, const void *b)
{
    const uintptr_t p = (uintptr_t)(*(struct world_thing *const *)a)->thing->mesh;
    const uintptr_t q = (uintptr_t)(*(struct world_thing *const *)b)->thing->mesh;
    return (p > q) - (p < q);
}

static bool open_mesh(struct world *world, struct world_thing *thing, struct arena *arena,
                      struct error *error)
{
    if (!check_mesh(thing->thing, error)) {
        return false;
    }
    struct mesh *mesh = ARENA_NEW(arena, struct mesh);
    mesh_open(thing->thing->mesh, arena, mesh);
    world->degenerate += mesh->degenerate;
    thing->mesh = mesh;
    return true;
}

/* What a frame's box reaches along an axis of the world, to both sides of its middle. */
static double box_reach(double x, double y, double z, struct vector half)
{
    return fabs(x) * half.x + fabs(y) * half.y + fabs(z) * half.z;
}

/* Everywhere it is during the span. */
static struct shape_box world_thing_box(const struct world *world, const struct world_thing *thing)
{
    const struct shape_box own = thing->mesh != NULL ? thing->mesh->box : shape_box(thing->thing);
    const struct scene_pose begin = scene_pose_at(&thing->thing->where, world->span[0]);
    const struct scene_pose end = scene_pose_at(&thing->thing->where, world->span[1]);
    struct vector half = vector_times(0.5, vector_minus(own.high, own.low));
    struct vector middle = vector_along(own.low, 1, half);
    if (thing->thing->where.spin != 0) {
        /* the ball that it stays in */
        const double r = vector_length(half) + vector_length(middle);
        half = (struct vector){r, r, r};
        middle = (struct vector){0, 0, 0};
    } else {
        const struct frame *turned = &begin.turned;
        middle = frame_out(turned, middle);
        half = (struct vector){box_reach(turned->x.x, turned->y.x, turned->z.x, half),
                               box_reach(turned->x.y, turned->y.y, turned->z.y, half),
                               box_reach(turned->x.z, turned->y.z, turned->z.z, half)};
    }
    const struct vector low = {fmin(begin.at.x, end.at.x), fmin(begin.at.y, end.at.y),
                               fmin(begin.at.z, end.at.z)};
    const struct vector high = {fmax(begin.at.x, end.at.x), fmax(begin.at.y, end.at.y),
                                fmax(begin.at.z, end.at.z)};
    return (struct shape_box){vector_minus(vector_along(low, 1, middle), half),
                              vector_along(vector_along(high, 1, middle), 1, half)};
}

/* The tree of what has an end, and the list of what has none. */
static bool open_tree(struct world *world, struct arena *arena, struct error *error)
{
    const size_t most = world->scene->thing_count;
    struct arena work = {0};
    struct bvh_box *boxes = arena_array(&work, most, sizeof *boxes);
    uint32_t *bounded = ARENA_ARRAY(arena, most, uint32_t);
    uint32_t *endless = ARENA_ARRAY(arena, most, uint32_t);
    size_t count = 0;
    bool good = true;
    for (size_t i = 0; i < most && good; i++) {
        const struct world_thing *thing = &world->things[i];
        if (thing->thing->shape == SHAPE_PLANE) {
            endless[world->endless_count++] = (uint32_t)i;
            continue;
        }
        if (thing->mesh != NULL && thing->mesh->tree.count == 0) {
            continue;
        }
        const struct shape_box box = world_thing_box(world, thing);
        const double room = 0x1p-40 * fmax(vector_taxi(box.low), vector_taxi(box.high));
        good = check_box(thing->thing, &box, error);
        boxes[count] = bvh_box_of(box.low, box.high, room);
        bounded[count++] = (uint32_t)i;
    }
    if (good) {
        bvh_open(boxes, count, 1, arena, &world->tree);
    }
    world->bounded = bounded;
    world->endless = endless;
    arena_free(&work);
    return good;
}

bool world_open(const struct scene *scene, const double span[2], struct arena *arena,
                struct world *world, struct error *error)
{
    *world = (struct world){
        .scene = scene,
        .span = {span[0], span[1]},
        .things = ARENA_ARRAY(arena, scene->thing_count, struct world_thing),
    };
    if (scene->thing_count > WORLD_MOST) {
        return fail(error, ERROR_DOMAIN, "%zu things: there may be %u", scene->thing_count,
                    WORLD_MOST);
    }
    for (size_t i = 0; i < scene->thing_count; i++) {
        const struct scene_thing *thing = &scene->things[i];
        world->things[i] = (struct world_thing){.thing = thing,
                                                .pose = scene_pose_at(&thing->where, 0),
                                                .moves = scene_place_moves(&thing->where)};
    }
    /* things that have the same mesh share its tree */
    struct arena work = {0};
    struct world_thing **with = ARENA_ARRAY(&work, world->scene->thing_count, struct world_thing *);
    size_t count = 0;
    for (size_t i = 0; i < world->scene->thing_count; i++) {
        if (world->things[i].thing->shape == SHAPE_MESH) {
            with[count++] = &world->things[i];
        }
    }
    qsort(with, count, sizeof *with, by_mesh);
    bool good = true;
    for (size_t i = 0; i < count && good; i++) {
        if (i > 0 && with[i]->thing->mesh == with[i - 1]->thing->mesh) {
            with[i]->mesh = with[i - 1]->mesh;
        } else {
            good = open_mesh(world, with[i], arena, error);
        }
    }
    arena_free(&work);
    if (!good) {
        return false;
    }
    return open_tree(world, arena, error);
}

/* -------- rays -------- */

static struct scene_pose pose_of(const struct world_thing *thing, double time)
{
    return thing->moves ? scene_pose_at(&thing->thing->where, time) : thing->pose;
}

/* The ray in the frame of a thing. */
static struct shape_ray turned_in(const struct scene_pose *pose, const struct world_ray *ray)
{
    return (struct shape_ray){frame_in(&pose->turned, vector_minus(ray->origin, pose->at)),
                              frame_in(&pose->turned, ray->direction), ray->farthest};
}

static bool world_thing_intersect(const struct world_thing *thing, const struct world_ray *ray,
                                  bool is_any, struct shape_hit *meeting)
{
    const struct scene_pose pose = pose_of(thing, ray->time);
    const struct shape_ray own = turned_in(&pose, ray);
    return thing->mesh != NULL ? mesh_intersect(thing->mesh, &own, is_any, meeting)
                               : shape_intersect(thing->thing, &own, meeting);
}

/* Which thing a ray meets first, or any; SCENE_NONE. */
static size_t world_nearest(const struct world *world, const struct world_ray *ray, bool is_any,
                            struct shape_hit *nearest)
{
    struct world_ray rest = *ray;
    struct shape_hit meeting = {0};
    size_t which = SCENE_NONE;
    for (size_t i = 0; i < world->endless_count; i++) {
        if (world_thing_intersect(&world->things[world->endless[i]], &rest, is_any, &meeting)) {
            which = world->endless[i];
            *nearest = meeting;
            rest.farthest = meeting.distance;
        }
    }
    struct bvh_traversal walk;
    struct bvh_pending leaf;
    bvh_traversal_start(&walk, &world->tree, ray->origin, ray->direction);
    while (!(is_any && which != SCENE_NONE) && bvh_traversal_next(&walk, rest.farthest, &leaf)) {
        const size_t thing = world->bounded[world->tree.items[leaf.child]];
        if (world_thing_intersect(&world->things[thing], &rest, is_any, &meeting)) {
            which = thing;
            *nearest = meeting;
            rest.farthest = meeting.distance;
        }
    }
    return which;
}

/* Towards the side that the ray came from, also where a smooth normal would turn away from it. */
static struct vector normal_facing(struct vector normal, double sign, struct vector direction)
{
    const struct vector turned = vector_times(sign, normal);
    const double along = vector_dot(turned, direction), least = -1e-6;
    return along < least ? turned : vector_unit(vector_along(turned, least - along, direction));
}

bool world_intersect(const struct world *world, const struct world_ray *ray, struct world_hit *hit)
{
    struct shape_hit nearest = {0};
    const size_t which = world_nearest(world, ray, false, &nearest);
    if (which == SCENE_NONE) {
        return false;
    }
    /* All about where a ray met something. */
    const struct shape_hit *meeting = &nearest;
    const struct world_thing *thing = &world->things[which];
    const struct scene_pose pose = pose_of(thing, ray->time);
    const struct shape_ray own = turned_in(&pose, ray);
    const struct shape_surface spot = thing->mesh != NULL
                                          ? mesh_surface(thing->mesh, meeting)
                                          : shape_surface(thing->thing, &own, meeting);
    const bool is_back = vector_dot(own.direction, spot.face) > 0;
    const double sign = is_back ? -1 : 1;
    const struct vector at = vector_along(frame_out(&pose.turned, spot.at), 1, pose.at);
    const struct vector face = frame_out(&pose.turned, vector_times(sign, spot.face));
    *hit = (struct world_hit){
        .distance = meeting->distance,
        .at = at,
        .normal = normal_facing(frame_out(&pose.turned, spot.normal), sign, ray->direction),
        .face = face,
        .is_back = is_back,
        .thing = which,
        .triangle = thing->mesh != NULL ? meeting->part : 0,
        .place = {spot.place[0], spot.place[1]},
        .slack = 0x1p-46 * (vector_taxi(at) + spot.size),
    };
    return true;
}

bool world_is_unoccluded(const struct world *world, const struct world_ray *ray)
{
    struct shape_hit any;
    return world_nearest(world, ray, true, &any) == SCENE_NONE;
}

/* -------- enclosed -------- */

enum { DIRECTIONS = 256, PASSED_MOST = 16 };

/* One of so many directions, evenly on a sphere, by the golden angle. */
static struct vector direction_at(int i)
{
    const double up = (2 * i + 1.0) / DIRECTIONS - 1, wide = sqrt(1 - up * up);
    const double turn = 2.39996322972865332 * i;
    return (struct vector){wide * cos(turn), wide * sin(turn), up};
}

/* The things that a ray passes through one after the other, so many at most. */
static size_t things_along(const struct world *world, struct world_ray ray,
                           size_t things[PASSED_MOST])
{
    struct world_hit hit;
    size_t count = 0;
    while (count < PASSED_MOST && world_intersect(world, &ray, &hit)) {
        things[count++] = hit.thing;
        ray.origin = vector_along(hit.at, -hit.slack, hit.face);
    }
    return count;
}

static bool is_all_around(const struct world *world, struct world_ray ray, size_t thing)
{
    bool is_met = true;
    for (int i = 1; i < DIRECTIONS && is_met; i++) {
        size_t things[PASSED_MOST];
        ray.direction = direction_at(i);
        const size_t count = things_along(world, ray, things);
        is_met = false;
        for (size_t k = 0; k < count; k++) {
            is_met = is_met || things[k] == thing;
        }
    }
    return is_met;
}

bool world_encloses(const struct world *world, struct vector at, double time, size_t *thing)
{
    const struct world_ray ray = {
        .origin = at, .direction = direction_at(0), .time = time, .farthest = INFINITY};
    size_t things[PASSED_MOST];
    const size_t count = things_along(world, ray, things);
    for (size_t k = 0; k < count; k++) {
        if (is_all_around(world, ray, things[k])) {
            *thing = things[k];
            return true;
        }
    }
    return false;
}
