/* base/image/pfm.c - PFM: 32-bit floats as they are. */
/* SPDX-License-Identifier: MIT */
#include "base/image/pfm.h"

#include "base/image/bytes.h"
#include "base/number.h"

#include <math.h>

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool pfm_is(struct text file)
{
    return file.length >= 3 && file.start[0] == 'P' &&
           (file.start[1] == 'F' || file.start[1] == 'f') && is_space(file.start[2]);
}

/* The next number of the head, and the one blank behind it. */
static bool take_number(struct text file, size_t *at, const char *what, double *value,
                        struct error *error)
{
    const char *end = file.start + file.length, *start = file.start + *at;
    while (start < end && is_space(*start)) {
        start++;
    }
    const char *behind = number_read(start, end, NUMBER_UNSCALED, value);
    if (behind == NULL || behind == end || !is_space(*behind)) {
        return fail(error, ERROR_DATA, "PFM: no %s at byte %zu", what,
                    (size_t)(start - file.start));
    }
    *at = (size_t)(behind + 1 - file.start);
    return true;
}

static bool pfm_take_side(struct text file, size_t *at, const char *what, size_t *side,
                          struct error *error)
{
    double value;
    if (!take_number(file, at, what, &value, error)) {
        return false;
    }
    if (!(value >= 1 && value <= IMAGE_SIDE_MOST && value == floor(value))) {
        return fail(error, ERROR_DATA, "PFM: %s %g: it must be a whole number, 1 to %d", what,
                    value, IMAGE_SIDE_MOST);
    }
    *side = (size_t)value;
    return true;
}

bool pfm_read(struct text file, const struct image_wish *wish, struct arena *arena,
              struct image *image, struct error *error)
{
    size_t at = 2;
    double scale;
    *image = (struct image){.channels = file.start[1] == 'F' ? 3 : 1};
    if (!pfm_take_side(file, &at, "width", &image->width, error) ||
        !pfm_take_side(file, &at, "height", &image->height, error) ||
        !take_number(file, &at, "scale", &scale, error)) {
        return false;
    }
    if (!isfinite(scale) || scale == 0) {
        return fail(error, ERROR_DATA, "PFM: scale %g: it must be a finite number other than 0",
                    scale);
    }
    const size_t values = image->width * image->channels, row = 4 * values;
    if (file.length - at != row * image->height) {
        return fail(error, ERROR_DATA,
                    "PFM: %zu bytes of pixels, and %zu x %zu pixels of %zu channels have %zu",
                    file.length - at, image->width, image->height, image->channels,
                    row * image->height);
    }
    if (!image_new_wished(image, wish, arena, error)) {
        return false;
    }
    const float factor = (float)fabs(scale);
    const unsigned char *from = (const unsigned char *)file.start + at;
    for (size_t y = image->height; y-- > 0;) {
        float *to = image_row(image, y);
        for (size_t i = 0; i < values; i++, from += 4) {
            const uint64_t bits = scale < 0 ? bytes_little(from, 4) : bytes_big(from, 4);
            to[i] = factor * bytes_float((uint32_t)bits);
        }
    }
    return image_check(image, IMAGE_NUMBERS, error);
}

bool pfm_write(const struct image *image, struct arena *arena, struct text *file,
               struct error *error)
{
    struct bytes to = {.arena = arena};
    const size_t values = image->width * image->channels;
    if (image->channels != 1 && image->channels != 3) {
        return fail(error, ERROR_DATA, "a PFM has 1 channel or 3, not %zu", image->channels);
    }
    if (!image_check(image, IMAGE_NUMBERS, error)) {
        return false;
    }
    bytes_put_string(&to,
                     arena_printf(arena, "P%c\n%zu %zu\n-1.0\n", image->channels == 3 ? 'F' : 'f',
                                  image->width, image->height));
    unsigned char *at = bytes_room(&to, 4 * values * image->height);
    for (size_t y = image->height; y-- > 0;) {
        const float *row = image_row(image, y);
        for (size_t i = 0; i < values; i++, at += 4) {
            bytes_store_little(at, bytes_bits(row[i]), 4);
        }
    }
    to.used += 4 * values * image->height;
    *file = bytes_text(&to);
    return true;
}
