/* scene/shape.c - intersections of rays with shapes, in their own frames. */
/* SPDX-License-Identifier: MIT */
#include "scene/shape.h"

#include "base/constants.h"
#include "base/random.h"
#include "scene/texture.h"

#include <string.h>

typedef bool shape_meets(const struct scene_thing *, const struct shape_ray *, struct shape_hit *);
typedef struct shape_surface shape_spots(const struct scene_thing *, const struct shape_ray *,
                                         const struct shape_hit *);

static struct vector ray_point(const struct shape_ray *ray, double distance)
{
    return vector_along(ray->origin, distance, ray->direction);
}

/* -------- flat things -------- */

static bool plane_intersect(const struct scene_thing *thing, const struct shape_ray *ray,
                            struct shape_hit *meeting)
{
    (void)thing;
    meeting->distance = -ray->origin.z / ray->direction.z;
    return meeting->distance > 0 && meeting->distance < ray->farthest;
}

static bool meet_disc(const struct scene_thing *thing, const struct shape_ray *ray,
                      struct shape_hit *meeting)
{
    if (!plane_intersect(thing, ray, meeting)) {
        return false;
    }
    const struct vector at = ray_point(ray, meeting->distance);
    return at.x * at.x + at.y * at.y <= thing->radius * thing->radius;
}

static struct shape_surface spot_flat(const struct shape_ray *ray, const struct shape_hit *meeting,
                                      double width, double height)
{
    struct vector at = ray_point(ray, meeting->distance);
    at.z = 0;
    return (struct shape_surface){.at = at,
                                  .size = vector_taxi(at),
                                  .normal = {0, 0, 1},
                                  .face = {0, 0, 1},
                                  .place = {at.x / width + 0.5, at.y / height + 0.5}};
}

static struct shape_surface spot_plane(const struct scene_thing *thing, const struct shape_ray *ray,
                                       const struct shape_hit *meeting)
{
    const bool repeats = thing->repeat[0] > 0;
    struct shape_surface spot = spot_flat(ray, meeting, repeats ? thing->repeat[0] : INFINITY,
                                          repeats ? thing->repeat[1] : INFINITY);
    spot.place[0] -= floor(spot.place[0]);
    spot.place[1] -= floor(spot.place[1]);
    return spot;
}

static struct shape_surface spot_disc(const struct scene_thing *thing, const struct shape_ray *ray,
                                      const struct shape_hit *meeting)
{
    return spot_flat(ray, meeting, 2 * thing->radius, 2 * thing->radius);
}

static struct shape_surface spot_card(const struct scene_thing *thing, const struct shape_ray *ray,
                                      const struct shape_hit *meeting)
{
    return spot_flat(ray, meeting, thing->size.x, thing->size.y);
}

static bool meet_card(const struct scene_thing *thing, const struct shape_ray *ray,
                      struct shape_hit *meeting)
{
    if (!plane_intersect(thing, ray, meeting)) {
        return false;
    }
    const struct vector at = ray_point(ray, meeting->distance);
    if (!(fabs(at.x) <= thing->size.x / 2 && fabs(at.y) <= thing->size.y / 2)) {
        return false;
    }
    if (thing->picture == NULL || thing->picture->channels <= TEXTURE_ALPHA) {
        return true;
    }
    double of[TEXTURE_CHANNELS];
    texture_lookup(thing->picture, spot_card(thing, ray, meeting).place, TEXTURE_ENDS, of);
    /* is something there, at a place of which the share alpha is? */
    struct random_words counter;
    const double place[2] = {at.x, at.y};
    memcpy(counter.w, place, sizeof counter.w);
    const struct random_words words = random_cipher(counter, 0, 0);
    return random_unit_of(words.w[0], words.w[1]) < of[TEXTURE_ALPHA];
}

/* -------- a sphere -------- */

static bool meet_sphere(const struct scene_thing *thing, const struct shape_ray *ray,
                        struct shape_hit *meeting)
{
    const double r = thing->radius, before = -vector_dot(ray->origin, ray->direction);
    const double beside = vector_length(vector_along(ray->origin, before, ray->direction));
    const double squared = (r - beside) * (r + beside);
    if (!(squared >= 0)) {
        return false;
    }
    /* the larger of the two without cancellation; the other from their product */
    const double away = vector_length(ray->origin), product = (away - r) * (away + r);
    const double one = before + copysign(sqrt(squared), before), other = product / one;
    const double first = fmin(one, other), second = fmax(one, other);
    meeting->distance = first > 0 ? first : second;
    return meeting->distance > 0 && meeting->distance < ray->farthest;
}

