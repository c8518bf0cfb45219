/* base/poisson.h - counts of what arrives by chance, from evenly spread numbers. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_POISSON_H
#define LENSCALC_BASE_POISSON_H

/* Up to this mean terms are summed, above it they are expanded. */
#define POISSON_SUMMED 50.0
/* Above this mean neighbouring counts are no longer numbers of their own. */
#define POISSON_MOST 1e15

/*
 * Quantiles of the Poisson distribution.
 *
 * Given     mean  0 up to POISSON_MOST
 *           p     between 0 and 1, neither of them
 * Result    the least count k for which at most k arrive with a probability of at least p: an
 *           evenly spread p makes a count. It grows with the mean and with p. The same bits on
 *           every processor
 * Formula   up to POISSON_SUMMED the sum of e^-mean mean^j/j!; above, with w the normal quantile of
 *           p, the whole part of mean + sqrt(mean) w + (2 + w^2)/6 - (2 w + w^3)/(72 sqrt(mean))
 *           + (-16 + 7 w^2 + 3 w^4)/(810 mean), and not less than 0
 * Source    [Giles16] section 2.2
 * Errors    none: the range is the caller's promise
 * Limits    above POISSON_SUMMED the probability of at most k is wrong by up to 2e-6; that of what
 *           lies in the tails beyond 2, 3, 4, 5 standard deviations by 2e-4, 1.5e-3, 1e-2, 6e-2 of
 *           itself, by less with a larger mean: at 1000 by 1e-7, 2e-6, 1e-5, 4e-5 (unit test)
 */
double poisson_quantile(double mean, double p);

#endif
