/* optics/conjugates.h - object and image of a lens, in any media. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_CONJUGATES_H
#define LENSCALC_OPTICS_CONJUGATES_H

#include "base/error.h"
#include "base/pair.h"
#include "optics/paraxial.h"

#include <stdbool.h>
#include <stddef.h>

/* From where an object lies a distance to the left, or an image a distance to the right. */
enum conjugate_from {
    CONJUGATE_FROM_PRINCIPAL, /* H; H' */
    CONJUGATE_FROM_FRONT,     /* the first vertex; the last */
    CONJUGATE_FROM_FOCAL,     /* F; F' */
    CONJUGATE_FROM_ENTRANCE,  /* entrance pupil; exit pupil */
    CONJUGATE_FROM_SENSOR,    /* the image plane: the distance from object to image */
    CONJUGATE_FROMS
};

/* What is asked for: one of these. */
enum conjugate_asked {
    CONJUGATE_OBJECT,       /* the object is at `distance` from `from` */
    CONJUGATE_IMAGE,        /* the image is */
    CONJUGATE_MAGNIFICATION /* n u/(n' u') is `magnification`, negative where upside down */
};

struct conjugate_question {
    enum conjugate_asked asked;
    enum conjugate_from from;
    double distance; /* mm, may be infinite; negative: a virtual object, a virtual image */
    double magnification;
};

/*
 * A point on the axis before the lens as a ray from it: height y at the first vertex, v = n u. It
 * lies n y/v to the left of the vertex, infinitely far for v = 0, to the right for y/v < 0.
 */
struct conjugate_ray {
    struct pair y, v;
};

/* Object and image. Lengths in mm; infinite where a point is infinitely far. */
struct conjugate_points {
    /* the object, to the left of the first vertex, H, F and the entrance pupil (NaN: no stop) */
    double object, object_principal, object_focal, object_pupil;
    /* the image, to the right of the last vertex, H', F' and the exit pupil */
    double image, image_principal, image_focal, image_pupil;
    double total;         /* from object to image */
    double magnification; /* lateral, y'/y = n u/(n' u'); infinite for an object at F */
    double angular;       /* u'/u; infinite for an object at infinity, 0 for one at F */
    double longitudinal;  /* dz'/dz of small depths */
    bool object_is_virtual, image_is_virtual;
};

/*
 * Find the object that a question asks for.
 *
 * Given     system    compiled; trace, of it
 *           rays      receives it: two for a distance from object to image, else one
 * Result    how many, 0 for an error
 * Formula   [a b; c d] the whole, x = object/n, x' = image/n', a1, b1 the part before the stop:
 *           x = s/n + (1-d)/c from H, s/n - d/c from F, s/n - b1/a1 from the entrance pupil;
 *           x = -(b + x' d)/(a + x' c); x = (1/m - d)/c;
 *           total T: n' m^2 - (n' a + n d + c (T - length)) m + n = 0, each root without
 *           cancellation; afocal: (n - n' a^2) x = T - length + n' a b
 * Source    [Smith05]; the quadratic derived here: T = n x + length + n' x' with x' = (m - a)/c,
 *           put back in by tests/truth/check_conjugate.py
 * Errors    ERROR_DOMAIN: a distance from H or F of an afocal system, from a pupil without a stop
 *           or from one at infinity, a magnification that an afocal system has not, a distance from
 *           object to image that no real or virtual image has (the message names the limits)
 * Limits    all in pairs: as exact as the decimals. T within 1e-14 of its limit counts as the limit
 */
size_t conjugate_find(const struct paraxial_system *system, const struct paraxial_trace *trace,
                      const struct conjugate_question *question, struct conjugate_ray rays[2],
                      struct error *error);

/*
 * Where is the image, and how large?
 *
 * Given     ray  from the object, y and v not both 0
 * Formula   y' = a y + b v, v' = c y + d v: image -n' y'/v', m = v/v', u'/u = (n/n') v'/v,
 *           dz'/dz = (n'/n) m^2; an afocal system has m = a everywhere
 * Source    [Smith05]
 * Limits    v' below 2^-90 of its two parts counts as 0: the image is infinitely far
 */
void conjugate_compute(const struct paraxial_system *system, const struct paraxial_trace *trace,
                       const struct conjugate_ray *ray, struct conjugate_points *points);

#endif
