/* trace/aim/multisection.c - places about an estimate of a root. */
/* SPDX-License-Identifier: MIT */
#include "trace/aim/multisection.h"

#include <math.h>
#include <stdbool.h>

/* Lagrange's formula for the place where the value is 0, counted from `low`. */
static double multisection_interpolate(const struct multisection_point *points, size_t count,
                                       double low)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        double weight = 1;
        for (size_t k = 0; k < count; k++) {
            weight *= k == i ? 1 : points[k].value / (points[k].value - points[i].value);
        }
        sum += weight * (points[i].at - low);
    }
    return sum;
}

static double multisection_estimate(const struct multisection_point *points, size_t count,
                                    size_t between)
{
    const size_t first = between >= 2 ? between - 2 : 0;
    const size_t behind = between + 2 < count ? between + 2 : count;
    const struct multisection_point *low = &points[between - 1], *high = &points[between];
    double whole = high->at - low->at,
           part = multisection_interpolate(points + first, behind - first, low->at);
    if (!(part > 0 && part < whole)) {
        part = whole * (low->value / (low->value - high->value));
    }
    return low->at + part;
}

void multisection_places(const struct multisection_point *points, size_t count, size_t between,
                         size_t wanted, double *places)
{
    enum { FINEST = 40 }; /* powers of 2 */
    const struct multisection_point *low = &points[between - 1], *high = &points[between];
    const double width = high->at - low->at;
    const double rounding = 1e-14 * fmax(fabs(low->at), fabs(high->at));
    bool known = isfinite(low->value) && isfinite(high->value) && low->value * high->value <= 0;
    if (!(known && width > rounding)) {
        for (size_t i = 0; i < wanted; i++) {
            places[i] = low->at + width * ((double)(i + 1) / (double)(wanted + 1));
        }
        return;
    }
    const double root = multisection_estimate(points, count, between);
    const size_t half = wanted / 2, square = half * half;
    for (size_t i = 0; i < half; i++) {
        double part = ldexp(1, -(int)((FINEST * (i + 1) * (i + 1) + square - 1) / square));
        places[i] = root - part * (root - low->at);
        places[wanted - 1 - i] = root + part * (high->at - root);
    }
}
