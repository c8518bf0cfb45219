/* scene/world.c - a scene made ready for rays: what they meet, and where. */
/* SPDX-License-Identifier: MIT */
#include "scene/world.h"

/* -------- made ready -------- */

bool world_open(const struct scene *scene, const double span[2], struct arena *arena,
                struct world *world, struct error *error)
{
    (void)error;
    *world = (struct world){
        .scene = scene,
        .span = {span[0], span[1]},
        .things = ARENA_ARRAY(arena, scene->thing_count, struct world_thing),
    };
    for (size_t i = 0; i < scene->thing_count; i++) {
        const struct scene_thing *thing = &scene->things[i];
        struct world_thing *made = &world->things[i];
        *made = (struct world_thing){.thing = thing,
                                     .pose = scene_pose_at(&thing->where, 0),
                                     .moves = scene_place_moves(&thing->where)};
        if (thing->shape == SHAPE_MESH) {
            struct mesh *mesh = ARENA_NEW(arena, struct mesh);
            mesh_open(thing->mesh, arena, mesh);
            world->degenerate += mesh->degenerate;
            made->mesh = mesh;
        }
    }
    return true;
}

/* -------- rays -------- */

static struct scene_pose pose_of(const struct world_thing *thing, double time)
{
    return thing->moves ? scene_pose_at(&thing->thing->where, time) : thing->pose;
}

/* The ray in the frame of a thing. */
static struct shape_ray turned_in(const struct scene_pose *pose, const struct world_ray *ray)
{
    return (struct shape_ray){frame_in(&pose->turned, vector_minus(ray->from, pose->at)),
                              frame_in(&pose->turned, ray->way), ray->farthest};
}

static bool meet(const struct world_thing *thing, const struct world_ray *ray,
                 struct shape_meeting *meeting)
{
    const struct scene_pose pose = pose_of(thing, ray->time);
    const struct shape_ray own = turned_in(&pose, ray);
    return thing->mesh != NULL ? mesh_meet(thing->mesh, &own, meeting)
                               : shape_meet(thing->thing, &own, meeting);
}

/* Towards the side that the ray came from, also where a smooth normal would turn away from it. */
static struct vector facing(struct vector normal, double sign, struct vector way)
{
    const struct vector turned = vector_times(sign, normal);
    const double along = vector_dot(turned, way), least = -1e-6;
    return along < least ? turned : vector_unit(vector_along(turned, least - along, way));
}

/* All about where a ray met something. */
static void describe(const struct world *world, const struct world_ray *ray, size_t which,
                     const struct shape_meeting *meeting, struct world_hit *hit)
{
    const struct world_thing *thing = &world->things[which];
    const struct scene_pose pose = pose_of(thing, ray->time);
    const struct shape_ray own = turned_in(&pose, ray);
    const struct shape_spot spot = thing->mesh != NULL ? mesh_spot(thing->mesh, meeting)
                                                       : shape_spot(thing->thing, &own, meeting);
    const bool is_back = vector_dot(own.way, spot.face) > 0;
    const double sign = is_back ? -1 : 1;
    const struct vector at = vector_along(frame_out(&pose.turned, spot.at), 1, pose.at);
    const struct vector face = frame_out(&pose.turned, vector_times(sign, spot.face));
    *hit = (struct world_hit){
        .distance = meeting->distance,
        .at = at,
        .normal = facing(frame_out(&pose.turned, spot.normal), sign, ray->way),
        .face = face,
        .is_back = is_back,
        .thing = which,
        .triangle = thing->mesh != NULL ? meeting->part : 0,
        .place = {spot.place[0], spot.place[1]},
        .slack = 0x1p-46 * (vector_taxi(at) + spot.size),
    };
}

bool world_look(const struct world *world, const struct world_ray *ray, struct world_hit *hit)
{
    struct world_ray rest = *ray;
    struct shape_meeting nearest = {0}, meeting;
    size_t which = SCENE_NONE;
    for (size_t i = 0; i < world->scene->thing_count; i++) {
        if (meet(&world->things[i], &rest, &meeting)) {
            nearest = meeting;
            which = i;
            rest.farthest = meeting.distance;
        }
    }
    if (which == SCENE_NONE) {
        return false;
    }
    describe(world, ray, which, &nearest, hit);
    return true;
}

bool world_is_clear(const struct world *world, const struct world_ray *ray)
{
    struct shape_meeting meeting;
    for (size_t i = 0; i < world->scene->thing_count; i++) {
        if (meet(&world->things[i], ray, &meeting)) {
            return false;
        }
    }
    return true;
}

bool world_holds(const struct world *world, struct vector at, double time, size_t *thing)
{
    for (size_t i = 0; i < world->scene->thing_count; i++) {
        const struct scene_pose pose = pose_of(&world->things[i], time);
        const struct vector own = frame_in(&pose.turned, vector_minus(at, pose.at));
        if (shape_holds(world->things[i].thing, own)) {
            *thing = i;
            return true;
        }
    }
    return false;
}
