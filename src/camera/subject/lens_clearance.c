/* camera/subject/lens_clearance.c - boxes about things against the lens, and lines where they overlap. */
/* SPDX-License-Identifier: MIT */
#include "camera/subject/lens_clearance.h"

#include "analysis/layout/layout.h"
#include "optics/aperture.h"
#include "scene/mesh.h"

/* -------- the lens -------- */

/* Along z, of a rim at a distance from the axis: beyond its edge it goes on as a flat. */
static double face_at(const struct lens_rim *rim, double r)
{
    const double sag = rim->surface == NULL ? 0 : surface_sag(rim->surface, fmin(r, rim->radius));
    return rim->vertex + (isfinite(sag) ? sag : 0);
}

/* Does a point lie between a surface and the next? */
static bool is_between(const struct lens_rim *rims, double r, double z)
{
    const double first = face_at(&rims[0], r), second = face_at(&rims[1], r);
    if (!(z >= fmin(first, second) && z <= fmax(first, second))) {
        return false;
    }
    if (rims[0].is_glass) {
        return r <= fmax(rims[0].radius, rims[1].radius);
    }
    const double begins = face_at(&rims[0], rims[0].radius);
    const double ends = face_at(&rims[1], rims[1].radius);
    const double share = fmin(fmax((z - begins) / (ends - begins), 0), 1);
    return r <= rims[0].radius + share * (rims[1].radius - rims[0].radius);
}

/* In the camera's frame. */
static bool box_holds(const struct lens_clearance *room, struct vector at)
{
    const double r = hypot(at.x, at.y);
    bool does = false;
    for (size_t i = 0; i + 1 < room->count && !does; i++) {
        does = is_between(&room->rims[i], r, at.z);
    }
    return does;
}

/* The surfaces of a straight lens, but for stops in air. */
static size_t list_rims(const struct setup *setup, double entrance, double pupil,
                        struct lens_rim *rims)
{
    const struct lens *lens = setup->lens;
    double z = -pupil;
    bool was_glass = false;
    size_t count = 0;
    for (size_t i = 0; i < lens->surface_count; i++) {
        const struct surface *surface = &lens->surfaces[i];
        const double reach = aperture_reach(surface);
        const bool is_glass =
            surface_reflects(surface) ? was_glass : !medium_is_air(&surface->medium);
        if (!surface->is_stop || is_glass || was_glass) {
            rims[count++] =
                (struct lens_rim){surface, isfinite(reach) ? reach : entrance, z, is_glass};
        }
        z += surface_advance(surface).hi;
        was_glass = is_glass;
    }
    return count;
}

static bool lens_clearance_is_far(const struct setup *setup)
{
    const double most = 1e9; /* mm */
    return !(fabs(setup->first.entrance_pupil) < most);
}

double lens_clearance_pupil(const struct setup *setup)
{
    return lens_clearance_is_far(setup) ? 0 : setup->first.entrance_pupil;
}

struct lens_clearance lens_clearance_of(const struct setup *setup, struct arena *arena)
{
    /* what is infinitely far away is as wide, too, and the beam on the glass about as the stop */
    const double entrance = lens_clearance_is_far(setup) ? setup_stop_radius(setup)
                                                         : fabs(setup->first.entrance_diameter) / 2;
    const double pupil = lens_clearance_pupil(setup);
    const double last = setup->first.length - pupil;
    struct lens_rim *rims = ARENA_ARRAY(arena, setup->lens->surface_count + 1, struct lens_rim);
    size_t count = layout_is_centred(setup->lens) ? list_rims(setup, entrance, pupil, rims) : 0;
    if (count == 0) {
        rims[count++] = (struct lens_rim){NULL, entrance, -pupil, false};
    }
    rims[count] = (struct lens_rim){NULL, rims[count - 1].radius,
                                    last + (isfinite(setup->image) ? setup->image : 0), false};
    struct lens_clearance room = {0, INFINITY, -INFINITY, rims, count + 1};
    for (size_t i = 0; i < room.count; i++) {
        const double edge = face_at(&rims[i], rims[i].radius);
        room.radius = fmax(room.radius, rims[i].radius);
        room.front = fmin(room.front, fmin(edge, rims[i].vertex));
        room.back = fmax(room.back, fmax(edge, rims[i].vertex));
    }
    return room;
}

