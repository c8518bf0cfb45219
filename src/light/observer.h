/* light/observer.h - the standard eye: what light of each wavelength adds to X, Y and Z. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_LIGHT_OBSERVER_H
#define LENSCALC_LIGHT_OBSERVER_H

#include "light/spectrum.h"

#include <stddef.h>

/* The wavelengths that are seen, um, and the step of the table. */
#define OBSERVER_LEAST 0.360
#define OBSERVER_MOST  0.830
#define OBSERVER_STEP  0.005
enum { OBSERVER_ROWS = 95 };

/*
 * Light that the standard eye sees.
 *
 * Given     light    its spectrum, of a kind that spectrum_at knows
 *           surface  null, or what reflects it: a table
 *           edges    `count` + 1 wavelengths between the limits above, um, rising
 *           xyz      receives for each stretch between two edges the integral of light, surface
 *                    and the functions x, y, z over the wavelength in um
 * Formula   trapezoids between the rows of all tables and the edges: for tables with steps of 5 nm
 *           the sums that CIE prescribes
 * Source    [CIE04] 7.1 and table T.4, colour matching functions of the 2 degree observer of 1931
 */
void observer_sum(const struct spectrum *light, const struct spectrum *surface, const double *edges,
                  size_t count, double (*xyz)[3]);

#endif
