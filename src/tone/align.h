/* tone/align.h - how far a camera has moved between two exposures. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_ALIGN_H
#define LENSCALC_TONE_ALIGN_H

#include "tone/frame.h"

#include <stdbool.h>

enum { ALIGN_LEVELS = 7 };

/* What became of a frame beside the one before it, by exposure time. */
struct align_step {
    bool
        is_beyond; /* the camera has moved by `limit` pixels or more: there is no telling how far */
    long limit;
    bool is_told; /* no: they have too little in common that is exposed in both */
    double before,
        now; /* pixels that differ, a share of those compared: without and with the shift */
};

/*
 * Find each frame's `right` and `down`, those of the first being 0.
 *
 * Given     frames  of the same size
 *           steps   receives one a frame; that of the longest exposure is told, of no shift
 * Formula   frames as bits, brighter than their median or not, are shifted against each other until
 *           fewest differ, those within 4 of the median left out; first a 64th as large, then
 *           twice and twice again, one pixel each way at each size. Where the median of one is
 *           black or white, another quantile, the same in both. Each goes with the one that is next
 *           longer
 * Result    a shift is taken if by it a fifth fewer differ than without
 * Source    [Ward03]
 * Limits    shifts of whole pixels, less than 2^ALIGN_LEVELS - 1 each way, and than a ninth to a
 *           twentieth of the shorter side of small pictures; nothing turns
 */
void align_frames(struct tone_frame *frames, size_t count, struct align_step *steps);

#endif
