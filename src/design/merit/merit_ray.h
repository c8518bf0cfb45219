/* design/merit/merit_ray.h - single real rays, chief and edge rays, with their derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_RAY_H
#define LENSCALC_DESIGN_MERIT_MERIT_RAY_H

#include "design/merit/merit_beams.h"

/* A ray somewhere, by one column: in the frame of the surface met last. */
struct merit_ray {
    struct dual at[3];    /* mm */
    struct dual along[3]; /* n times the direction cosines */
};

/*
 * Choose some: a block of the bundle each, by wavelengths, in each the fields, in each the points.
 *
 * Given     wish  their fields, wavelengths and points, through the stop in radii of it; is_bare
 * Errors    as merit_bundle_open
 */
bool merit_ray_open(struct merit *merit, const struct merit_slot *slot, struct bundle_wish *wish,
                    struct arena *arena, struct merit_beams *beams, struct error *error);

/*
 * Follow one, of beams that are aimed.
 *
 * Result    false: it could not be aimed, as merit->why says
 */
bool merit_ray_trace(struct merit *merit, struct merit_beams *beams, size_t ray);

/*
 * The ray that was traced last, before a place: behind so many surfaces; LENS_NONE: in the image.
 *
 * Result    without derivatives; false: it is lost before
 */
bool merit_ray_at(const struct merit_beams *beams, size_t ray, size_t place, struct merit_ray *at);

/*
 * The same, one a column.
 *
 * Result    false: merit->why
 */
bool merit_ray_derive(struct merit *merit, const struct merit_beams *beams, size_t ray,
                      size_t place, struct merit_ray *end);

/*
 * Can the lens have such rays?
 *
 * Errors    ERROR_DOMAIN: no stop; a thick lens, which has no derivatives; a field of real image
 *           heights
 */
bool merit_ray_check(const struct merit_place *place, const struct field_point *field,
                     struct error *error);

#endif
