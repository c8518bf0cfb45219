/* scene/texture.c - textures: bilinear lookup in pictures on things. */
/* SPDX-License-Identifier: MIT */
#include "scene/texture.h"

#include "light/colour.h"

#include <math.h>
#include <stdbool.h>

/* Two pixels side by side, and how far it is from the first to the second. */
struct between {
    size_t at[2];
    double share;
};

/* Beyond the ends the last one, or the first of the next; anything but a number is the first. */
static size_t texture_pixel(double at, size_t count, bool repeats)
{
    const double last = (double)(count - 1);
    if (!(at >= 0)) {
        return repeats && at < 0 ? count - 1 : 0;
    }
    if (at <= last) {
        return (size_t)at;
    }
    if (repeats) {
        return 0;
    }
    return count - 1;
}

static struct between between_at(double place, size_t count, bool repeats)
{
    const double at = place * (double)count - 0.5, first = floor(at);
    return (struct between){
        {texture_pixel(first, count, repeats), texture_pixel(first + 1, count, repeats)},
        at - first};
}

void texture_lookup(const struct image *image, const double place[2], enum texture_edges edges,
                    double of[TEXTURE_CHANNELS])
{
    const struct between x = between_at(place[0], image->width, edges != TEXTURE_ENDS);
    const struct between y = between_at(1 - place[1], image->height, edges == TEXTURE_REPEATS);
    const size_t left = x.at[0] * image->channels, right = x.at[1] * image->channels;
    const float *upper = image_row(image, y.at[0]), *lower = image_row(image, y.at[1]);
    const size_t step = image->channels < TEXTURE_ALPHA ? 0 : 1;
    const size_t count = image->channels > TEXTURE_ALPHA ? TEXTURE_CHANNELS : TEXTURE_ALPHA;
    of[TEXTURE_ALPHA] = 1;
    for (size_t k = 0; k < count; k++) {
        const double a = (double)upper[left + k * step], b = (double)upper[right + k * step];
        const double c = (double)lower[left + k * step], d = (double)lower[right + k * step];
        const double from = a + x.share * (b - a), to = c + x.share * (d - c);
        of[k] = from + y.share * (to - from);
    }
}

double texture_luminance(const struct image *image)
{
    const size_t pixels = image->width * image->height;
    double sum = 0;
    for (size_t i = 0; i < pixels; i++) {
        const float *of = image->pixels + i * image->channels;
        sum += colour_luminance((const double[3]){of[0], of[1], of[2]});
    }
    return sum / (double)pixels;
}
