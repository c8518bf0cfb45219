/* base/distribution.c - how numbers of makers are spread, from evenly spread ones. */
/* SPDX-License-Identifier: MIT */
#include "base/distribution.h"

#include "base/exponential.h"
#include "base/normal.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>

const struct word distribution_words[] = {
    [DISTRIBUTION_UNIFORM] = {"uniform", "evenly between the limits"},
    [DISTRIBUTION_NORMAL] = {"normal", "the limits are 2 standard deviations, unless said"},
    [DISTRIBUTION_TRUNCATED] = {"truncated", "normal, with none beyond the limits"},
    [DISTRIBUTION_TWO_POINT] = {"two-point", "at either limit"},
    [DISTRIBUTION_PARABOLIC] = {"parabolic", "more towards the limits: as the square"},
    [DISTRIBUTIONS] = {NULL, NULL}};

#define ROOT_OF_2_PI 2.50662827463100050242

/* The normal density. */
static double distribution_density(double z)
{
    return exponential(-z * z / 2) / ROOT_OF_2_PI;
}

struct spread spread_of(enum distribution distribution, double sigmas)
{
    struct spread spread = {distribution, sigmas, 1};
    if (distribution == DISTRIBUTION_TRUNCATED) {
        assert(sigmas >= DISTRIBUTION_SIGMAS_LEAST && sigmas <= DISTRIBUTION_SIGMAS_MOST);
        /* the share of the normal distribution within: terms of one sign, so nothing cancels */
        double term = sigmas, sum = sigmas;
        for (int n = 3; term > sum * 1e-18; n += 2) {
            term *= sigmas * sigmas / n;
            sum += term;
        }
        spread.within = 2 * distribution_density(sigmas) * sum;
    }
    return spread;
}

/* The cube root of 0 <= x <= 1; libm's differs between processors. */
static double cube_root(double x)
{
    int power;
    if (!(x > 0)) {
        return 0;
    }
    double m = frexp(x, &power);
    for (; power % 3 != 0; power++) {
        m /= 2;
    }
    /* m is 1/8 .. 1: a parabola through both ends and the middle, then Newton doubles its digits */
    double root = 0.37 + m * (1.1 - 0.47 * m);
    for (int i = 0; i < 5; i++) {
        root -= (root - m / (root * root)) / 3;
    }
    return ldexp(root, power / 3);
}

double spread_quantile(const struct spread *spread, double p)
{
    const double q = p - 0.5; /* exact for multiples of 2^-53 */
    double size = 1;
    assert(p > 0 && p < 1);
    switch (spread->distribution) {
    case DISTRIBUTION_UNIFORM:
        return 2 * q;
    case DISTRIBUTION_NORMAL:
        return normal_quantile(p) / spread->sigmas;
    case DISTRIBUTION_TRUNCATED:
        /* from the lower tail, which has more digits than the upper one */
        size = -normal_quantile((1 - spread->within) / 2 + (0.5 - fabs(q)) * spread->within);
        size = fmin(size / spread->sigmas, 1);
        break;
    case DISTRIBUTION_PARABOLIC:
        size = cube_root(2 * fabs(q));
        break;
    case DISTRIBUTION_TWO_POINT:
    case DISTRIBUTIONS:
        break;
    }
    return copysign(size, q); /* a branch by chance costs more than all else */
}

double spread_variance(const struct spread *spread)
{
    const double s = spread->sigmas;
    switch (spread->distribution) {
    case DISTRIBUTION_NORMAL:
        return 1 / (s * s);
    case DISTRIBUTION_TRUNCATED:
        return (1 - 2 * s * distribution_density(s) / spread->within) / (s * s);
    case DISTRIBUTION_PARABOLIC:
        return 0.6;
    case DISTRIBUTION_TWO_POINT:
        return 1;
    case DISTRIBUTION_UNIFORM:
    case DISTRIBUTIONS:
        break;
    }
    return 1.0 / 3;
}

double spread_fourth(const struct spread *spread)
{
    const double s = spread->sigmas, square = s * s;
    switch (spread->distribution) {
    case DISTRIBUTION_NORMAL:
        return 3 / (square * square);
    case DISTRIBUTION_TRUNCATED:
        return (3 - 2 * s * (square + 3) * distribution_density(s) / spread->within) /
               (square * square);
    case DISTRIBUTION_PARABOLIC:
        return 3.0 / 7;
    case DISTRIBUTION_TWO_POINT:
        return 1;
    case DISTRIBUTION_UNIFORM:
    case DISTRIBUTIONS:
        break;
    }
    return 0.2;
}
