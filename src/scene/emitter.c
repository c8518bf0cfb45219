/* scene/emitter.c - area and point emitters, sampled from a point. */
/* SPDX-License-Identifier: MIT */
#include "scene/emitter.h"

#include "base/constants.h"
#include "scene/discrete.h"
#include "scene/vector.h"

#include <stdbool.h>

struct rectangle {
    struct vector at;  /* its middle */
    struct frame axes; /* along its edges; z across it */
    double half[2];    /* of its edges, mm */
};

/*
 * From here on by the solid angle: sums of angles lose digits in smaller ones, in which the area
 * does as well.
 */
#define LEAST_SOLID_ANGLE 1e-3

/* As a point sees it: edges in the rectangle's own axes; z of its plane, 0 or less. */
struct aspect {
    double x[2], y[2], z;
};

static struct aspect aspect_of(const struct rectangle *rectangle, struct vector from)
{
    const struct vector to = vector_minus(rectangle->at, from);
    const struct vector own = frame_in(&rectangle->axes, to);
    return (struct aspect){{own.x - rectangle->half[0], own.x + rectangle->half[0]},
                           {own.y - rectangle->half[1], own.y + rectangle->half[1]},
                           -fabs(own.z)};
}

/* Of the corner between two edges, from the foot of the perpendicular on. */
static double corner_angle(double x, double y, double z)
{
    return atan2(x * y, -z * sqrt(x * x + y * y + z * z));
}

static double solid_angle(const struct aspect *aspect)
{
    return corner_angle(aspect->x[1], aspect->y[1], aspect->z) -
           corner_angle(aspect->x[0], aspect->y[1], aspect->z) -
           corner_angle(aspect->x[1], aspect->y[0], aspect->z) +
           corner_angle(aspect->x[0], aspect->y[0], aspect->z);
}

/* Is it seen large enough for angles, and from beside its plane? */
static bool is_large(const struct aspect *aspect, double solid)
{
    return solid >= LEAST_SOLID_ANGLE && aspect->z < 0;
}

/*
 * Its solid angle from a point, sr; of small ones as good as their middle tells it.
 *
 * Formula   atan(x y/(z r)) of the four corners, with their signs
 */
static double rectangle_solid_angle(const struct rectangle *rectangle, struct vector from)
{
    const struct aspect aspect = aspect_of(rectangle, from);
    const double solid = solid_angle(&aspect);
    if (is_large(&aspect, solid)) {
        return solid;
    }
    const struct vector to = vector_minus(rectangle->at, from);
    const double square = vector_dot(to, to);
    const double area = 4 * rectangle->half[0] * rectangle->half[1];
    return square > 0 ? area * -aspect.z / (square * sqrt(square)) : 0;
}

static double rectangle_within(double value, const double limits[2])
{
    if (value < limits[0]) {
        return limits[0];
    }
    if (value > limits[1]) {
        return limits[1];
    }
    return value;
}

/* Cosine between the plane through the point and an edge, and the rectangle. */
static double edge_cosine(double edge, double z)
{
    return edge / sqrt(edge * edge + z * z);
}

/* Where the part of the rectangle left of x has the share u of its solid angle. */
static double x_of_share(const struct aspect *aspect, double u)
{
    const double below = -edge_cosine(aspect->y[0], aspect->z);
    const double above = edge_cosine(aspect->y[1], aspect->z);
    const double left = -edge_cosine(aspect->x[0], aspect->z);
    const double right = edge_cosine(aspect->x[1], aspect->z);
    const double known = 2 * PI - acos(-above * left) - acos(-left * below);
    const double solid = acos(-below * right) + acos(-right * above) - known;
    const double angle = u * solid + known;
    const double slope = (cos(angle) * below - above) / sin(angle);
    const double cosine = fmin(1, 1 / sqrt(slope * slope + below * below));
    const double x = -aspect->z * cosine / sqrt(fmax(1 - cosine * cosine, 1e-30));
    return rectangle_within(copysign(x, slope), aspect->x);
}

/* On the line at this x, even in the solid angle: sines of its angle are even. */
static double y_of_share(const struct aspect *aspect, double x, double u)
{
    const double far = sqrt(x * x + aspect->z * aspect->z);
    const double low = aspect->y[0] / sqrt(far * far + aspect->y[0] * aspect->y[0]);
    const double high = aspect->y[1] / sqrt(far * far + aspect->y[1] * aspect->y[1]);
    const double sine = low + u * (high - low);
    return rectangle_within(far * sine / sqrt(fmax(1 - sine * sine, 1e-30)), aspect->y);
}

