/* file/lens_solve.h - thicknesses and curvatures that follow from rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_LENS_SOLVE_H
#define LENSCALC_FILE_LENS_SOLVE_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/lens.h"

enum solve_ray { SOLVE_MARGINAL, SOLVE_CHIEF };

/* A paraxial ray at a surface. */
struct solve_state {
    struct pair y;                         /* height there, mm */
    struct pair before, after;             /* n u on both sides */
    struct pair index_before, index_after; /* signed: negative after an odd number of mirrors */
};

/*
 * Follow the marginal or the chief ray to a surface, at the primary wavelength.
 *
 * Given     lens     complete up to and with that surface (what follows does not matter, except
 *                    for an f-number, and for the stop of a chief ray); in one position
 *           surface  0 .. surface_count - 1
 * Errors    ERROR_DOMAIN: no aperture (then the marginal ray is that of height 1, or of slope 1
 *           from an object point: enough for a height of 0), no stop or field for a chief ray
 */
bool solve_follow(const struct lens *lens, size_t surface, enum solve_ray ray, struct arena *arena,
                  struct solve_state *state, struct error *error);

/*
 * The height of the ray at every surface, mm, in time linear in their number.
 *
 * Given     heights  room for one a surface of the lens
 * Errors    as solve_follow
 */
bool solve_heights(const struct lens *lens, enum solve_ray ray, struct arena *arena,
                   double *heights, struct error *error);

/* The thickness behind a surface that brings a ray to a height at the next one: n' (h - y)/v'. */
struct pair solve_thickness(const struct solve_state *state, struct pair height);

/* The curvature of a surface behind which a ray has the angle u': (v - n' u')/(y (n' - n)). */
struct pair solve_curvature(const struct solve_state *state, struct pair angle);

#endif
