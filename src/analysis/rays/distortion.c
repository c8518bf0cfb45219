/* analysis/rays/distortion.c - chief rays against an ideal projection. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/distortion.h"

#include "base/constants.h"
#include "trace/aim/aim.h"
#include "trace/dispatch.h"

#include <math.h>

/* -------- one chief ray -------- */

/* An object point, seen from the axis. */
struct distortion_place {
    double towards[2]; /* of unit length; upwards on the axis */
    double amount;     /* rad, or mm */
};

static struct distortion_place distortion_place_of(const struct beam *beam)
{
    struct distortion_place place = {.towards = {0, 1}};
    const bool far = isinf(beam->distance);
    const double from_axis = far ? 1 : -beam->distance;
    const double x = from_axis * beam->axis[0], y = from_axis * beam->axis[1];
    const double away = hypot(x, y);
    place.amount = far ? atan2(away, beam->axis[2]) : away;
    if (away > 0) {
        place.towards[0] = x / away;
        place.towards[1] = y / away;
    }
    return place;
}

static struct ray distortion_take(const struct system *system, const struct ray *from,
                                  struct arena *arena)
{
    const struct rays rays = rays_new(arena, 1);
    rays_set(&rays, 0, system->index_first, from);
    rays_trace(system, &rays, NULL);
    return rays_get(&rays, 0, system->index_last);
}

/* Where the chief ray meets the image plane. */
static bool distortion_follow(const struct distortion_map *map, const struct beam *beam,
                              struct distortion_point *point, struct error *error)
{
    struct arena *arena = map->setup.arena;
    const struct arena_mark mark = arena_mark(arena);
    const bool has_stop = !map->setup.first.is_telecentric;
    struct aim aim;
    struct ray chief;
    bool found = has_stop ? aim_open(map->open, beam, arena, &aim, error)
                          : aim_at_entrance(beam, &map->setup.first, 0, 0, &chief, error);
    if (found) {
        chief = has_stop ? aim_chief(&aim) : chief;
        const struct ray end = distortion_take(map->image, &chief, arena);
        found = end.status == RAY_OK ||
                fail(error, ERROR_DOMAIN, "the chief ray is lost at surface %zu: %s", end.surface,
                     ray_status_name(end.status));
        point->image[0] = end.point[0];
        point->image[1] = end.point[1];
        point->is_lit = found && distortion_take(map->lit, &chief, arena).status == RAY_OK;
    }
    arena_reset(arena, mark);
    return found;
}

/* -------- against the projection -------- */

/* Heights count along the direction of the field, turned so that it points up, or along +x. */
static double along_field(const double towards[2], const double at[2])
{
    const bool down = towards[1] < 0 || (towards[1] == 0 && towards[0] < 0);
    const double height = at[0] * towards[0] + at[1] * towards[1];
    return down ? -height : height;
}

static bool distortion_compare(const struct distortion_map *map, const struct beam *beam,
                               const struct distortion_place *place, struct distortion_point *point,
                               struct error *error)
{
    double ideal = place->amount; /* the height of the projection over its scale */
    if ((map->setup.object.is_infinite &&
         !fov_height(map->projection, place->amount, &ideal, error)) ||
        !distortion_follow(map, beam, point, error)) {
        return false;
    }
    const double at[2] = {map->squeeze * place->towards[0], place->towards[1]};
    const double size = hypot(at[0], at[1]), towards[2] = {at[0] / size, at[1] / size};
    ideal *= map->scale * size;
    point->field = place->amount;
    point->ideal = along_field(towards, (double[2]){ideal * towards[0], ideal * towards[1]}) + 0.0;
    point->height = along_field(towards, point->image) + 0.0;
    point->percent =
        place->amount > 0 ? 100 * ((point->height - point->ideal) / point->ideal) : (double)NAN;
    return true;
}

