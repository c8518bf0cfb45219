/* trace/pupil/focus.h - where the exact rays of a beam meet best. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_FOCUS_H
#define LENSCALC_TRACE_PUPIL_FOCUS_H

#include "base/arena.h"
#include "base/error.h"
#include "trace/aim/aim.h"
#include "trace/kernel/rays.h"

/*
 * The plane across the axis where weighted rays spread least: the smallest root mean square
 * distance from their centroid.
 *
 * Given     rays     behind the lens, one block or more, all in one frame; lost ones do not count
 *           weights  one a ray, not negative
 * Result    its z in the frame of the rays, mm; NaN: fewer than two rays, or parallel ones
 * Formula   with x, y where a ray crosses z = 0, its slopes a = P/R, b = Q/R, and deviations from
 *           weighted means: z = -sum w (x a + y b)/sum w (a^2 + b^2), by least squares: the mean
 *           square is a parabola in z
 * Source    derived here: the derivative of sum w |(x + z a, y + z b)|^2 in z, about the means
 */
double rays_best_focus(const struct rays *rays, const double *weights);

/*
 * Best focus of a lens on its axis.
 *
 * Given     system  without clipping, forward, without an image plane
 *           object  where the object is; first: of the lens
 * Result    distance of the plane behind the last vertex, mm: of 72 rays that fill the stop, at
 *           Gauss's points. The clear apertures of other surfaces do not count
 * Errors    ERROR_DOMAIN: as aim_open; every ray is lost; the rays leave the lens parallel
 */
bool lens_best_focus(const struct system *system, const struct conjugate_object *object,
                     const struct first_order *first, struct arena *arena, double *focus,
                     struct error *error);

#endif
