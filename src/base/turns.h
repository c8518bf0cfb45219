/* base/turns.h - sine and cosine of turns, in lane loops and with the same bits everywhere. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_TURNS_H
#define LENSCALC_BASE_TURNS_H

#include "base/constants.h"

#include <stdint.h>

/*
 * cos(2 pi t) and sin(2 pi t) of |t| <= 1/8.
 *
 * Formula   the series to the 16th and 15th power: off by 2e-18 and 6e-17 at the ends
 */
static inline void turns_near(double t, double *cosine, double *sine)
{
    const double x = 2 * PI * t, z = x * x;
    *cosine =
        1 -
        z * (1. / 2 -
             z * (1. / 24 - z * (1. / 720 -
                                 z * (1. / 40320 - z * (1. / 3628800 -
                                                        z * (1. / 479001600 -
                                                             z * (1. / 87178291200. -
                                                                  z * (1. / 20922789888000.))))))));
    *sine =
        x - x * z *
                (1. / 6 -
                 z * (1. / 120 -
                      z * (1. / 5040 - z * (1. / 362880 - z * (1. / 39916800 -
                                                               z * (1. / 6227020800. -
                                                                    z * (1. / 1307674368000.)))))));
}

/*
 * cos(2 pi t) and sin(2 pi t), without a branch or a call: glibc's differ between processors.
 *
 * Given     t  turns, |t| < 2^50; what its rounding says of the angle is all that is lost
 */
static inline void turns_of(double t, double *cosine, double *sine)
{
    /* adding 1.5 2^52 rounds to a whole number */
    const double whole = 6755399441055744.0;
    const double quarter = (4 * t + whole) - whole;
    const double even = (0.25 * quarter + whole) - whole;
    const double place = quarter - 4 * even; /* -2 .. 2 */
    double c, s;
    turns_near(t - 0.25 * quarter, &c, &s);
    const double across = place * place == 1 ? 1 : 0;  /* a quarter turn one way or the other */
    const double turned = place * place == 4 ? -1 : 1; /* half a turn */
    const double first = across == 1 ? -place * s : c; /* cos(a +- 90 deg) = -+ sin a */
    const double second = across == 1 ? place * c : s;
    *cosine = turned * first;
    *sine = turned * second;
}

/* The same of k/n of a turn, k < n < 2^60, to the last bits. */
static inline void turns_of_ratio(uint64_t k, uint64_t n, double *cosine, double *sine)
{
    const uint64_t quarter = (8 * k + n) / (2 * n);
    const int64_t rest = (int64_t)(4 * k) - (int64_t)(quarter * n);
    double c, s;
    turns_near((double)rest / (4 * (double)n), &c, &s);
    *cosine = quarter % 2 == 0 ? c : -s;
    *sine = quarter % 2 == 0 ? s : c;
    if (quarter % 4 >= 2) {
        *cosine = -*cosine;
        *sine = -*sine;
    }
}

#endif
