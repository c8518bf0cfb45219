/* scene/lamp.c - spheres, discs, rectangles and triangles that shine. */
/* SPDX-License-Identifier: MIT */
#include "scene/lamp.h"

#include "base/constants.h"

size_t lamp_parts(const struct scene_thing *thing)
{
    return thing->shape == SHAPE_BOX    ? 6
           : thing->shape == SHAPE_MESH ? thing->mesh->triangle_count
                                        : 1;
}

/* -------- flat ones: a corner or a middle, and two directions with lengths -------- */

struct flat {
    struct vector at, x, y; /* in the frame of the thing */
    double area;
    struct vector normal; /* of length 1 */
};

static struct flat flat_of(struct vector at, struct vector x, struct vector y, double share)
{
    const struct vector across = vector_cross(x, y);
    const double length = vector_length(across);
    return (struct flat){at, x, y, share * length,
                         length > 0 ? vector_times(1 / length, across) : across};
}

/* A side of a box, about its middle; x and y are half its edges. */
static struct flat side_of(struct vector size, size_t side)
{
    const double half[3] = {size.x / 2, size.y / 2, size.z / 2};
    double at[3] = {0}, x[3] = {0}, y[3] = {0};
    const size_t axis = side / 2, next = (axis + 1) % 3, last = (axis + 2) % 3;
    at[axis] = side % 2 == 1 ? half[axis] : -half[axis];
    x[next] = half[next];
    y[last] = half[last];
    return flat_of((struct vector){at[0], at[1], at[2]}, (struct vector){x[0], x[1], x[2]},
                   (struct vector){y[0], y[1], y[2]}, 4);
}

static struct flat triangle_of(const struct scene_mesh *mesh, size_t triangle)
{
    const size_t *corners = mesh->triangles[triangle];
    const struct vector at = mesh->corners[corners[0]];
    return flat_of(at, vector_minus(mesh->corners[corners[1]], at),
                   vector_minus(mesh->corners[corners[2]], at), 0.5);
}

static struct flat flat_lamp(const struct scene_thing *thing, size_t part)
{
    const struct vector middle = {0, 0, 0};
    switch (thing->shape) {
    case SHAPE_MESH:
        return triangle_of(thing->mesh, part);
    case SHAPE_BOX:
        return side_of(thing->size, part);
    case SHAPE_CARD:
        return flat_of(middle, (struct vector){thing->size.x / 2, 0, 0},
                       (struct vector){0, thing->size.y / 2, 0}, 4);
    default:
        return flat_of(middle, (struct vector){thing->radius, 0, 0},
                       (struct vector){0, thing->radius, 0}, PI);
    }
}

/* Shares of the two directions, even over the area. */
static void spread(enum scene_shape shape, const double u[2], double shares[2])
{
    if (shape == SHAPE_MESH) {
        const double root = sqrt(u[0]);
        shares[0] = root * (1 - u[1]);
        shares[1] = root * u[1];
    } else if (shape == SHAPE_DISC) {
        const double radius = sqrt(u[0]), angle = 2 * PI * u[1];
        shares[0] = radius * cos(angle);
        shares[1] = radius * sin(angle);
    } else {
        shares[0] = 2 * u[0] - 1;
        shares[1] = 2 * u[1] - 1;
    }
}

static double flat_density(const struct flat *flat, struct vector way, double distance)
{
    const double seen = flat->area * fabs(vector_dot(flat->normal, way));
    return seen > 0 ? distance * distance / seen : 0;
}

static bool sample_flat(const struct scene_thing *thing, size_t part, struct vector from,
                        const double u[2], struct lamp_ray *ray)
{
    const struct flat flat = flat_lamp(thing, part);
    double shares[2];
    spread(thing->shape, u, shares);
    const struct vector at =
        vector_along(vector_along(flat.at, shares[0], flat.x), shares[1], flat.y);
    const struct vector to = vector_minus(at, from);
    const double distance = vector_length(to);
    if (!(distance > 0)) {
        return false;
    }
    *ray = (struct lamp_ray){.way = vector_times(1 / distance, to), .distance = distance};
    ray->density = flat_density(&flat, ray->way, distance);
    ray->place[0] = (shares[0] + 1) / 2;
    ray->place[1] = (shares[1] + 1) / 2;
    return ray->density > 0;
}