/* -------- things in it -------- */

/* A box in the camera's frame, axis by axis. */
struct lens_clearance_part {
    double low[3], high[3];
};

/* About a thing; a plane's is endless. */
static struct lens_clearance_part clearance_part_of(const struct world_thing *thing,
                                                    const struct scene_pose *camera, double time)
{
    struct lens_clearance_part part = {{-INFINITY, -INFINITY, -INFINITY},
                                       {INFINITY, INFINITY, INFINITY}};
    if (thing->thing->shape == SHAPE_PLANE) {
        return part;
    }
    const struct shape_box own = thing->mesh != NULL ? thing->mesh->box : shape_box(thing->thing);
    const struct scene_pose pose = scene_pose_at(&thing->thing->where, time);
    const struct vector half = vector_times(0.5, vector_minus(own.high, own.low));
    const struct vector middle = vector_minus(
        vector_along(frame_out(&pose.turned, vector_along(own.low, 1, half)), 1, pose.at),
        camera->at);
    const struct vector axes[3] = {camera->turned.x, camera->turned.y, camera->turned.z};
    for (int i = 0; i < 3; i++) {
        const struct vector way = frame_in(&pose.turned, axes[i]);
        const double at = vector_dot(axes[i], middle);
        const double reach = fabs(way.x) * half.x + fabs(way.y) * half.y + fabs(way.z) * half.z;
        part.low[i] = at - reach;
        part.high[i] = at + reach;
    }
    return part;
}

/* About the cylinder. */
static struct lens_clearance_part part_of_room(const struct lens_clearance *room)
{
    return (struct lens_clearance_part){{-room->radius, -room->radius, room->front},
                                        {room->radius, room->radius, room->back}};
}

/* Leave what lies within the box about the cylinder; false: nothing does. */
static bool lens_clearance_clip(const struct lens_clearance *room, struct lens_clearance_part *part)
{
    const struct lens_clearance_part whole = part_of_room(room);
    bool is_left = true;
    for (int i = 0; i < 3; i++) {
        part->low[i] = fmax(part->low[i], whole.low[i]);
        part->high[i] = fmin(part->high[i], whole.high[i]);
        is_left = is_left && part->low[i] <= part->high[i];
    }
    return is_left;
}

/* Surfaces one behind the other, of which the last ones may lie beside the lens. */
static bool lens_clearance_look_along(const struct lens_clearance *room, const struct world *world,
                                      const struct scene_pose *camera, double time, int axis,
                                      double at[3], size_t *thing)
{
    enum { SURFACES = 64 };
    double ends[2];
    struct world_hit hit;
    /* of a line along an axis, its ends on the cylinder, unless it goes past */
    const double r = room->radius;
    const double beside = axis == 2 ? hypot(at[0], at[1]) : fabs(at[1 - axis]);
    const double half = sqrt(fmax(0, (r - beside) * (r + beside)));
    ends[0] = axis == 2 ? room->front : -half;
    ends[1] = axis == 2 ? room->back : half;
    if (!(beside < r)) {
        return false;
    }
    at[axis] = ends[0];
    const struct vector from = {at[0], at[1], at[2]};
    const struct vector way = {axis == 0, axis == 1, axis == 2};
    struct world_ray ray = {.origin = vector_along(camera->at, 1, frame_out(&camera->turned, from)),
                            .direction = frame_out(&camera->turned, way),
                            .time = time,
                            .farthest = ends[1] - ends[0]};
    for (int i = 0; i < SURFACES && world_intersect(world, &ray, &hit); i++) {
        const struct vector own = frame_in(&camera->turned, vector_minus(hit.at, camera->at));
        if (box_holds(room, own)) {
            *thing = hit.thing;
            return true;
        }
        const double step = hit.distance + 1e-9 * (room->back - room->front);
        ray.origin = vector_along(ray.origin, step, ray.direction);
        ray.farthest -= step;
    }
    return false;
}

