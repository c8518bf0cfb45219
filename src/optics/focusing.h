/* optics/focusing.h - bring an image to a fixed plane by changing gaps of a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_FOCUSING_H
#define LENSCALC_OPTICS_FOCUSING_H

#include "base/arena.h"
#include "optics/conjugates.h"
#include "optics/lens.h"

enum { FOCUS_GAPS = 8, FOCUS_SOLUTIONS = 24 };

/* A gap grows by `weight` times the movement. The one after the last surface is that to the image
 * plane: alone it moves the whole lens. */
struct focus_gap {
    size_t surface;
    double weight; /* not 0 */
};

/* How a lens is focused. */
struct focus_mechanism {
    const struct lens *lens; /* in one position, as it stands before */
    double wavelength;       /* um, at which it is focused */
    enum lens_section section;
    struct pair image_plane; /* from the last vertex, as it stands before, mm */
    const struct focus_gap *gaps;
    size_t gap_count; /* 1 .. FOCUS_GAPS, each surface once */
};

/* The lens after a movement. */
struct focused {
    const struct lens *lens;
    struct pair movement;
    struct pair image_plane; /* from its last vertex, mm */
};

/*
 * Find the movements that bring the image of an object to the image plane.
 *
 * Given     question   an object, measured from a point of the lens as it stands when focused, or
 *                      from the image plane; or a magnification
 *           solutions  receives them, the smallest movement first
 * Result    how many, 0 for an error
 * Formula   with the gaps t + w e the height at the image plane of the ray from the axial object
 *           point is a polynomial g(e): all its real roots within the limits. A magnification m:
 *           g = a + c B/n' - m, with B from the last vertex to the image plane
 * Source    Derived here: every refraction and transfer is linear in y and v, every transfer linear
 *           in e. Put back in by tests/truth/check_conjugate.py
 * Errors    ERROR_DOMAIN: no root where no moved gap changes its sign and an object measured from
 *           the sensor stays before the lens; the message names the range of the movement and what
 *           the lens focuses on at its ends. As conjugate_find; a question for an image
 * Limits    paraxial; decimals of gaps count exactly, the movement is right to 1 ulp
 */
size_t focus_solve(const struct focus_mechanism *focusing,
                   const struct conjugate_question *question, struct arena *arena,
                   struct focused solutions[FOCUS_SOLUTIONS], struct error *error);

/* The object that the question means, for the lens once it is focused. */
bool focus_object(const struct focused *focused, const struct paraxial_system *system,
                  const struct paraxial_trace *trace, const struct conjugate_question *question,
                  struct conjugate_ray *ray, struct error *error);

#endif