bool distortion_towards(const struct distortion_map *map, const double towards[2], double amount,
                        struct distortion_point *point, struct error *error)
{
    struct beam beam;
    const struct distortion_place place = {{towards[0], towards[1]}, amount};
    const double n = fabs(map->setup.first.index_object);
    if (!map->setup.object.is_infinite) {
        const double from[3] = {amount * towards[0], amount * towards[1],
                                -map->setup.object.distance.hi};
        if (!beam_from_point(from, n, &beam, error)) {
            return false;
        }
    } else if (amount < PI) {
        const double side = sin(amount);
        beam = beam_along((double[3]){side * towards[0], side * towards[1], cos(amount)}, n);
    } else {
        return fail(error, ERROR_DOMAIN, "a field angle of %.6g deg: it must be below 180",
                    amount * DEGREES_PER_RADIAN);
    }
    return distortion_compare(map, &beam, &place, point, error);
}

bool distortion_direction(const struct distortion_map *map, const struct field_point *field,
                          double towards[2], double *amount, struct error *error)
{
    struct beam beam;
    if (!setup_beam(&map->setup, field, &beam, error)) {
        return false;
    }
    const struct distortion_place place = distortion_place_of(&beam);
    towards[0] = place.towards[0];
    towards[1] = place.towards[1];
    *amount = place.amount;
    return true;
}

bool distortion_at(const struct distortion_map *map, const struct field_point *field,
                   struct distortion_point *point, struct error *error)
{
    struct beam beam;
    if (!setup_beam(&map->setup, field, &beam, error)) {
        return false;
    }
    const struct distortion_place place = distortion_place_of(&beam);
    return distortion_compare(map, &beam, &place, point, error);
}

bool distortion_of_ideal(const struct distortion_map *map, const double ideal[2], double image[2],
                         struct error *error)
{
    const double x = ideal[0] / map->squeeze, radius = hypot(x, ideal[1]), size = fabs(map->scale);
    const double sign = map->scale < 0 ? -1 : 1;
    const bool off_axis = radius > 0;
    const double towards[2] = {off_axis ? sign * x / radius : 0,
                               off_axis ? sign * ideal[1] / radius : 1};
    double amount = radius / size, full;
    struct distortion_point point;
    if (off_axis && map->setup.object.is_infinite) {
        if (!fov_angle(map->projection, size, 2 * radius, &full, error)) {
            return false;
        }
        amount = full / 2;
    }
    if (!distortion_towards(map, towards, amount, &point, error)) {
        return false;
    }
    image[0] = point.image[0];
    image[1] = point.image[1];
    return true;
}

/* -------- TV distortion -------- */

/* The height of the picture at a place across it, which keeps its sign. */
static bool tv_height_find(const struct distortion_map *map, double x, double half, double *height,
                           struct error *error)
{
    double upper[2], lower[2];
    if (!distortion_of_ideal(map, (double[2]){x, half}, upper, error) ||
        !distortion_of_ideal(map, (double[2]){x, -half}, lower, error)) {
        return false;
    }
    *height = upper[1] - lower[1];
    return true;
}

bool tv_distortion_find(const struct distortion_map *map, const double half[2],
                        struct tv_distortion *tv, struct error *error)
{
    double left, right, middle;
    if (!tv_height_find(map, -half[0], half[1], &left, error) ||
        !tv_height_find(map, half[0], half[1], &right, error) ||
        !tv_height_find(map, 0, half[1], &middle, error)) {
        return false;
    }
    tv->smia = ((left + right) / 2 - middle) / middle;
    tv->traditional = tv->smia / 2;
    return true;
}

/* -------- the lens -------- */

/* What there is to compare with, at all wavelengths alike. */
static bool distortion_find_scale(const struct setup *setup, enum projection projection,
                                  double *scale, struct error *error)
{
    const struct first_order *first = &setup->first;
    if (setup->object.is_infinite) {
        *scale = fabs(first->index_object) * first->efl;
        return !first->is_afocal ||
               fail(error, ERROR_DOMAIN,
                    "the lens is afocal: it has no focal length that an ideal image height "
                    "follows from");
    }
    *scale = first->magnification;
    if (!isfinite(*scale)) {
        return fail(error, ERROR_DOMAIN,
                    "the paraxial image of the object is infinitely far away: there is no ideal "
                    "image height");
    }
    return projection == RECTILINEAR ||
           fail(error, ERROR_DOMAIN,
                "{projection} %s is of angles, and the object is near: its ideal image is "
                "rectilinear",
                projections[projection].word);
}

