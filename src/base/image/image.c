/* base/image/image.c - pictures: pixels of any channels, and what is noted beside them. */
/* SPDX-License-Identifier: MIT */
#include "base/image/image.h"

#include "base/image/srgb.h"

#include <math.h>
#include <string.h>

bool image_new(struct image *image, struct arena *arena, struct error *error)
{
    const size_t width = image->width, height = image->height, channels = image->channels;
    if (width < 1 || height < 1 || width > IMAGE_SIDE_MOST || height > IMAGE_SIDE_MOST) {
        return fail(error, ERROR_DATA, "%zu x %zu pixels: there must be 1 to %d each way", width,
                    height, IMAGE_SIDE_MOST);
    }
    if (channels < 1 || channels > IMAGE_CHANNELS_MOST) {
        return fail(error, ERROR_DATA, "%zu channels: there must be 1 to %d", channels,
                    IMAGE_CHANNELS_MOST);
    }
    if (width * height > IMAGE_VALUES_MOST / channels) {
        return fail(error, ERROR_DATA, "%zu x %zu pixels of %zu channels: at most %d values", width,
                    height, channels, IMAGE_VALUES_MOST);
    }
    image->pixels = ARENA_ARRAY(arena, width * height * channels, float);
    return true;
}

bool image_new_wished(struct image *image, const struct image_wish *wish, struct arena *arena,
                      struct error *error)
{
    const size_t most = wish->pixels_most;
    if (most > 0 && image->width > most / (image->height > 0 ? image->height : 1)) {
        return fail(error, ERROR_DATA, "%zu x %zu pixels: at most %zu", image->width, image->height,
                    most);
    }
    return image_new(image, arena, error);
}

double image_proportion(const struct image *image)
{
    const double pixels = (double)image->width / (double)image->height;
    return image->aspect > 0 ? pixels * image->aspect : pixels;
}

bool image_take_aspect(struct image *image, double aspect)
{
    const bool is_legal = aspect >= IMAGE_ASPECT_LEAST && aspect <= IMAGE_ASPECT_MOST;
    image->aspect = is_legal && aspect != 1 ? aspect : 0;
    return is_legal;
}

double image_light(const struct image *image, double code)
{
    return image->gamma > 0 ? pow(code, 1 / image->gamma) : srgb_light(code);
}

const char *image_channel(const struct image *image, size_t channel, struct arena *arena)
{
    static const char usual[][5] = {"", "Y", "YA", "RGB", "RGBA"};
    if (image->names != NULL) {
        return image->names[channel];
    }
    return image->channels < sizeof usual / sizeof *usual
               ? arena_string(arena, &usual[image->channels][channel], 1)
               : arena_printf(arena, "%zu", channel + 1);
}

static bool is_key(struct text key)
{
    bool is_plain = key.length >= 1 && key.length <= 79;
    for (size_t i = 0; i < key.length && is_plain; i++) {
        const char c = key.start[i];
        is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || char_is_digit(c) ||
                   (c != '\0' && strchr(" -_.", c) != NULL);
    }
    return is_plain;
}

void image_note(struct image *image, struct arena *arena, struct text key, struct text value)
{
    if (!is_key(key)) {
        return;
    }
    char *clean = arena_string(arena, value.start, value.length);
    for (size_t i = 0; i < value.length;) {
        const unsigned char c = (unsigned char)clean[i];
        const size_t length = text_utf8_length(clean + i, value.length - i);
        if (c < 0x20 || c == 0x7f || length == 0) {
            clean[i] = length == 0 ? '?' : ' ';
        }
        i += length > 0 ? length : 1;
    }
    /* a place that a copy of the image has taken is not there any more */
    const size_t count = image->note_count;
    if (count >= image->note_room || image->notes[count].key != NULL) {
        enum { LEAST = 16 };
        const size_t room = 2 * count > LEAST ? 2 * count : LEAST;
        struct image_note *notes = ARENA_ARRAY(arena, room, struct image_note);
        if (count > 0) {
            memcpy(notes, image->notes, count * sizeof *notes);
        }
        image->notes = notes;
        image->note_room = room;
    }
    image->notes[image->note_count++] =
        (struct image_note){arena_string(arena, key.start, key.length), clean};
}

static bool image_is_within(float value, enum image_range range)
{
    if (range == IMAGE_NUMBERS) {
        return !isnan(value);
    }
    if (range == IMAGE_FINITE) {
        return isfinite(value) != 0;
    }
    return isfinite(value) && value >= 0;
}

bool image_check(const struct image *image, enum image_range range, struct error *error)
{
    static const char *const legal[] = {"a number", "a finite number",
                                        "a finite number of at least 0"};
    const size_t count = image->width * image->height * image->channels;
    size_t i = 0;
    while (i < count && image_is_within(image->pixels[i], range)) {
        i++;
    }
    const size_t pixel = i / image->channels;
    return i == count ||
           fail(error, ERROR_DATA,
                "channel %zu of the pixel in column %zu, row %zu is %g: it must be %s",
                i % image->channels + 1, pixel % image->width + 1, pixel / image->width + 1,
                (double)image->pixels[i], legal[range]);
}
