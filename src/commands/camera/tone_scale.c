/* commands/camera/tone_scale.c - luminance in false colours, with their scale. */
/* SPDX-License-Identifier: MIT */
#include "base/image/srgb.h"
#include "commands/camera/tone.h"
#include "draw/lettering.h"
#include "draw/palette.h"
#include "tone/sight.h"

#include <math.h>

enum { CHANNELS = 3, LETTERS = 8, HEIGHT_OF_SIZE = 240, LEAST_LINES = 4, BAR = 6, GAP = 3 };

/* The colour of a place on the scale. */
static void tone_scale_put_colour(double share, float *pixel)
{
    double colour[CHANNELS];
    palette_scale(false, share, colour);
    for (int k = 0; k < CHANNELS; k++) {
        pixel[k] = (float)srgb_light(colour[k]);
    }
}

static double tone_scale_share_of(double luminance, const double range[2])
{
    return luminance > 0 ? log(luminance / range[0]) / log(range[1] / range[0]) : 0;
}

/* Beside each whole decade, and at the ends where none is near, its luminance. */
static void write_marks(struct image *picture, size_t left, size_t size, const double range[2],
                        struct arena *arena)
{
    const double high = (double)picture->height, tall = (double)(LETTERING_HIGH * size);
    const double top = 2 * tall, bottom = high - tall;
    const int first = (int)ceil(log10(range[0]) - 1e-9), last = (int)floor(log10(range[1]) + 1e-9);
    lettering_write(picture, left, size, size, "cd/m2");
    for (int decade = first - 1; decade <= last + 1; decade++) {
        const bool is_end = decade < first || decade > last;
        const double end = decade < first ? range[0] : range[1];
        const double luminance = is_end ? end : pow(10, decade);
        const double y = bottom - tone_scale_share_of(luminance, range) * (bottom - top);
        const double other = decade < first ? pow(10, first) : pow(10, last);
        const double away =
            fabs(tone_scale_share_of(luminance, range) - tone_scale_share_of(other, range));
        if (!is_end || first > last || away * (bottom - top) > 1.5 * tall) {
            lettering_write(picture, left, (size_t)(y - tall / 2), size,
                            arena_printf(arena, "%.6g", luminance));
        }
    }
}

/* The bar beside the picture: its lower end is the lowest luminance. */
static void tone_scale_draw_scale(struct image *picture, size_t from, size_t size,
                                  const double range[2], struct arena *arena)
{
    const double tall = (double)(LETTERING_HIGH * size);
    const double top = 2 * tall, bottom = (double)picture->height - tall;
    const size_t left = from + GAP * size, right = left + BAR * size;
    for (size_t y = (size_t)top; (double)y < bottom; y++) {
        const double share = (bottom - (double)y - 0.5) / (bottom - top);
        for (size_t x = left; x < right; x++) {
            tone_scale_put_colour(share, image_row(picture, y) + CHANNELS * x);
        }
    }
    write_marks(picture, right + size, size, range, arena);
}

bool tone_falsecolor(const struct image *light, const double range[2], struct arena *arena,
                     struct image *picture, struct error *error)
{
    const size_t size = light->height / HEIGHT_OF_SIZE + 1;
    const bool has_scale = light->height >= LEAST_LINES * LETTERING_HIGH;
    *picture = *light;
    picture->width += has_scale ? size * (GAP + BAR + 1 + LETTERS * LETTERING_STEP) : 0;
    if (!image_new(picture, arena, error)) {
        return false;
    }
    for (size_t y = 0; y < light->height; y++) {
        const float *from = image_row(light, y);
        float *to = image_row(picture, y);
        for (size_t x = 0; x < light->width; x++) {
            const double luminance = (double)sight_luminance(from + CHANNELS * x);
            tone_scale_put_colour(tone_scale_share_of(luminance, range), to + CHANNELS * x);
        }
    }
    if (has_scale) {
        tone_scale_draw_scale(picture, light->width, size, range, arena);
    }
    return true;
}