/*
 * A place on it.
 *
 * Given     u       two numbers in 0..1
 *           shares  receives the place: -1 to 1 along both axes
 * Formula   even in the solid angle, or in the area where it is small
 * Source    [Urena13] 3
 */
static struct vector rectangle_sample(const struct rectangle *rectangle, struct vector from,
                                      const double u[2], double shares[2])
{
    const struct aspect aspect = aspect_of(rectangle, from);
    const double *half = rectangle->half;
    shares[0] = 2 * u[0] - 1;
    shares[1] = 2 * u[1] - 1;
    if (is_large(&aspect, solid_angle(&aspect))) {
        const double x = x_of_share(&aspect, u[0]), y = y_of_share(&aspect, x, u[1]);
        shares[0] = (x - (aspect.x[0] + aspect.x[1]) / 2) / half[0];
        shares[1] = (y - (aspect.y[0] + aspect.y[1]) / 2) / half[1];
    }
    const struct vector own = {shares[0] * half[0], shares[1] * half[1], 0};
    return vector_along(rectangle->at, 1, frame_out(&rectangle->axes, own));
}

/* The pdf of these places by their direction, per sr; 0 along the plane of the rectangle. */
static double rectangle_pdf(const struct rectangle *rectangle, struct vector from,
                            struct vector direction, double distance)
{
    const struct aspect aspect = aspect_of(rectangle, from);
    const double solid = solid_angle(&aspect);
    if (is_large(&aspect, solid)) {
        return 1 / solid;
    }
    const double area = 4 * rectangle->half[0] * rectangle->half[1];
    const double seen = area * fabs(vector_dot(rectangle->axes.z, direction));
    return seen > 0 ? distance * distance / seen : 0;
}

size_t emitter_parts(const struct scene_thing *thing)
{
    return thing->shape == SHAPE_MESH ? thing->mesh->triangle_count : 1;
}

/* -------- triangles and discs: a corner or the middle, and two directions with lengths -------- */

struct flat {
    struct vector at, x, y; /* in the frame of the thing */
    double area;
    struct vector normal; /* of length 1 */
};

static struct flat flat_of(const struct scene_thing *thing, size_t triangle)
{
    struct flat flat = {{0, 0, 0}, {thing->radius, 0, 0}, {0, thing->radius, 0}, 0, {0, 0, 0}};
    if (thing->shape == SHAPE_MESH) {
        const struct scene_mesh *mesh = thing->mesh;
        const size_t *corners = mesh->triangles[triangle];
        flat.at = mesh->corners[corners[0]];
        flat.x = vector_minus(mesh->corners[corners[1]], flat.at);
        flat.y = vector_minus(mesh->corners[corners[2]], flat.at);
    }
    const struct vector across = vector_cross(flat.x, flat.y);
    const double length = vector_length(across);
    flat.area = (thing->shape == SHAPE_MESH ? 0.5 : PI) * length;
    flat.normal = length > 0 ? vector_times(1 / length, across) : across;
    return flat;
}

static double flat_pdf(const struct flat *flat, struct vector direction, double distance)
{
    const double seen = flat->area * fabs(vector_dot(flat->normal, direction));
    return seen > 0 ? distance * distance / seen : 0;
}

/* The way to a place; false: it is here. */
static bool sample_towards(struct vector from, struct vector at, struct emitter_sample *ray)
{
    const struct vector to = vector_minus(at, from);
    ray->distance = vector_length(to);
    ray->direction = vector_times(1 / ray->distance, to);
    return ray->distance > 0;
}

static bool sample_flat(const struct scene_thing *thing, size_t triangle, struct vector from,
                        const double u[2], struct emitter_sample *ray)
{
    const struct flat flat = flat_of(thing, triangle);
    /* even over the area */
    const bool is_triangle = thing->shape == SHAPE_MESH;
    const double root = sqrt(u[0]), angle = 2 * PI * u[1];
    const double x = is_triangle ? root * (1 - u[1]) : root * cos(angle);
    const double y = is_triangle ? root * u[1] : root * sin(angle);
    if (!sample_towards(from, vector_along(vector_along(flat.at, x, flat.x), y, flat.y), ray)) {
        return false;
    }
    ray->pdf = flat_pdf(&flat, ray->direction, ray->distance);
    return ray->pdf > 0;
}