/* -------- spheres -------- */

/* 1 - cosine of the half angle of the cone that holds a sphere; 2 from within: all around. */
static double cone_height(double radius, struct vector from)
{
    const double square = vector_dot(from, from), sine = radius * radius / square;
    return sine < 1 ? sine / (1 + sqrt(1 - sine)) : 2;
}

static double sphere_density(double radius, struct vector from)
{
    return 1 / (2 * PI * cone_height(radius, from));
}

static bool sample_sphere(double radius, struct vector from, const double u[2],
                          struct lamp_ray *ray)
{
    const double far = vector_length(from);
    const struct vector inwards = far > 0 ? vector_times(-1 / far, from) : (struct vector){0, 0, 1};
    const struct frame frame = frame_about(inwards);
    const double height = cone_height(radius, from), low = height * u[0];
    const double cosine = 1 - low, sine = sqrt(low * (2 - low)), angle = 2 * PI * u[1];
    const struct vector own = {sine * cos(angle), sine * sin(angle), cosine};
    /* nearest to the middle it is far * sine away from it */
    const double beside = far * sine, half = sqrt(fmax(0, radius * radius - beside * beside));
    *ray = (struct lamp_ray){.way = vector_unit(frame_out(&frame, own)),
                             .distance = far * cosine + (height < 2 ? -half : half),
                             .density = 1 / (2 * PI * height)};
    return ray->distance > 0;
}

/* -------- all -------- */

struct lamp_bounds lamp_bounds(const struct scene *scene, const struct lamp *lamp)
{
    if (lamp->thing == SCENE_NONE) {
        return (struct lamp_bounds){scene->lights[lamp->part].at, 0, 0};
    }
    const struct scene_thing *thing = &scene->things[lamp->thing];
    struct vector middle = {0, 0, 0};
    double radius = thing->radius, area = 4 * PI * radius * radius;
    if (thing->shape != SHAPE_SPHERE) {
        const struct flat flat = flat_lamp(thing, lamp->part);
        const double third = thing->shape == SHAPE_MESH ? 1.0 / 3 : 0;
        middle = vector_along(vector_along(flat.at, third, flat.x), third, flat.y);
        radius = sqrt(vector_dot(flat.x, flat.x) + vector_dot(flat.y, flat.y));
        area = flat.area;
    }
    return (struct lamp_bounds){
        vector_along(thing->where.at, 1, frame_out(&thing->where.turned, middle)), radius, area};
}

bool lamp_sample(const struct scene *scene, const struct lamp *lamp, const struct scene_pose *pose,
                 struct vector from, const double u[2], struct lamp_ray *ray)
{
    const struct scene_thing *thing = &scene->things[lamp->thing];
    const struct vector own = frame_in(&pose->turned, vector_minus(from, pose->at));
    const bool is_seen = thing->shape == SHAPE_SPHERE ? sample_sphere(thing->radius, own, u, ray)
                                                      : sample_flat(thing, lamp->part, own, u, ray);
    ray->way = is_seen ? frame_out(&pose->turned, ray->way) : ray->way;
    return is_seen;
}

double lamp_density(const struct scene *scene, const struct lamp *lamp,
                    const struct scene_pose *pose, struct vector from, struct vector way,
                    double distance)
{
    const struct scene_thing *thing = &scene->things[lamp->thing];
    if (thing->shape == SHAPE_SPHERE) {
        return sphere_density(thing->radius, frame_in(&pose->turned, vector_minus(from, pose->at)));
    }
    const struct flat flat = flat_lamp(thing, lamp->part);
    return flat_density(&flat, frame_in(&pose->turned, way), distance);
}
