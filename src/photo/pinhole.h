/* photo/pinhole.h - a camera with a hole in place of a lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_PINHOLE_H
#define LENSCALC_PHOTO_PINHOLE_H

#include <stdbool.h>

#include "base/error.h"

/* Which hole is best; the square of its diameter over wavelength and reduced distance. */
enum pinhole_rule { PINHOLE_RAYLEIGH, PINHOLE_PETZVAL, PINHOLE_YOUNG, PINHOLE_AIRY };

/* Lengths in mm, all above 0. */
struct pinhole_setting {
    double f; /* from the hole to the film */
    double s; /* from the subject to the hole; may be inf */
    double wavelength;
};

/* What a hole makes of it. */
struct pinhole {
    double fnumber; /* f/d */
    double blur;    /* disc of a point on the film, mm */
    double best_f; /* from the hole to the film where this hole is the best one, mm; inf: nowhere */
};

/*
 * The diameter of the hole that makes the sharpest picture.
 *
 * Given     setting  checked here
 *           rule     see Formula
 *           d        receives the diameter, mm
 * Formula   d = sqrt(k wavelength r), 1/r = 1/f + 1/s. Rayleigh k = 3.6 (d = 1.9 sqrt(wavelength f)
 *           for what is far), Petzval 2, Young 4; Airy 2.44: a hole as wide as its Airy disc
 * Source    [Mielenz99]: its u = 2 pi a^2/(wavelength r) is 1.8 pi by Rayleigh and pi by Petzval;
 *           [Young89]: the radius is sqrt(wavelength f)
 * Errors    a length not above 0 or not finite; a result beyond the range of double
 * Limits    the middle of the picture, a thin edge; at the sides the hole looks narrower
 */
bool pinhole_best(const struct pinhole_setting *setting, enum pinhole_rule rule, double *d,
                  struct error *error);

/*
 * What a hole of a diameter does.
 *
 * Given     d  mm, > 0
 * Formula   N = f/d; blur: the larger of its shadow d (1 + f/s) and its Airy disc 2.44 N
 *           wavelength; best_f from pinhole_best: 1/f = k wavelength/d^2 - 1/s
 * Source    [Young89]: shadow and diffraction by turns limit the resolution
 * Errors    as pinhole_best; a diameter not above 0
 * Limits    near the best diameter both count, and the disc is narrower than either says
 */
bool pinhole_find(const struct pinhole_setting *setting, enum pinhole_rule rule, double d,
                  struct pinhole *pinhole, struct error *error);

#endif
