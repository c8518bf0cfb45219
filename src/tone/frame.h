/* tone/frame.h - one exposure of a bracket: pixels as its file has them, and the light of each. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TONE_FRAME_H
#define LENSCALC_TONE_FRAME_H

#include "base/image/image.h"

#include <stdint.h>

enum { FRAME_CHANNELS = 3, FRAME_LEVELS = 256, FRAMES_MOST = 64, TRUST_MOST = 255 };

/* What one whole number stands for. */
struct frame_level {
    float light;  /* in the merged picture's unit, times s */
    float keep;   /* how far it is trusted: 1; 0 where the channel is full, less just below */
    float spread; /* variance of the light that all becomes this number */
};

struct tone_frame {
    const char *name;   /* of its file */
    const char *remark; /* of that, as image_file_remark has it; null: none */
    size_t width, height;
    double aspect;         /* of its pixels, as struct image has it */
    int bits;              /* of its whole numbers, 8 or 16; 0: floats */
    const uint8_t *bytes;  /* three a pixel, of 8 bits; */
    const uint16_t *codes; /* of 16 bits; */
    const float *values;   /* or floats, proportional to light: one of these is not null */
    double time;           /* of the exposure, s, */
    bool is_by_white;      /* as its white has it, and not as is noted */
    long right, down;      /* how far its picture lies beside that of the others, pixels */
    size_t full;           /* values that are the highest number, or of a full pixel */
    /* three a pixel: how far each is from where the sensor is full, 0 to TRUST_MOST, beside what
       `levels` say; null: the file's highest number alone is where */
    const uint8_t *trust;
    /* of its whole numbers, at first as the file encodes light; floats have none */
    const struct frame_level *levels[FRAME_CHANNELS];
};

/* How many whole numbers there are, of 8 or 16 bits. */
static inline size_t frame_levels(int bits)
{
    return bits == 16 ? 65536 : FRAME_LEVELS;
}

/*
 * Take a frame from a picture: three channels, grey repeated, transparency left out, XYZ as linear
 * sRGB.
 *
 * Given     image  as image_file_read with IMAGE_CODES makes it
 *           frame  receives all but its name, remark and time; in the arena
 * Errors    ERROR_DATA: neither grey, RGB nor XYZ; a value that is not finite
 */
bool frame_take(const struct image *image, struct arena *arena, struct tone_frame *frame,
                struct error *error);

/*
 * The levels of whole numbers whose light is known.
 *
 * Given     light  of each of `count` numbers, growing
 * Result    keep   1 up to nine tenths of the highest, from there in a straight line to 0: what
 *                  noise carries across an abrupt end would be missing in the mean
 *           spread  ((next - last)/2)^2/12, at least 1e-18
 */
const struct frame_level *frame_levels_of(const double *light, size_t count, struct arena *arena);

/* What a value stands for by its levels; of floats itself. i counts three a pixel. */
struct frame_level frame_level_at(const struct tone_frame *frame, size_t i);

/* Is a value the highest number, or of a full pixel? */
bool frame_is_full(const struct tone_frame *frame, size_t i);

/* The number of a pixel's channel, as of 8 bits. */
unsigned frame_byte(const struct tone_frame *frame, size_t pixel, size_t channel);

/* Which frames are the longest, by time: their numbers, the longest first. */
void frames_order(const struct tone_frame *frames, size_t count, size_t *order);

#endif
