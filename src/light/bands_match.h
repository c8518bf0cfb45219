/* light/bands_match.h - light in many bands that is seen in the colour of its whole spectrum. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_BANDS_MATCH_H
#define LENSCALC_LIGHT_BANDS_MATCH_H

#include "light/bands.h"
#include "light/colour.h"
#include "light/spectrum.h"

/* X, Y, Z of a spectrum, with D65 as the white of sRGB, of Y = 1: each over that of D65. */
struct colour bands_whole(const struct spectrum *light);

/*
 * Change light in many bands as little as can be, so that it has the colour of its spectrum.
 *
 * Given     bands  of bands_many
 *           light  no RGB
 *           of     the parts of it that the bands have, of any luminance; receives those of
 *                  luminance 1. Light narrower than a band is more saturated than any mixture of it
 *                  and its neighbours: then they make the nearest to its colour, see bands_off
 * Formula   with the shares y of X + Y + Z and the chromaticities c of the bands, those from a that
 *           make sum (y - a)^2/2 w + P |sum c y - t|^2/2 smallest, y >= 0, P = 1e10, the widths w
 *           half a and a quarter of each neighbour's, so that no light comes up far from where it
 *           is: y = max(0, a + w c.m) with m = P (t - sum c y), by Newton's method in the three
 *           numbers of m
 * Source    derived here
 */
void bands_match(const struct bands *bands, const struct spectrum *light, double of[BANDS_MOST]);

/*
 * How far light in many bands is from the colour of its whole spectrum.
 *
 * Given     light, of  of bands_of_light
 * Result    distance in u', v'; the eye tells some 0.004 apart. 0 of RGB
 */
double bands_off(const struct bands *bands, const struct spectrum *light,
                 const double of[BANDS_MOST]);

#endif
