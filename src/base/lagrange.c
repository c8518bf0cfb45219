/* base/lagrange.c - values between even samples, by polynomials through those nearest. */
/* SPDX-License-Identifier: MIT */
#include "base/lagrange.h"

#include <math.h>

const double lagrange_nodes[LAGRANGE_NODES] = {0.06943184420297371, 0.33000947820757187,
                                               0.66999052179242813, 0.93056815579702629};
const double lagrange_weights[LAGRANGE_NODES] = {0.17392742256872693, 0.32607257743127307,
                                                 0.32607257743127307, 0.17392742256872693};

size_t lagrange_factors(double at, size_t count, size_t taps, double factors[LAGRANGE_MOST])
{
    /* products of the steps between one tap and all others: (-1)^(n-1-j) j! (n-1-j)! */
    static const double over_few[] = {-1 / 6., 1 / 2., -1 / 2., 1 / 6.};
    static const double over_most[] = {-1 / 5040., 1 / 720., -1 / 240., 1 / 144.,
                                       -1 / 144.,  1 / 240., -1 / 720., 1 / 5040.};
    const double *over = taps == LAGRANGE_MOST ? over_most : over_few;
    const double from = floor(at) - (double)(taps / 2 - 1);
    const size_t first = (size_t)fmax(fmin(from, (double)(count - taps)), 0);
    double before = 1, behind = 1;
    for (size_t j = 0; j < taps; j++) {
        factors[j] = over[j] * before;
        before *= at - (double)(first + j);
    }
    for (size_t j = taps; j-- > 0;) {
        factors[j] *= behind;
        behind *= at - (double)(first + j);
    }
    return first;
}

double lagrange_value(const double *samples, size_t count, double at, size_t taps)
{
    double factors[LAGRANGE_MOST], sum = 0;
    const size_t first = lagrange_factors(at, count, taps, factors);
    for (size_t j = 0; j < taps; j++) {
        sum += factors[j] * samples[first + j];
    }
    return sum;
}

double lagrange_integral(const double *samples, size_t count, double low, double high, size_t taps)
{
    double sum = 0;
    for (int i = 0; i < LAGRANGE_NODES; i++) {
        const double at = low + lagrange_nodes[i] * (high - low);
        sum += lagrange_weights[i] * (high - low) * lagrange_value(samples, count, at, taps);
    }
    return sum;
}