/* Of a lens with cylinders: its scale in the x section over that in y. */
static bool find_squeeze(const struct setup *setup, double *squeeze, struct error *error)
{
    struct paraxial_system system;
    struct paraxial_trace trace;
    struct first_order across;
    *squeeze = 1;
    if (lens_is_round(setup->lens)) {
        return true;
    }
    if (!paraxial_compile(setup->lens, lens_primary_wavelength(setup->lens), SECTION_X,
                          setup->arena, &system, error)) {
        return false;
    }
    paraxial_trace(&system, &trace);
    first_order_compute(&system, &trace, &setup->object, &across);
    const double ratio = setup->object.is_infinite
                             ? setup->first.power / across.power
                             : across.magnification / setup->first.magnification;
    *squeeze = isfinite(ratio) && fabs(ratio) > 0 ? ratio : 1;
    return true;
}

bool distortion_open(const struct setup *setup, size_t wavelength, enum projection projection,
                     struct arena *arena, struct distortion_map *map, struct error *error)
{
    *map = (struct distortion_map){.projection = projection};
    if (!distortion_find_scale(setup, projection, &map->scale, error) ||
        !find_squeeze(setup, &map->squeeze, error)) {
        return false;
    }
    if (isnan(setup->image)) {
        return fail(error, ERROR_DOMAIN,
                    "the image is infinitely far away: there is no plane "
                    "that chief rays could meet");
    }
    map->setup = setup_at_wavelength(setup, setup->wavelengths[wavelength].wavelength, arena);
    struct setup *own = &map->setup;
    /* a chief ray goes through the centre of the stop, however wide it is */
    own->first.stop_radius = own->first.stop_radius > 0 ? own->first.stop_radius : 1;
    map->open = setup_system(own, 0, SETUP_OPEN, error);
    map->image = map->open != NULL ? setup_system(own, 0, SETUP_OPEN | SETUP_IMAGE, error) : NULL;
    map->lit = map->image != NULL ? setup_system(own, 0, SETUP_CLIPPED, error) : NULL;
    if (map->lit == NULL) {
        return false;
    }
    /* what stands in the middle of a telescope leaves it its field of view */
    map->lit = system_outer(map->lit);
    return map->open->stop != LENS_NONE || own->first.is_telecentric ||
           fail(error, ERROR_DOMAIN, "the lens has no stop: it has no chief rays");
}

/* -------- the calibrated focal length -------- */

/* The largest (sign 1) or smallest (-1) of the field: the best of 33, then closer about it. */
static bool find_extreme(const struct distortion_map *map, const double towards[2], double edge,
                         double sign, double *extreme, struct error *error)
{
    enum { PLACES = 32, ROUNDS = 4 };
    const double axis = 1e-4 * edge; /* near enough: all this is even in the field */
    double low = axis, high = edge;
    *extreme = -sign * INFINITY;
    for (int round = 0; round < ROUNDS; round++) {
        const double step = (high - low) / PLACES;
        double best = low;
        for (int i = 0; i <= PLACES; i++) {
            double amount = i < PLACES ? low + i * step : high, scale;
            struct distortion_point point;
            if (!distortion_towards(map, towards, amount, &point, error)) {
                return false;
            }
            scale = map->scale * (point.height / point.ideal);
            if (sign * scale > sign * *extreme) {
                *extreme = scale;
                best = amount;
            }
        }
        low = fmax(best - step, axis);
        high = fmin(best + step, edge);
    }
    return true;
}

bool distortion_calibrate(const struct distortion_map *map, const struct field_point *edge,
                          double *scale, struct error *error)
{
    double towards[2], end, largest, smallest;
    if (!distortion_direction(map, edge, towards, &end, error)) {
        return false;
    }
    if (!(end > 0)) {
        return fail(error, ERROR_DOMAIN,
                    "a calibrated focal length needs a field off the axis to balance");
    }
    if (!find_extreme(map, towards, end, 1, &largest, error) ||
        !find_extreme(map, towards, end, -1, &smallest, error)) {
        return false;
    }
    *scale = (largest + smallest) / 2;
    return true;
}
