/* optics/paraxial.h - paraxial rays (y, v = n u) through a system, compensated. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_PARAXIAL_H
#define LENSCALC_OPTICS_PARAXIAL_H

#include "base/arena.h"
#include "base/error.h"
#include "base/pair.h"
#include "optics/lens.h"

#include <stdbool.h>
#include <stddef.h>

/* A lens at one wavelength, made for tracing. After an odd number of mirrors n is negative. */
struct paraxial_surface {
    struct pair power;   /* (n' - n) c, 1/mm */
    struct pair reduced; /* t/n' to the next surface, mm; 0 at the last */
};

struct paraxial_system {
    const struct paraxial_surface *surfaces;
    size_t count;
    size_t stop;              /* LENS_NONE = no stop */
    const struct pair *index; /* count + 1: before the first, after each surface; signed */
    const struct pair *curvature;
    double strongest; /* the largest |power| of a surface, 1/mm */
    double petzval;   /* sum (n' - n) c/(n n'), 1/mm */
    double length;    /* of the vertices, first to last, mm, signed */
};

/* Below this share of what made it a sum that should vanish is rounding of the decimals: 2^-95. */
#define PARAXIAL_NOTHING 2.5243548967072378e-29

/* [y'; v'] = [[a, b], [c, d]] [y; v] */
struct paraxial_matrix {
    struct pair a, b, c, d;
};

/* The whole system, what lies before its stop (identity where there is none), and the rest. */
struct paraxial_trace {
    struct paraxial_matrix whole, front, rear;
};

/* A ray at one surface: the height there, and n u before and after. */
struct paraxial_ray {
    double y, before, after; /* mm, 1, 1 */
};

/*
 * Make a lens ready for tracing.
 *
 * Given     lens        in one position (lens_at_position)
 *           wavelength  um
 *           section     which section of a system with cylinders
 * Errors    as medium_index
 */
bool paraxial_compile(const struct lens *lens, double wavelength, enum lens_section section,
                      struct arena *arena, struct paraxial_system *system, struct error *error);

/*
 * Trace the two basic rays once through the system.
 *
 * Result    the matrix from before the first to after the last vertex, and from before the first
 *           to the stop, each number with its low-order part
 * Formula   v' = v - y P, y' = y + (t/n) v, each with the rounding error of every product and sum
 *           carried along: y + ey, v + ev
 * Source    [Knuth97] 4.2.2 (error of a sum), [Dekker71] (error of a product)
 * Limits    the result is that of arithmetic with about 32 digits: the power of an afocal system
 *           of exact decimals comes out below 1e-30 of its surfaces' powers
 */
void paraxial_trace(const struct paraxial_system *system, struct paraxial_trace *trace);

/* Is the power of the whole only rounding of the decimals: below 2^-95 of the strongest surface? */
bool paraxial_is_afocal(const struct paraxial_system *system, const struct paraxial_trace *trace);

/*
 * Follow one ray through all surfaces.
 *
 * Given     y, v  before the first vertex: height in mm, n u
 *           rays  receives one a surface
 */
void paraxial_follow(const struct paraxial_system *system, struct pair y, struct pair v,
                     struct paraxial_ray *rays);

#endif