/* -------- cards, and the sides of a box that are seen -------- */

enum { SIDES = 6 };
/* Of half a box: places that are less above a side, or below, are on it. */
#define ON_SIDE 1e-6

static struct rectangle card_of(const struct scene_thing *thing)
{
    return (struct rectangle){
        {0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {thing->size.x / 2, thing->size.y / 2}};
}

/* Side 2 axis, or + 1 for the upper one; its own axes are the next ones. */
static struct rectangle box_side(const struct scene_thing *thing, size_t side)
{
    static const struct vector axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double half[3] = {thing->size.x / 2, thing->size.y / 2, thing->size.z / 2};
    const size_t axis = side / 2, next = (axis + 1) % 3, last = (axis + 2) % 3;
    return (struct rectangle){vector_times(side % 2 == 1 ? half[axis] : -half[axis], axes[axis]),
                              {axes[next], axes[last], axes[axis]},
                              {half[next], half[last]}};
}

/*
 * What is seen of the sides before each, and of all: from within of all, else of those in front;
 * from a place on a side nothing of that one, which fills half of all directions there and is in
 * none of them that light leaves to.
 */
static double see_sides(const struct scene_thing *thing, struct vector from,
                        double below[SIDES + 1])
{
    const double at[3] = {from.x, from.y, from.z};
    const double half[3] = {thing->size.x / 2, thing->size.y / 2, thing->size.z / 2};
    bool is_within = true;
    for (int axis = 0; axis < 3; axis++) {
        is_within = is_within && fabs(at[axis]) < half[axis];
    }
    below[0] = 0;
    for (size_t side = 0; side < SIDES; side++) {
        const double outwards = side % 2 == 1 ? at[side / 2] : -at[side / 2];
        const double height = outwards - half[side / 2];
        const bool is_seen = (is_within || height > 0) && fabs(height) > ON_SIDE * half[side / 2];
        const struct rectangle rectangle = box_side(thing, side);
        below[side + 1] = below[side] + (is_seen ? rectangle_solid_angle(&rectangle, from) : 0);
    }
    return below[SIDES];
}

static double side_pdf(const struct scene_thing *thing, size_t side, struct vector from,
                       struct vector direction, double distance)
{
    const struct rectangle rectangle = box_side(thing, side);
    double below[SIDES + 1];
    const double all = see_sides(thing, from, below);
    return all > 0 ? (below[side + 1] - below[side]) / all *
                         rectangle_pdf(&rectangle, from, direction, distance)
                   : 0;
}

static bool sample_box(const struct scene_thing *thing, struct vector from, const double u[2],
                       struct emitter_sample *ray)
{
    double below[SIDES + 1], shares[2];
    if (!(see_sides(thing, from, below) > 0)) {
        return false;
    }
    const struct discrete_sample side = discrete_sample_of(below, SIDES, u[0]);
    const struct rectangle rectangle = box_side(thing, side.index);
    const double rest[2] = {side.remainder, u[1]};
    if (!sample_towards(from, rectangle_sample(&rectangle, from, rest, shares), ray)) {
        return false;
    }
    ray->pdf = side_pdf(thing, side.index, from, ray->direction, ray->distance);
    return ray->pdf > 0;
}

static bool sample_card(const struct scene_thing *thing, struct vector from, const double u[2],
                        struct emitter_sample *ray)
{
    const struct rectangle card = card_of(thing);
    double shares[2];
    if (!sample_towards(from, rectangle_sample(&card, from, u, shares), ray)) {
        return false;
    }
    ray->pdf = rectangle_pdf(&card, from, ray->direction, ray->distance);
    ray->place[0] = (shares[0] + 1) / 2;
    ray->place[1] = (shares[1] + 1) / 2;
    return ray->pdf > 0;
}

/* -------- spheres -------- */

/* 1 - cosine of the half angle of the cone that holds a sphere; 2 from within: all around. */
static double cone_height(double radius, struct vector from)
{
    const double square = vector_dot(from, from), sine2 = radius * radius / square;
    return sine2 < 1 ? sine2 / (1 + sqrt(1 - sine2)) : 2;
}

static bool sample_sphere(double radius, struct vector from, const double u[2],
                          struct emitter_sample *ray)
{
    const double far = vector_length(from);
    const struct vector inwards = far > 0 ? vector_times(-1 / far, from) : (struct vector){0, 0, 1};
    const struct frame frame = frame_about(inwards);
    const double height = cone_height(radius, from), low = height * u[0];
    const double cosine = 1 - low, sine = sqrt(low * (2 - low)), angle = 2 * PI * u[1];
    const struct vector own = {sine * cos(angle), sine * sin(angle), cosine};
    /* nearest to the middle it is far * sine away from it */
    const double beside = far * sine, half = sqrt(fmax(0, radius * radius - beside * beside));
    *ray = (struct emitter_sample){.direction = vector_unit(frame_out(&frame, own)),
                                   .distance = far * cosine + (height < 2 ? -half : half),
                                   .pdf = 1 / (2 * PI * height)};
    return ray->distance > 0;
}

/* -------- all -------- */

/* The side of a box that a ray met, from its face. */
static size_t side_met(const struct scene_pose *pose, const struct world_hit *hit)
{
    const struct vector face =
        vector_times(hit->is_back ? -1 : 1, frame_in(&pose->turned, hit->face));
    const double along[3] = {face.x, face.y, face.z};
    size_t axis = fabs(along[1]) > fabs(along[0]) ? 1 : 0;
    axis = fabs(along[2]) > fabs(along[axis]) ? 2 : axis;
    return 2 * axis + (along[axis] > 0 ? 1 : 0);
}

struct emitter_bounds emitter_bounds(const struct scene *scene, const struct emitter *emitter)
{
    if (emitter->thing == SCENE_NONE) {
        return (struct emitter_bounds){scene->lights[emitter->part].at, 0, 0};
    }
    const struct scene_thing *thing = &scene->things[emitter->thing];
    const struct vector size = thing->size;
    struct emitter_bounds bounds = {thing->where.at, thing->radius, 0};
    switch (thing->shape) {
    case SHAPE_SPHERE:
    case SHAPE_DISC:
        bounds.area = PI * thing->radius * thing->radius;
        break;
    case SHAPE_CARD:
        bounds.area = size.x * size.y;
        bounds.radius = sqrt(size.x * size.x + size.y * size.y) / 2;
        break;
    case SHAPE_BOX: /* a quarter of its surface: the mean of its shadows */
        bounds.area = (size.x * size.y + size.y * size.z + size.z * size.x) / 2;
        bounds.radius = vector_length(size) / 2;
        break;
    default: {
        const struct flat flat = flat_of(thing, emitter->part);
        const struct vector middle =
            vector_along(vector_along(flat.at, 1.0 / 3, flat.x), 1.0 / 3, flat.y);
        bounds.middle = vector_along(thing->where.at, 1, frame_out(&thing->where.turned, middle));
        bounds.radius = fmax(vector_length(flat.x), vector_length(flat.y));
        bounds.area = flat.area;
        break;
    }
    }
    return bounds;
}

bool emitter_sample(const struct scene_thing *thing, size_t part, const struct scene_pose *pose,
                    struct vector from, const double u[2], struct emitter_sample *ray)
{
    const struct vector own = frame_in(&pose->turned, vector_minus(from, pose->at));
    bool is_seen = false;
    switch (thing->shape) {
    case SHAPE_SPHERE:
        is_seen = sample_sphere(thing->radius, own, u, ray);
        break;
    case SHAPE_CARD:
        is_seen = sample_card(thing, own, u, ray);
        break;
    case SHAPE_BOX:
        is_seen = sample_box(thing, own, u, ray);
        break;
    default:
        is_seen = sample_flat(thing, part, own, u, ray);
        break;
    }
    if (is_seen) {
        ray->direction = frame_out(&pose->turned, ray->direction);
    }
    return is_seen;
}

double emitter_pdf(const struct scene_thing *thing, const struct scene_pose *pose,
                   struct vector from, const struct world_hit *hit, struct vector direction)
{
    const struct vector own = frame_in(&pose->turned, vector_minus(from, pose->at));
    const struct vector own_way = frame_in(&pose->turned, direction);
    switch (thing->shape) {
    case SHAPE_SPHERE:
        return 1 / (2 * PI * cone_height(thing->radius, own));
    case SHAPE_CARD: {
        const struct rectangle card = card_of(thing);
        return rectangle_pdf(&card, own, own_way, hit->distance);
    }
    case SHAPE_BOX:
        return side_pdf(thing, side_met(pose, hit), own, own_way, hit->distance);
    default: {
        const struct flat flat = flat_of(thing, hit->triangle);
        return flat_pdf(&flat, own_way, hit->distance);
    }
    }
}
