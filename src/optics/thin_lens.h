/* optics/thin_lens.h - a thin lens or a spherical mirror from its conjugates; the magnifier. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_THIN_LENS_H
#define LENSCALC_OPTICS_THIN_LENS_H

#include <math.h>
#include <stdbool.h>

#include "base/error.h"
#include "base/pair.h"

/*
 * What is known of a lens or mirror in air, real distances positive: an object in front of it, an
 * image where its light goes. NaN = not given; inf = at infinity. Exactly two are given.
 */
struct thin_lens_given {
    double object, image; /* mm, not 0 */
    double magnification; /* lateral, negative upside down, not 0 */
    double total; /* from object to image of a lens, mm, > 0; with the magnification alone */
};

/*
 * The power that makes them conjugate.
 *
 * Given     power  receives 1/f, 1/mm; 0 for an afocal one
 * Formula   1/f = 1/s + 1/s', m = -s'/s; with the total T = s + s': 1/f = -(1 - m)^2/(T m)
 * Source    [OpenStax16] ch. 2.4 and, of mirrors, ch. 2.2; the last from s = T/(1 - m)
 * Errors    ERROR_USAGE: not two of them, or a total with a distance; ERROR_DOMAIN: a 0, an
 *           infinite distance with a magnification
 */
bool thin_lens_power(const struct thin_lens_given *given, struct pair *power, struct error *error);

/*
 * Where the object of a mirror stands that has its image so far from it.
 *
 * Given     distance       between object and image, whichever is nearer to the mirror, mm, > 0
 *           magnification  lateral, negative upside down
 * Result    object in front of the mirror, mm, > 0; inf where both are in one place (-1)
 * Formula   D = |s' - s|, s' = -m s: s = D/|1 + m|
 * Source    [OpenStax16] ch. 2.2
 */
static inline double mirror_object(double distance, double magnification)
{
    return distance / fabs(1 + magnification);
}

/*
 * How much larger an object looks through a lens before the eye than from the near point.
 *
 * Given     object      its distance in front of the lens, mm, > 0, at most the focal length
 *           near_point  from which the naked eye looks, mm
 * Result    angular magnification M; near_point/f of an image at infinity, near_point/f + 1 of one
 *           at the near point
 * Formula   M = near_point (1/L + 1/f) with L the distance of the virtual image: near_point/s
 * Source    [OpenStax16] ch. 2.7, the eye at the lens
 */
static inline double thin_lens_magnifier(double object, double near_point)
{
    return near_point / object;
}

#endif
