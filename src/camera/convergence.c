/* camera/convergence.c - errors from halves, and sums of them. */
/* SPDX-License-Identifier: MIT */
#include "camera/convergence.h"

#include <math.h>

/* So much at most counts, that no sum of a million tiles overflows: errors of 1e5 times what is
   asked for. */
static const double most = 1e10;

double convergence_halves(const double *first, const double *both, size_t count, double n)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double off = (2 * first[i] - both[i]) / (2 * n);
        sum += off * off;
    }
    return sqrt(sum / (double)count);
}

void convergence_add(uint64_t counts[CONVERGENCE_COUNTS], double error, size_t rays)
{
    const uint64_t square = (uint64_t)(fmin(error * error, most) / CONVERGENCE_UNIT);
    const bool missed = !(error <= 1);
    counts[CONVERGENCE_TILES]++;
    counts[CONVERGENCE_RAYS] += rays;
    counts[CONVERGENCE_SQUARES] += square;
    counts[CONVERGENCE_MISSED] += missed;
    counts[CONVERGENCE_MISSED_SQUARES] += missed ? square : 0;
}

double convergence_error(const uint64_t counts[CONVERGENCE_COUNTS], bool missed)
{
    const uint64_t tiles = counts[missed ? CONVERGENCE_MISSED : CONVERGENCE_TILES];
    const uint64_t squares = counts[missed ? CONVERGENCE_MISSED_SQUARES : CONVERGENCE_SQUARES];
    return tiles == 0 ? 0 : sqrt(CONVERGENCE_UNIT * (double)squares / (double)tiles);
}
