/* tone/frame.c - one exposure of a bracket: pixels as its file has them, and the light of each. */
/* SPDX-License-Identifier: MIT */
#include "tone/frame.h"

#include "light/colour.h"

#include <math.h>
#include <string.h>

/* Where trust begins to end, as a share of the highest number's light. */
static const double TRUSTED = 0.9;

/* Variances that a weight of single precision stands: it is t^2 over them, t up to 1e9 s. */
static const double SPREAD_LEAST = 1e-18;

enum frame_kind { KIND_GREY, KIND_RGB, KIND_XYZ, KIND_OTHER };

static enum frame_kind frame_kind_of(const struct image *image)
{
    const char *const *names = image->names;
    if (image->channels <= 2) {
        return names == NULL || strcmp(names[0], "Y") == 0 ? KIND_GREY : KIND_OTHER;
    }
    if (names == NULL) {
        return KIND_RGB;
    }
    for (int kind = KIND_RGB; kind <= KIND_XYZ; kind++) {
        const char *wanted = kind == KIND_RGB ? "RGB" : "XYZ";
        bool is = true;
        for (int k = 0; k < FRAME_CHANNELS; k++) {
            is = is && names[k][0] == wanted[k] && names[k][1] == '\0';
        }
        if (is) {
            return (enum frame_kind)kind;
        }
    }
    return KIND_OTHER;
}

/* Whole numbers as they were, from shares of the highest. */
static void take_codes(const struct image *image, struct arena *arena, struct tone_frame *frame)
{
    const size_t count = image->width * image->height, step = image->channels > 2 ? 1 : 0;
    const unsigned most = (unsigned)frame_levels(image->bits) - 1;
    uint8_t *bytes = image->bits == 8 ? ARENA_ARRAY(arena, count * FRAME_CHANNELS, uint8_t) : NULL;
    uint16_t *codes =
        image->bits == 16 ? ARENA_ARRAY(arena, count * FRAME_CHANNELS, uint16_t) : NULL;
    for (size_t i = 0; i < count; i++) {
        const float *from = image->pixels + i * image->channels;
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            const unsigned code = (unsigned)(from[k * step] * (float)most + 0.5F);
            frame->full += code == most;
            if (bytes != NULL) {
                bytes[i * FRAME_CHANNELS + k] = (uint8_t)code;
            } else {
                codes[i * FRAME_CHANNELS + k] = (uint16_t)code;
            }
        }
    }
    frame->bytes = bytes;
    frame->codes = codes;
}

bool frame_take(const struct image *image, struct arena *arena, struct tone_frame *frame,
                struct error *error)
{
    const enum frame_kind kind = frame_kind_of(image);
    if (kind == KIND_OTHER) {
        return fail(error, ERROR_DATA, "its channels are neither Y, nor R, G, B, nor X, Y, Z");
    }
    if (!image_check(image, IMAGE_FINITE, error)) {
        return false;
    }
    *frame = (struct tone_frame){.width = image->width,
                                 .height = image->height,
                                 .aspect = image->aspect,
                                 .bits = image->bits};
    if (image->bits != 0) {
        take_codes(image, arena, frame);
        const size_t count = frame_levels(image->bits);
        double *light = ARENA_ARRAY(arena, count, double);
        for (size_t i = 0; i < count; i++) {
            light[i] = image_light(image, (double)i / (double)(count - 1));
        }
        const struct frame_level *levels = frame_levels_of(light, count, arena);
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            frame->levels[k] = levels;
        }
        return true;
    }
    float *values = ARENA_ARRAY(arena, image->width * image->height * FRAME_CHANNELS, float);
    const struct colour_matrix to_srgb = colour_inverse(&colour_xyz_of_srgb);
    const size_t step = kind == KIND_GREY ? 0 : 1;
    for (size_t i = 0; i < image->width * image->height; i++) {
        const float *from = image->pixels + i * image->channels;
        float *to = values + i * FRAME_CHANNELS;
        for (size_t k = 0; k < FRAME_CHANNELS; k++) {
            to[k] = from[k * step];
        }
        if (kind == KIND_XYZ) {
            const struct colour srgb = colour_turned(
                &to_srgb, (struct colour){{(double)to[0], (double)to[1], (double)to[2]}});
            for (size_t k = 0; k < FRAME_CHANNELS; k++) {
                to[k] = (float)srgb.part[k];
            }
        }
    }
    frame->values = values;
    return true;
}

const struct frame_level *frame_levels_of(const double *light, size_t count, struct arena *arena)
{
    struct frame_level *levels = ARENA_ARRAY(arena, count, struct frame_level);
    const double top = light[count - 1];
    for (size_t i = 0; i < count; i++) {
        const double above = light[i + 1 < count ? i + 1 : i], below = light[i > 0 ? i - 1 : i];
        const double step = (above - below) / (i > 0 && i + 1 < count ? 2 : 1);
        const double keep = fmin(1, (top - light[i]) / (top * (1 - TRUSTED)));
        levels[i] = (struct frame_level){(float)light[i], (float)(i + 1 < count ? keep : 0),
                                         (float)fmax(step * step / 12, SPREAD_LEAST)};
    }
    return levels;
}

/* The whole number of a value. */
static size_t frame_code_of(const struct tone_frame *frame, size_t i)
{
    return frame->bytes != NULL ? frame->bytes[i] : frame->codes[i];
}

struct frame_level frame_level_at(const struct tone_frame *frame, size_t i)
{
    return frame->bits == 0 ? (struct frame_level){frame->values[i], 1, 0}
                            : frame->levels[i % FRAME_CHANNELS][frame_code_of(frame, i)];
}

bool frame_is_full(const struct tone_frame *frame, size_t i)
{
    return (frame->trust != NULL && frame->trust[i] == 0) ||
           (frame->bits != 0 && frame_code_of(frame, i) + 1 == frame_levels(frame->bits));
}

unsigned frame_byte(const struct tone_frame *frame, size_t pixel, size_t channel)
{
    const size_t i = pixel * FRAME_CHANNELS + channel;
    if (frame->bytes != NULL) {
        return frame->bytes[i];
    }
    if (frame->codes != NULL) {
        return frame->codes[i] >> 8;
    }
    return 0;
}

void frames_order(const struct tone_frame *frames, size_t count, size_t *order)
{
    for (size_t i = 0; i < count; i++) {
        size_t k = i;
        for (; k > 0 && frames[order[k - 1]].time < frames[i].time; k--) {
            order[k] = order[k - 1];
        }
        order[k] = i;
    }
}
