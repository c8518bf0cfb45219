/* cli/options/option_pixels.c - read pixel counts: 2448x2048, 4096, 4Mpx, 1080p. */
/* SPDX-License-Identifier: MIT */
#include "cli/options/option.h"

#include <math.h>

/* Video formats by their trade names. */
static const struct video_format {
    const char *name;
    double wide, high;
} video_formats[] = {
    {"720p", 1280, 720}, {"HD", 1280, 720},     {"1080p", 1920, 1080}, {"Full HD", 1920, 1080},
    {"2K", 2048, 1080},  {"1440p", 2560, 1440}, {"4K", 3840, 2160},    {"2160p", 3840, 2160},
    {"UHD", 3840, 2160}, {"8K", 7680, 4320},
};

static bool read_video_format(struct text text, struct pixels_value *pixels)
{
    for (size_t i = 0; i < sizeof video_formats / sizeof video_formats[0]; i++) {
        if (text_same_name(text, text_of(video_formats[i].name))) {
            *pixels = (struct pixels_value){video_formats[i].wide, video_formats[i].high, NAN};
            return true;
        }
    }
    return false;
}

/* "4Mpx", "12.3 MP": the number before the unit; its start is null elsewhere. */
static struct text megapixels_of(struct text text)
{
    static const char *const ends[] = {"mpixels", "mpixel", "megapixels", "megapixel", "mpx", "mp"};
    for (size_t i = 0; i < sizeof ends / sizeof ends[0]; i++) {
        const struct text end = text_of(ends[i]);
        if (text.length > end.length &&
            text_same(text_between(text.start + text.length - end.length, text.start + text.length),
                      ends[i])) {
            return text_trim((struct text){text.start, text.length - end.length});
        }
    }
    return (struct text){NULL, 0};
}

/* "1280x720px" and "6000 px" are what they are without. */
static struct text pixels_without_unit(struct text text)
{
    const struct text end = text_of("px");
    if (text.length > end.length &&
        text_same(text_between(text.start + text.length - end.length, text.start + text.length),
                  "px")) {
        text.length -= end.length;
    }
    return text_trim(text);
}

static bool is_pixel_count(double number)
{
    return number >= 1 && number <= 1e6 && number == floor(number);
}

static bool pixels_value_read(const struct reader *reader, const struct option *option,
                              struct text text, void *member, struct error *error)
{
    struct pixels_value *pixels = member;
    const struct text millions = megapixels_of(text_trim(text));
    const struct text whole = pixels_without_unit(text_trim(text));
    double count, sides[2];
    bool has_unit = false;
    (void)reader;
    if (read_video_format(whole, pixels)) {
        return true;
    }
    if (millions.start != NULL) {
        if (!quantity_read(millions, &dimension_number, NULL, &count, NULL, error)) {
            return option_blame(option, text, error);
        }
        *pixels = (struct pixels_value){NAN, NAN, count * 1e6};
        return (count > 0 && count <= 1e6) ||
               fail(error, ERROR_DOMAIN, "%s '%.*s' must be above 0 and at most 1e6 Mpx",
                    TYPED(option, text));
    }
    if (option_read_size(option, whole, sides, &has_unit, error)) {
        *pixels = (struct pixels_value){sides[0], sides[1], NAN};
    } else if (error->code != ERROR_NONE) {
        return false;
    } else if (quantity_read(whole, &dimension_number, NULL, &count, NULL, error)) {
        *pixels = (struct pixels_value){count, NAN, NAN};
    } else {
        fail(error, ERROR_USAGE, "%s '%.*s' is no number of pixels", TYPED(option, text));
        return error_hint(error, "2448x2048, the width alone, 4Mpx, or 1080p");
    }
    return (!has_unit && is_pixel_count(pixels->wide) &&
            (isnan(pixels->high) || is_pixel_count(pixels->high))) ||
           fail(error, ERROR_DOMAIN, "%s '%.*s' must be whole numbers of pixels, 1 to 1000000",
                TYPED(option, text));
}

static const char *pixels_words(const struct option *option, const void *member,
                                struct arena *arena)
{
    const struct pixels_value *pixels = member;
    (void)option;
    if (!isnan(pixels->total)) {
        return arena_printf(arena, "%.15gMpx", pixels->total / 1e6);
    }
    if (isnan(pixels->wide)) {
        return NULL;
    }
    return isnan(pixels->high) ? arena_printf(arena, "%.15g", pixels->wide)
                               : arena_printf(arena, "%.15gx%.15g", pixels->wide, pixels->high);
}

const struct option_kind kind_pixels = {
    .name = "pixels",
    .size = sizeof(struct pixels_value),
    .is_list = true,
    .read = pixels_value_read,
    .words_of = pixels_words,
    .nan_count = 3,
};
