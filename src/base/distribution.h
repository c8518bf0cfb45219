/* base/distribution.h - how numbers of makers are spread, from evenly spread ones. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_DISTRIBUTION_H
#define LENSCALC_BASE_DISTRIBUTION_H

#include "base/text.h"

/* All are symmetric about 0; their range is -1..1, which only the normal one leaves. */
enum distribution {
    DISTRIBUTION_UNIFORM,   /* evenly over the range */
    DISTRIBUTION_NORMAL,    /* the range is this many standard deviations to either side */
    DISTRIBUTION_TRUNCATED, /* the same, of those within the range */
    DISTRIBUTION_TWO_POINT, /* at either end, half of them each */
    DISTRIBUTION_PARABOLIC, /* of the density 3/2 x^2: more towards the ends, none in the middle */
    DISTRIBUTIONS
};

/* Names and what they mean, in the order of the enumeration; a null word ends them. */
extern const struct word distribution_words[];

/* Standard deviations from the middle to the end of the range, where none are said. */
#define DISTRIBUTION_SIGMAS 2.0

/* A distribution made ready for many numbers. */
struct spread {
    enum distribution distribution;
    double sigmas; /* of normal and truncated ones: the end of the range in standard deviations */
    double within; /* internal: the share of the normal distribution within the range */
};

/*
 * Given     sigmas  DISTRIBUTION_SIGMAS_LEAST .. DISTRIBUTION_SIGMAS_MOST; of others not looked at
 * Formula   within: 2 phi(s) (s + s^3/3 + s^5/15 + ...), with phi the normal density
 * Source    [Abramowitz64] 26.2.11
 */
struct spread spread_of(enum distribution distribution, double sigmas);
#define DISTRIBUTION_SIGMAS_LEAST 0.1
#define DISTRIBUTION_SIGMAS_MOST  6.0

/*
 * Quantiles: an evenly spread p makes numbers that are spread like this.
 *
 * Given     p  between 0 and 1, neither of them (base/random.h)
 * Result    in units of the half range, odd about p = 1/2. The same bits on every processor
 * Formula   2p - 1; z(p)/s with the normal quantile z; z(1/2 + (p - 1/2) within)/s; the sign of
 *           p - 1/2, + in the middle; (2p - 1)^(1/3)
 * Source    the inverses of their distribution functions; [Wichura88] for z
 * Limits    within 1e-14 up to 3 sigmas (unit test, against 40 digits); truncated at 6 within 1e-8
 *           at the very ends, where p itself has no more digits
 */
double spread_quantile(const struct spread *spread, double p);

/*
 * The variance, in units of the half range squared: of a standard deviation of 1/s that is 1/s^2.
 *
 * Formula   1/3; 1/s^2; (1 - 2 s phi(s)/within)/s^2; 1; 3/5
 */
double spread_variance(const struct spread *spread);

/*
 * The mean of the fourth power, in units of the half range.
 *
 * Formula   1/5; 3/s^4; (3 - 2 (s^3 + 3s) phi(s)/within)/s^4; 1; 3/7
 */
double spread_fourth(const struct spread *spread);

#endif
