/* camera/photograph/convergence.c - errors from halves, and sums of them. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/convergence.h"

#include <math.h>

/* Of squares up to 1, and of larger ones up to 10^10: sums of a million tiles do not overflow. */
static const double unit = 1.0 / 1099511627776, missed_unit = 1.0 / 1024, most = 1e10;

double convergence_halves(const double *first, const double *both, size_t count, double n)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double off = (2 * first[i] - both[i]) / (2 * n);
        sum += off * off;
    }
    return sqrt(sum / (double)count);
}

/* Of one grey, as a share of white. */
static double grey_level(double y)
{
    static const double levels = 255, steepest = 12.92, slope = 1.055 / 2.4;
    const double root = sqrt(y);
    return fmax(root * sqrt(sqrt(sqrt(root))) / slope, 1 / steepest) / levels;
}

double convergence_relative(const struct convergence_goal *goal, const double *first,
                            const double *both, size_t count, double n)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double off = (2 * first[i] - both[i]) / (2 * n);
        /* a rare bright ray makes its own half too bright, and must not excuse itself by that */
        const double darker = fmin(fabs(first[i]), fabs(both[i] - first[i])) / n;
        const double level = goal->white * grey_level(darker / goal->white);
        const double share = off / fmax(goal->error * darker, level);
        sum += share * share;
    }
    return sqrt(sum / (double)count);
}

void convergence_add(uint64_t counts[CONVERGENCE_COUNTS], double error, size_t rays)
{
    const double square = fmin(error * error, most);
    counts[CONVERGENCE_TILES]++;
    counts[CONVERGENCE_RAYS] += rays;
    if (error <= 1) {
        counts[CONVERGENCE_SQUARES] += (uint64_t)(square / unit);
    } else {
        counts[CONVERGENCE_MISSED]++;
        counts[CONVERGENCE_MISSED_SQUARES] += (uint64_t)(square / missed_unit);
    }
}

double convergence_error(const uint64_t counts[CONVERGENCE_COUNTS], bool missed)
{
    const uint64_t tiles = counts[missed ? CONVERGENCE_MISSED : CONVERGENCE_TILES];
    const double reached = missed ? 0 : unit * (double)counts[CONVERGENCE_SQUARES];
    const double others = missed_unit * (double)counts[CONVERGENCE_MISSED_SQUARES];
    return tiles == 0 ? 0 : sqrt((reached + others) / (double)tiles);
}
