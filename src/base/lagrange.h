/* base/lagrange.h - values between even samples, by polynomials through those nearest. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_LAGRANGE_H
#define LENSCALC_BASE_LAGRANGE_H

#include <stddef.h>

enum { LAGRANGE_FEW = 4, LAGRANGE_MOST = 8 };

/*
 * What each of the samples about a place counts there.
 *
 * Given     at       place, samples from the first
 *           count    of samples, >= taps
 *           taps     LAGRANGE_FEW or LAGRANGE_MOST: half of them on either side, but at the ends
 *           factors  receives `taps`, which add up to 1
 * Result    the first sample that counts
 * Source    [Abramowitz64] 25.2.1
 */
size_t lagrange_factors(double at, size_t count, size_t taps, double factors[LAGRANGE_MOST]);

/* The value at a place. */
double lagrange_value(const double *samples, size_t count, double at, size_t taps);

/* The integral between two places at most a sample apart, by Gauss's four points: exact. */
double lagrange_integral(const double *samples, size_t count, double low, double high, size_t taps);

/* Gauss's points and weights of 0..1, which integrate these polynomials exactly. */
enum { LAGRANGE_NODES = 4 };
extern const double lagrange_nodes[LAGRANGE_NODES], lagrange_weights[LAGRANGE_NODES];

#endif
