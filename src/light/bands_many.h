/* light/bands_many.h - sums over the spectrum, band by band. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_BANDS_MANY_H
#define LENSCALC_LIGHT_BANDS_MANY_H

#include "light/bands.h"

/*
 * Light in bands, with D65 as 1 in each of them.
 *
 * Given     bands    of bands_many: each the middle of its stretch, the first and the last also
 *                    hold what is seen beyond
 *           light    any spectrum of spectrum_at
 *           surface  null, or what reflects the light
 *           of       receives the ratio of sum x + y + z of a band to that of D65
 */
void bands_ratios(const struct bands *bands, const struct spectrum *light,
                  const struct spectrum *surface, double of[BANDS_MOST]);

/* Linear sRGB of sums over the spectrum, see observer_sum; white as IEC's matrix has it. */
void bands_rgb_of_sum(const double xyz[3], double rgb[3]);

#endif
