/* analysis/image/mtf_curve.h - contrast at many even frequencies at once, for drawings. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_MTF_CURVE_H
#define LENSCALC_ANALYSIS_IMAGE_MTF_CURVE_H

#include "analysis/image/mtf.h"

#include <stdbool.h>
#include <stddef.h>

/* Contrasts at 0, step, 2 step ... */
struct mtf_curve {
    double *contrast[MTF_DIRECTIONS], *limit[MTF_DIRECTIONS]; /* owned by the arena */
};

/*
 * By waves, all frequencies from one sampling of the pupil.
 *
 * Given     step   1/mm, > 0
 *           count  of frequencies, the first is 0
 * Result    false: a grid of 4096 cells across the pupil and 1024 lines does not do, as the wave
 *           front is too steep for so many frequencies, or too rough; mtf_find says what there is
 * Formula   lines across the pupil at Gauss's places, as many as the phase of an overlap wants,
 *           each sampled evenly, with the share of its last cell that is clear; the overlap of a
 *           line with itself moved is the Fourier transform of its transform's square, so that
 *           these are added over all lines
 * Source    [Goodman05] 6.3; tested against mtf_find in its drawings
 * Limits    off by less than 1e-3, and by source->off, which overlaps one by one are as well
 */
bool mtf_curve_find(const struct mtf_source *source, double step, size_t count, struct arena *arena,
                    struct mtf_curve *curve);

#endif
