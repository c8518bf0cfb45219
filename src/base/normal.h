/* base/normal.h - numbers spread as the normal distribution, from evenly spread ones. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_NORMAL_H
#define LENSCALC_BASE_NORMAL_H

/*
 * Quantiles of the standard normal distribution (mean 0, variance 1).
 *
 * Given     p  between 0 and 1, neither of them; 1e-300 at least
 * Result    the z below which the share p lies: an evenly spread p makes a normal z. Of 1 - p,
 *           where that is exact, it is -z. The same bits on every processor
 * Formula   three quotients of polynomials of degree 7: in p - 1/2 for |p - 1/2| <= 0.425, else in
 *           r = sqrt(-ln(least of p and 1 - p)), up to 5 and beyond
 * Source    [Wichura88] algorithm AS 241, PPND16
 * Errors    none: the range is the caller's promise
 * Limits    relative error below 1e-15 (unit test, against 40 digits). Numbers of base/random.h are
 *           multiples of 2^-53: |z| ends at 8.21
 */
double normal_quantile(double p);

#endif
