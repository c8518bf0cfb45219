/* photo/mired.h - colour temperatures, and the filters that turn one into another. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_MIRED_H
#define LENSCALC_PHOTO_MIRED_H

#include "base/error.h"

#include <stdbool.h>

/*
 * Shift of a conversion filter that makes light of one colour temperature look like another.
 *
 * Given     from, to  K, 500 to 100000
 *           shift     receives it, micro reciprocal kelvin (mired); + is amber, - is blue
 * Formula   10^6/to - 10^6/from
 * Source    [Priest33]: equal steps of the reciprocal look about equal, and a filter shifts it by
 *           the same amount whatever the light
 * Errors    a temperature outside its range
 * Limits    of light near that of a black body; the green of fluorescent lamps is no matter of this
 */
bool mired_shift(double from, double to, double *shift, struct error *error);

/*
 * Colour temperature behind filters of a shift.
 *
 * Given     from   K, 500 to 100000;  shift  of all filters, mired;  to  receives it, K
 * Formula   10^6/(10^6/from + shift)
 * Source    as mired_shift
 * Errors    a temperature outside its range; a shift to beyond infinity
 */
bool mired_filtered(double from, double shift, double *to, struct error *error);

/*
 * What filters of a shift let through at a wavelength, as a share of what they do at 555 nm.
 *
 * Given     shift       mired; wavelength  um, > 0
 * Formula   exp(-10^-6 shift c2 (1/l - 1/0.555)), c2 = 14387.77 um K: exp(-c2/(l T)) of one
 *           temperature becomes that of another with 1/T' = 1/T + 10^-6 shift
 * Source    [Priest33], of Wien's law; c2 = h c/k
 * Limits    Wien's law for Planck's: within 1 % at 700 nm up to 4400 K, for shifts alone far better
 */
double mired_transmittance(double shift, double wavelength);

#endif
