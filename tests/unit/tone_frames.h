/* tests/unit/tone_frames.h - frames by hand. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_TONE_FRAMES_H
#define LENSCALC_TESTS_UNIT_TONE_FRAMES_H

#include "check.h"
#include "tone/frame.h"

static struct arena memory;
static struct arena *const arena = &memory;

/* A frame of 8 bits, grey, whose light is the square of its number's share. */
static struct tone_frame frame_of(const uint8_t *greys, size_t width, size_t height, double time)
{
    double light[FRAME_LEVELS];
    uint8_t *bytes = ARENA_ARRAY(arena, width * height * FRAME_CHANNELS, uint8_t);
    struct tone_frame frame = {
        .name = "x", .width = width, .height = height, .bits = 8, .bytes = bytes, .time = time};
    for (int i = 0; i < FRAME_LEVELS; i++) {
        light[i] = i / 255.0 * (i / 255.0);
    }
    for (size_t i = 0; i < width * height * FRAME_CHANNELS; i++) {
        bytes[i] = greys[i / FRAME_CHANNELS];
    }
    for (size_t k = 0; k < FRAME_CHANNELS; k++) {
        frame.levels[k] = frame_levels_of(light, FRAME_LEVELS, arena);
    }
    return frame;
}

#endif