static bool look_through(const struct lens_clearance *room, const struct world *world,
                         const struct scene_pose *camera, double time,
                         const struct lens_clearance_part *part, size_t *thing)
{
    enum { LINES = 16 };
    for (int i = 0; i < 3 * LINES * LINES; i++) {
        const int axis = i % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const double share[2] = {(i / 3 % LINES + 0.5) / LINES, (i / 3 / LINES + 0.5) / LINES};
        double at[3] = {0, 0, 0};
        at[u] = part->low[u] + share[0] * (part->high[u] - part->low[u]);
        at[v] = part->low[v] + share[1] * (part->high[v] - part->low[v]);
        if (lens_clearance_look_along(room, world, camera, time, axis, at, thing)) {
            return true;
        }
    }
    return false;
}

/* -------- over a time -------- */

/* Of a ball about the camera's place, which holds all of the lens. */
static double ball_of(const struct lens_clearance *room)
{
    return hypot(room->radius, fmax(fabs(room->front), fabs(room->back)));
}

/* How far a thing is from the lens at least. */
static double clearance_gap_of(const struct lens_clearance *room, const struct world_thing *thing,
                               const struct scene_pose *camera, double time)
{
    if (thing->thing->shape == SHAPE_PLANE) {
        const struct scene_pose pose = scene_pose_at(&thing->thing->where, time);
        const double away = vector_dot(pose.turned.z, vector_minus(camera->at, pose.at));
        return fmax(fabs(away) - ball_of(room), 0);
    }
    const struct lens_clearance_part whole = part_of_room(room),
                                     part = clearance_part_of(thing, camera, time);
    double gap = 0;
    for (int i = 0; i < 3; i++) {
        gap = fmax(gap, fmax(part.low[i] - whole.high[i], whole.low[i] - part.high[i]));
    }
    return gap;
}

/* From time to time, as late as it may be. */
static bool comes_in(const struct lens_clearance *room, const struct world *world,
                     const struct scene_place *camera, const double span[2], size_t *thing,
                     double *time)
{
    enum { STEPS = 4, LOOKS_MOST = 4096 };
    const struct world_thing *one = &world->things[*thing];
    /* no point that comes into the lens within the span is faster, as the camera sees it */
    const double ball = ball_of(room), duration = span[1] - span[0];
    const double apart = vector_length(vector_minus(scene_pose_at(&one->thing->where, span[0]).at,
                                                    scene_pose_at(camera, span[0]).at));
    const double moved = vector_length(vector_minus(one->thing->where.velocity, camera->velocity));
    const double seen = moved + fabs(one->thing->where.spin) * (apart + moved * duration + ball);
    const double speed = seen + fabs(camera->spin) * (ball + seen * duration);
    const double wide = fmin(room->radius, room->back - room->front);
    const double least = fmax(wide / STEPS / speed, (span[1] - span[0]) / LOOKS_MOST);
    *time = span[0];
    for (bool is_last = false; !is_last;) {
        const struct scene_pose pose = scene_pose_at(camera, *time);
        struct lens_clearance_part part = clearance_part_of(one, &pose, *time);
        const double gap = clearance_gap_of(room, one, &pose, *time);
        if (gap == 0 && lens_clearance_clip(room, &part) &&
            look_through(room, world, &pose, *time, &part, thing)) {
            return true;
        }
        const bool stays = !one->moves && !scene_place_moves(camera);
        is_last = stays || !(*time < span[1]);
        *time = fmin(*time + fmax(least, gap / speed), span[1]);
    }
    return false;
}

bool lens_clearance_holds(const struct lens_clearance *room, const struct world *world,
                          const struct scene_place *camera, const double span[2], size_t *thing,
                          double *time)
{
    for (size_t i = 0; i < world->scene->thing_count; i++) {
        *thing = i;
        if (comes_in(room, world, camera, span, thing, time)) {
            return true;
        }
    }
    return false;
}
