/* photo/characteristic.h - density of a developed film against its exposure. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_CHARACTERISTIC_H
#define LENSCALC_PHOTO_CHARACTERISTIC_H

#include "base/error.h"

#include <stdbool.h>

/* A black-and-white negative; densities are decadic. */
struct negative {
    double speed; /* ISO, > 0 */
    double base;  /* density of base and fog, 0 to 1 */
    double most;  /* the largest density, base + 1 at least, to 6 */
    double toe;   /* in log10 of exposure, how gently the ends bend: 0.05 to 0.4 */
};

/* Base 0.25, at most 2.5, toe 0.2: no particular film. */
struct negative negative_plain(double speed);

/* Its curve, ready to be asked. */
struct characteristic {
    struct negative negative;
    double gradient;            /* of the straight part, gamma */
    double toe_at, shoulder_at; /* log10 of exposure in lx s where the straight part would end */
};

/*
 * The curve that a speed means.
 *
 * Result    curve   through the two points by which speed is defined: 0.10 above base and fog at
 *                   0.8/S lx s, and 0.80 more at 20 times (10^1.30) that exposure
 * Formula   D = base + gamma w (p((x - a)/w) - p((x - b)/w)), x = log10 H, p(u) = ln(1 + e^u), w
 *           the toe, b = a + (most - base)/gamma; a and gamma by bisection
 * Source    the two points [IsoFilm93]; the form of the ends is a choice here: curves of makers are
 *           pictures, not numbers
 * Errors    ERROR_DOMAIN: a number outside its range
 * Limits    black and white, developed to the contrast of the standard; reciprocity failure is
 *           another matter (photo/reciprocity.h)
 */
bool characteristic_open(const struct negative *negative, struct characteristic *curve,
                         struct error *error);

/* The exposure of the speed point, 0.8/S, lx s. */
double characteristic_speed_point(const struct characteristic *curve);

/* Density at an exposure H >= 0, lx s; at 0 the base. */
double characteristic_density(const struct characteristic *curve, double H);

/*
 * Light of a positive made from a density, as far as the print can be perfect.
 *
 * Result    0.18 for the density of what a meter gives, 10/S lx s; proportional to the exposure
 *           where the curve is straight
 * Formula   0.18 10^((D - D(10/S))/gamma)
 * Limits    black is what the base prints: 0.014 of the plain negative, not 0
 */
double characteristic_print(const struct characteristic *curve, double density);

/*
 * Grain: standard deviation of the density in an area.
 *
 * Given     rms   granularity as makers state it: 1000 times the deviation within a circle of
 *                 0.048 mm at a density of 1 above the base; >= 0
 *           area  mm^2, > 0
 * Formula   rms/1000 sqrt(pi 0.024^2/area) sqrt(density - base)
 * Source    [Selwyn35] (area); that the variance grows with the density [James77]
 * Limits    areas that hold many grains; no grain larger than them
 */
double characteristic_grain(const struct characteristic *curve, double rms, double area,
                            double density);

#endif
