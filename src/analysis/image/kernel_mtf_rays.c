/* analysis/image/kernel_mtf_rays.c - waves of one frequency at the places of rays. */
/* SPDX-License-Identifier: MIT */
#include "analysis/image/mtf.h"
#include "base/turns.h"

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

enum { LANES = MTF_RAYS_LANES };

void NAMED(kernel_mtf_rays, KERNEL)(const double *places, const double *weights, size_t count,
                                    double frequency, double sums[2])
{
    double re[LANES] = {0}, im[LANES] = {0};
    for (size_t i = 0; i < count; i += LANES) {
        for (size_t l = 0; l < LANES; l++) {
            double c, s;
            turns_of(frequency * places[i + l], &c, &s);
            re[l] += weights[i + l] * c;
            im[l] += weights[i + l] * s;
        }
    }
    for (size_t l = 0; l < LANES; l++) {
        sums[0] += re[l];
        sums[1] += im[l];
    }
}
