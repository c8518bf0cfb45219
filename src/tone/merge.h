/* tone/merge.h - the exposures of a bracket as one picture of light. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_MERGE_H
#define LENSCALC_TONE_MERGE_H

#include "tone/frame.h"

/* Noise of a pixel's channel, as the sensor has it; of floats that of photons alone. */
struct merge_noise {
    double full_well;  /* electrons that light of 1 makes, > 0 */
    double read_noise; /* electrons, >= 0 */
};

struct merged {
    struct image image; /* linear sRGB: light over time */
    size_t saturated;   /* pixels of which a channel is full in every frame that has it: it is that
                           of the shortest of these */
    size_t full;        /* such channels */
    size_t looked,
        apart; /* pixels that were looked at; in which frames differ by more than noise */
};

/*
 * Merge.
 *
 * Given     frames  of the same size, with times and levels; `right` and `down` say which of their
 *                   pixels belong together: pixels that a frame does not have it leaves to others
 *           count   1 to FRAMES_MOST, the first frame not shifted
 * Formula   x = sum w v/t / sum w, w = keep t^2/var, var = spread + sigma^2/n^2 + x0 t/n with n
 *           electrons of light 1 and read noise sigma; x0 = sum keep v / sum keep t, since the
 *           weights must not follow the noise of the value they weigh. Apart: by more than 6
 *           standard deviations and 2 % in green, where it is looked
 * Source    least squares; [EMVA16] 2.1 for the variance
 * Errors    ERROR_DOMAIN: all channels of all pixels are full in all frames
 */
bool merge_frames(const struct tone_frame *frames, size_t count, const struct merge_noise *noise,
                  struct arena *arena, struct merged *merged, struct error *error);

#endif
