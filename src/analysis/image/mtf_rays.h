/* analysis/image/mtf_rays.h - contrast by rays, as if light had no wavelength. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_MTF_RAYS_H
#define LENSCALC_ANALYSIS_IMAGE_MTF_RAYS_H

#include "analysis/waves/wave_reference.h"

#include <stdbool.h>
#include <stddef.h>

enum { MTF_RAYS_LEVELS = 10, MTF_RAYS_LANES = 16 };

/* Rays of all wavelengths, and where they arrive from the reference in two directions, mm. */
struct mtf_rays_level {
    size_t count; /* a multiple of the lanes; those at the end weigh 0 */
    double *places[2], *weights, light;
};

/* Traced when a frequency first wants them, for all frequencies: each has twice those before. */
struct mtf_rays {
    struct wave_lights lights;
    double centre[2];   /* the reference in the image plane */
    double along[2][2]; /* two directions */
    struct mtf_rays_level levels[MTF_RAYS_LEVELS];
    size_t count;
};

/* Of both directions. */
struct mtf_rays_sums {
    double re[2], im[2]; /* in shares of the light */
    double error;
    bool has_converged;
};

/*
 * The mean of exp(-2 pi i frequency x), by energy.
 *
 * Formula   rays doubled from 200 to 102400 until twice the last change is below `error`
 * Errors    as bundle_trace
 */
bool mtf_rays_find(struct mtf_rays *rays, double frequency, double wanted, struct arena *arena,
                   struct mtf_rays_sums *sums, struct error *error);

/* Compiled once for each instruction set: sums[0] += weight cos(2 pi frequency x), [1] the sine. */
typedef void kernel_mtf_rays(const double *places, const double *weights, size_t count,
                             double frequency, double sums[2]);
kernel_mtf_rays kernel_mtf_rays_sse2, kernel_mtf_rays_avx2, kernel_mtf_rays_avx512;

#endif
