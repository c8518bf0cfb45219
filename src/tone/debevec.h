/* tone/debevec.h - the response of a camera from a bracket. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_DEBEVEC_H
#define LENSCALC_TONE_DEBEVEC_H

#include "tone/frame.h"

/* What codes of one channel stand for. */
struct response_curve {
    double light[FRAME_LEVELS]; /* growing; that of DEBEVEC_MIDDLE is what sRGB says */
    double rms;                 /* of ln light, weighted: what the frames disagree by */
    size_t held; /* codes whose light fell below that of the code before, and became it */
};

enum { DEBEVEC_MIDDLE = 128 };

/*
 * Recover the curves.
 *
 * Given     frames  of 8 bits, at least two, with times and shifts
 *           curves  receives one a channel
 * Formula   g(Z) = ln light and ln E of each of 2^17 pixels, or all, that make
 *           sum {w(Z) (g(Z) - ln E - ln t)}^2 + a sum {w(z) (g'' + g'/z)}^2 least, w(z) = z up to
 *           127, 255 - z above; each ln E follows from g, so that 256 unknowns are left. `a` grows
 *           with the number of values, so that smoothness weighs the same for any. Z is the mean of
 *           a pixel and its 8 neighbours where these are alike in all frames, between codes in
 *           straight lines
 * Source    [DebevecMalik97] eq 3, 4 and 7. There it is g'' alone, and Z of the pixel; but frames
 *           a stop apart say nothing of what repeats with each stop, which smoothness then decides:
 *           g'' + g'/z is 0 for powers, which responses nearly are; and the noise of Z makes g
 *           flatter than it is
 * Errors    ERROR_DOMAIN: frames of other than 8 bits, or all of one time; no pixel is exposed in
 *           two frames
 * Limits    light of a code is told up to a factor; here that of the middle is what sRGB says in
 *           all channels, so that a middle grey stays grey
 */
bool debevec_recover(const struct tone_frame *frames, size_t count, struct arena *arena,
                     struct response_curve curves[FRAME_CHANNELS], struct error *error);

#endif