static struct shape_surface spot_sphere(const struct scene_thing *thing,
                                        const struct shape_ray *ray,
                                        const struct shape_hit *meeting)
{
    const struct vector normal = vector_unit(ray_point(ray, meeting->distance));
    const double height = fmax(-1, fmin(normal.y, 1));
    return (struct shape_surface){
        .at = vector_times(thing->radius, normal),
        .size = thing->radius * vector_taxi(normal),
        .normal = normal,
        .face = normal,
        .place = {0.5 + atan2(normal.x, normal.z) / (2 * PI), 0.5 + asin(height) / PI}};
}

/* -------- a box -------- */

/* From where to where it is between the two sides of a box across an axis. */
static bool between_sides(double from, double direction, double half, double span[2])
{
    if (direction == 0) {
        span[0] = -INFINITY;
        span[1] = INFINITY;
        return fabs(from) <= half;
    }
    const double to = copysign(half, direction);
    span[0] = (-to - from) / direction;
    span[1] = (to - from) / direction;
    return true;
}

static bool meet_box(const struct scene_thing *thing, const struct shape_ray *ray,
                     struct shape_hit *meeting)
{
    const double from[] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double direction[] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const double size[] = {thing->size.x, thing->size.y, thing->size.z};
    double in = -INFINITY, out = INFINITY;
    size_t side_in = 0, side_out = 0;
    for (size_t k = 0; k < 3; k++) {
        double span[2];
        if (!between_sides(from[k], direction[k], size[k] / 2, span)) {
            return false;
        }
        if (span[0] > in) {
            in = span[0];
            side_in = 2 * k + (direction[k] < 0);
        }
        if (span[1] < out) {
            out = span[1];
            side_out = 2 * k + (direction[k] > 0);
        }
    }
    if (!(in <= out)) {
        return false;
    }
    meeting->distance = in > 0 ? in : out;
    meeting->part = in > 0 ? side_in : side_out;
    return meeting->distance > 0 && meeting->distance < ray->farthest;
}

static double within_half(double x, double half)
{
    return fmax(-half, fmin(x, half));
}

static struct shape_surface spot_box(const struct scene_thing *thing, const struct shape_ray *ray,
                                     const struct shape_hit *meeting)
{
    const struct vector reach = ray_point(ray, meeting->distance);
    const double half[] = {thing->size.x / 2, thing->size.y / 2, thing->size.z / 2};
    double at[] = {within_half(reach.x, half[0]), within_half(reach.y, half[1]),
                   within_half(reach.z, half[2])};
    const size_t axis = meeting->part / 2;
    const double sign = meeting->part % 2 == 1 ? 1 : -1;
    double normal[] = {0, 0, 0};
    normal[axis] = sign;
    at[axis] = sign * half[axis];
    /* to the right and up, as one looks at the side: y is up but on the lid and the ground */
    const double x = at[0] / (2 * half[0]), y = at[1] / (2 * half[1]), z = at[2] / (2 * half[2]);
    const double right[] = {-sign * z, x, sign * x}, up[] = {y, -sign * z, y};
    const struct vector face = {normal[0], normal[1], normal[2]};
    return (struct shape_surface){.at = {at[0], at[1], at[2]},
                                  .size = fabs(at[0]) + fabs(at[1]) + fabs(at[2]),
                                  .normal = face,
                                  .face = face,
                                  .place = {0.5 + right[axis], 0.5 + up[axis]}};
}

/* -------- all of them -------- */

static const struct {
    shape_meets *meet;
    shape_spots *spot;
} kinds[] = {
    [SHAPE_PLANE] = {plane_intersect, spot_plane},
    [SHAPE_DISC] = {meet_disc, spot_disc},
    [SHAPE_CARD] = {meet_card, spot_card},
    [SHAPE_SPHERE] = {meet_sphere, spot_sphere},
    [SHAPE_BOX] = {meet_box, spot_box},
};

bool shape_intersect(const struct scene_thing *thing, const struct shape_ray *ray,
                     struct shape_hit *meeting)
{
    return kinds[thing->shape].meet(thing, ray, meeting);
}

struct shape_surface shape_surface(const struct scene_thing *thing, const struct shape_ray *ray,
                                   const struct shape_hit *meeting)
{
    return kinds[thing->shape].spot(thing, ray, meeting);
}

struct shape_box shape_box(const struct scene_thing *thing)
{
    const double r = thing->radius;
    struct vector high = vector_times(0.5, thing->size);
    if (thing->shape == SHAPE_DISC || thing->shape == SHAPE_SPHERE) {
        high = (struct vector){r, r, r};
    }
    if (thing->shape == SHAPE_DISC || thing->shape == SHAPE_CARD) {
        high.z = 0;
    }
    return (struct shape_box){vector_times(-1, high), high};
}
