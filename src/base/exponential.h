/* base/exponential.h - logarithm and exponential with the same bits on every processor. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_EXPONENTIAL_H
#define LENSCALC_BASE_EXPONENTIAL_H

/*
 * For what decides by random numbers: libm's functions differ in the last bit between processors,
 * and one electron more in one pixel is another file.
 *
 * Given     x   of the logarithm any positive number; of the exponential -708 to 709
 * Result    within 2 units of the last place
 * Formula   x = 2^k m, m in sqrt(1/2)..sqrt(2): ln x = k ln 2 + 2 atanh((m - 1)/(m + 1));
 *           e^x = 2^k e^r, |r| <= ln(2)/2; both by their power series
 * Source    [Abramowitz64] 4.1.27, 4.2.1
 * Errors    none: the range is the caller's promise
 */
double natural_logarithm(double x);
double exponential(double x);

#endif
