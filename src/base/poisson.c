/* base/poisson.c - quantiles of the Poisson distribution. */
/* SPDX-License-Identifier: MIT */
#include "base/poisson.h"

#include "base/exponential.h"
#include "base/normal.h"

#include <assert.h>
#include <math.h>

double poisson_quantile(double mean, double p)
{
    assert(mean >= 0 && mean <= POISSON_MOST && p > 0 && p < 1);
    if (mean > POISSON_SUMMED) {
        const double w = normal_quantile(p), w2 = w * w, root = sqrt(mean);
        const double k = mean + root * w + (2 + w2) / 6 - w * (2 + w2) / (72 * root) +
                         (-16 + w2 * (7 + 3 * w2)) / (810 * mean);
        return k > 0 ? floor(k) : 0;
    }
    double term = exponential(-mean), sum = term;
    int k = 0;
    /* terms that no longer change the sum: by rounding it may end below the largest p */
    while (sum < p && (k < mean || term > 0x1p-60)) {
        k++;
        term *= mean / k;
        sum += term;
    }
    return k;
}
