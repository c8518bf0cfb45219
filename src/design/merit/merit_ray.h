/* design/merit/merit_ray.h - single real rays, chief and edge rays, with their derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_RAY_H
#define LENSCALC_DESIGN_MERIT_MERIT_RAY_H

#include "design/merit/merit_state.h"
#include "trace/aim/aim.h"
#include "trace/kernel/rays.h"
#include "trace/system.h"

/* A ray somewhere, by one column: in the frame of the surface met last. */
struct merit_ray {
    struct dual at[3];    /* mm */
    struct dual along[3]; /* n times the direction cosines */
};

/* Which ray. */
struct merit_ray_question {
    const struct merit_slot *slot;
    struct merit_light *light;
    const struct field_point *field;
    double pupil[2];       /* where it crosses the stop, in radii; 0: the chief ray */
    struct aim_near *near; /* its field's chief ray as it was found last; null: not kept */
};

/* Passing all surfaces of the lens; or to the image plane. */
#define MERIT_RAY_IMAGE LENS_NONE

/*
 * Aim a ray, as the lens is now.
 *
 * Given     arena  for what it takes; the caller resets it
 *           start  receives the ray before the first surface, one a column
 * Formula   with s(a, b, p) its place in the stop, e the stop's radius, T the place in radii:
 *           d(a, b) = (ds/d(a, b))^-1 (T de - ds/dp); where the object moves with the lens (image
 *           heights) its direction turns too
 * Source    derived here: the theorem of implicit functions; sweeps of trace/derivative.h
 * Errors    merit->why: as aim_open; a field of real image heights
 */
bool merit_ray_start(struct merit *merit, const struct merit_ray_question *question,
                     struct arena *arena, struct merit_ray *start);

/*
 * Follow it.
 *
 * Given     passed  so many surfaces of the lens; MERIT_RAY_IMAGE: to the image plane
 *           end     receives the ray there, one a column
 * Errors    merit->why: it is lost; as merit_image
 */
bool merit_ray_follow(struct merit *merit, const struct merit_ray_question *question, size_t passed,
                      const struct merit_ray *start, struct arena *arena, struct merit_ray *end);

/*
 * Can the lens have such rays?
 *
 * Errors    ERROR_DOMAIN: no stop; a thick lens, which has no derivatives; a field of real image
 *           heights
 */
bool merit_ray_check(const struct merit_place *place, const struct field_point *field,
                     struct error *error);

/* Where they are now, without derivatives. */
struct merit_front {
    struct system system;
    struct rays rays;
    size_t count;
};

/*
 * Before the first surface.
 *
 * Given     light   their wavelength
 *           starts  of merit_ray_start; null: a ray that could not be aimed, and is lost
 * Errors    merit->why: as system_compile
 */
bool merit_front_open(struct merit *merit, const struct merit_ray_question *question,
                      struct merit_ray *const *starts, size_t count, struct merit_front *front);

/* Through one more surface, from before it. */
void merit_front_pass(struct merit_front *front, size_t surface);

struct merit_ray merit_front_ray(const struct merit_front *front, size_t i);
bool merit_front_lost(const struct merit_front *front, size_t i);

#endif
