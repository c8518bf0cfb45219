/* base/exponential.c - logarithm and exponential by their series. */
/* SPDX-License-Identifier: MIT */
#include "base/exponential.h"

#include <assert.h>
#include <math.h>
#include <stddef.h>

/* ln 2 in two parts: a multiple of the first by an exponent is exact. */
#define LN2_HIGH 0x1.62e42fee00000p-1
#define LN2_LOW  0x1.a39ef35793c76p-33

static double horner(const double *coefficients, size_t count, double x)
{
    double sum = 0;
    while (count-- > 0) {
        sum = sum * x + coefficients[count];
    }
    return sum;
}

double natural_logarithm(double x)
{
    /* (atanh(s)/s - 1)/s^2: s^2 is at most 0.0295, and what is left out 1e-18 of 1 */
    static const double series[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                                    1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
    assert(x > 0);
    int k;
    double m = frexp(x, &k);
    if (m < 0.70710678118654752440) {
        m *= 2;
        k--;
    }
    const double f = m - 1, s = f / (m + 1), s2 = s * s;
    const double rest = s2 * horner(series, sizeof series / sizeof *series, s2);
    /* 2 s = f - s f exactly, so that f comes without rounding: ln m = f - s (f - 2 rest) */
    return k * LN2_HIGH + (f - (s * (f - 2 * rest) - k * LN2_LOW));
}

double exponential(double x)
{
    static const double series[] = {1.0,
                                    1.0 / 2,
                                    1.0 / 6,
                                    1.0 / 24,
                                    1.0 / 120,
                                    1.0 / 720,
                                    1.0 / 5040,
                                    1.0 / 40320,
                                    1.0 / 362880,
                                    1.0 / 3628800,
                                    1.0 / 39916800,
                                    1.0 / 479001600,
                                    1.0 / 6227020800.0};
    assert(x >= -708 && x <= 709);
    const double k = floor(x * 1.44269504088896340736 + 0.5);
    const double r = (x - k * LN2_HIGH) - k * LN2_LOW;
    return ldexp(1 + r * horner(series, sizeof series / sizeof *series, r), (int)k);
}
