/* tone/saturation.h - where a frame's sensor was full, below the highest number of its file. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_SATURATION_H
#define LENSCALC_TONE_SATURATION_H

#include "light/colour.h"
#include "tone/frame.h"

/* What a file says of its sensor. */
struct saturation {
    /* row j times (R, G, B), linear, 1 the file's white: what channel j of the sensor has of a full
       pixel's light; full is 1 and more */
    struct colour_matrix fill;
};

/*
 * Read it from nine numbers, row by row.
 *
 * Errors    ERROR_DATA: other than nine finite numbers, or rows that tell no channels apart
 */
bool saturation_read(const char *text, struct saturation *saturation, struct error *error);

/*
 * Trust no value of a frame that a full channel has a part in: of a plain sensor each channel has
 * its own, of one whose colours are mixed from all channels one that is full spoils all three.
 *
 * Given     frame  of frame_take
 * Result    frame  with trust: TRUST_MOST up to nine tenths of full, from there in a straight line
 *                  to 0, as frame_levels_of has it; half a step of the file's numbers counts as
 *                  more. A channel at the highest number may be anything above
 */
void saturation_apply(struct tone_frame *frame, const struct saturation *saturation,
                      struct arena *arena);

/* What saturation_find has found. */
struct saturation_found {
    bool is_found[FRAME_CHANNELS];
    float light[FRAME_CHANNELS]; /* of the highest value, that all frames share; */
    double share;                /* of the pixels that have it in a frame, the largest */
    const char *name;            /* of that frame; null: none is found */
};

/*
 * Find where frames are full that do not say so: at the highest value of a frame, if that is
 * shared by many pixels, hardly any lie just below it, and the next shorter frame shows more light
 * there than elsewhere.
 *
 * Given     frames  with times, levels and shifts, of which those with trust are left alone
 * Result    found   and the frames get trust, in the arena: not from 99 % of that value on
 * Limits    a bracket of which no frame but the shortest is full tells nothing
 */
void saturation_find(struct tone_frame *frames, size_t count, struct arena *arena,
                     struct saturation_found *found);

#endif
