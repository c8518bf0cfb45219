/* scene/discrete.h - discrete distribution: one of many, each as often as its weight has it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_DISCRETE_H
#define LENSCALC_SCENE_DISCRETE_H

#include <stddef.h>

struct discrete_sample {
    size_t index;
    double remainder; /* in 0..1, below 1: what the number that picked it says beyond that */
};

/* The rest of a number that lies between two others. */
static inline double discrete_remainder(double at, double low, double high)
{
    const double most = 1 - 0x1p-53, rest = (at - low) / (high - low);
    if (!(rest < most)) {
        return most;
    }
    return rest > 0 ? rest : 0;
}

/* Which of so many equal steps a share lies in; one below 0 or above 1 in the first or the last. */
static inline size_t discrete_step(double share, size_t steps)
{
    const size_t step = share > 0 ? (size_t)(share * (double)steps) : 0;
    return step < steps ? step : steps - 1;
}

/*
 * Given     below  `count` + 1 sums: of the weights before each, from 0, and of all, above 0
 *           u      in 0..1, below 1
 * Result    never one without weight
 */
static inline struct discrete_sample discrete_sample_of(const double *below, size_t count, double u)
{
    const double at = u * below[count];
    size_t low = 0, high = count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (below[middle] <= at) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return (struct discrete_sample){low, discrete_remainder(at, below[low], below[low + 1])};
}

#endif
