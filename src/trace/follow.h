/* trace/follow.h - one ray seen at every surface, exact and paraxial. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_FOLLOW_H
#define LENSCALC_TRACE_FOLLOW_H

#include "base/arena.h"
#include "base/error.h"
#include "trace/system.h"

#include <stddef.h>

/* A ray where it has met a surface: in the frame of that surface's vertex, behind it. */
struct ray_intersection {
    struct ray ray;           /* status and surface as far as here; NaN from a loss on */
    struct ray_angles angles; /* rad; NaN where the ray is lost */
};

/*
 * Trace one ray and keep what it is at every surface.
 *
 * Given     start     as for rays_set
 *           meetings  receives system.places of them, in the order of light
 * Result    the image plane, if the system has one, is the last: its frame has its origin on the
 *           axis there; the angle of incidence is that with the axis, refraction the same
 */
void ray_follow(const struct system *system, const struct ray *start, struct arena *arena,
                struct ray_intersection *meetings);

/* A paraxial ray at a plane through a vertex: heights, and slopes behind it. */
struct paraxial_intersection {
    double x, y, slope_x, slope_y; /* mm, dx/dz, dy/dz */
};

/*
 * The paraxial ray that begins as an exact one.
 *
 * Given     lens, wavelength  in one position, um
 *           start     point and direction in the frame of the first vertex
 *           meetings  receives lens->surface_count
 * Formula   slopes u = L/N, M/N; heights at the first vertex x - z u; then refraction and transfer
 *           in each section by itself, as if all parts were centred
 * Result    NaN throughout for a ray that does not run along the light: N <= 0
 * Errors    as paraxial_compile
 */
bool ray_follow_paraxially(const struct lens *lens, double wavelength, const struct ray *start,
                           struct arena *arena, struct paraxial_intersection *meetings,
                           struct error *error);

#endif
