/* tone/histogram.h - luminance to a display by the histogram of what the eye adapts to. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_HISTOGRAM_H
#define LENSCALC_TONE_HISTOGRAM_H

#include "base/error.h"
#include "tone/foveal.h"

#include <stdbool.h>

enum { HISTOGRAM_BINS = 100 };

/* Share of all samples that may stand above the ceiling. */
#define HISTOGRAM_TOLERANCE 0.025

/* What a display can show, cd/m^2. */
struct display {
    double least, most; /* 0 < least < most */
};

/* Which contrast is not to be exceeded. */
enum histogram_ceiling {
    CEILING_LINEAR, /* that of the scene */
    CEILING_HUMAN   /* what is just visible in the scene is at most just visible on the display */
};

struct histogram {
    struct display display;
    double low, high;                 /* ln of luminance: the bins' ends */
    double total;                     /* samples before anything was cut */
    double bins[HISTOGRAM_BINS];      /* as adjusted */
    double share[HISTOGRAM_BINS + 1]; /* P: of all below each bin's lower end */
    double trimmed;                   /* in the last pass, a share of the total */
    size_t passes;
    bool is_linear; /* the display shows more contrast than the scene has: */
    double factor;  /* L_d = factor L_w */
};

/*
 * Adjust.
 *
 * Given     foveal   samples; those under SIGHT_LEAST count as that
 * Result    is_linear where less than the tolerance is left of the histogram: then the factor puts
 *           the mean of ln L at the middle of the display's, with CEILING_HUMAN by the ratio of
 *           their thresholds, and as far down as the brightest sample needs
 * Formula   B = ln L; B_d = ln Ldmin + (ln Ldmax - ln Ldmin) P(B); the bins f(b), db wide, T in
 *           all, are cut to T db/(ln Ldmax - ln Ldmin), with CEILING_HUMAN times
 *           dL(L_d) L_w/(dL(L_w) L_d), again and again until less than the tolerance is cut
 * Source    [WardLarson97]: the histogram adjustment, its linear and its contrast ceiling;
 *           checked against Ward's own pcond of Radiance
 * Errors    ERROR_DOMAIN: no sample has light
 * Limits    the slope d ln L_d/d ln L_w may exceed its ceiling by what the last pass cut: by 3 % if
 *           most of the histogram is left, by more where few bins hold nearly all samples
 */
bool histogram_adjust(const struct foveal *foveal, const struct display *display,
                      enum histogram_ceiling ceiling, struct histogram *histogram,
                      struct error *error);

/* Luminance on the display, in its range, of one of the scene, cd/m^2. */
double histogram_shown(const struct histogram *histogram, double luminance);

/* The mean of ln L over the samples, of those that are above SIGHT_LEAST; NaN: none is. */
double foveal_log_mean(const struct foveal *foveal);

#endif
