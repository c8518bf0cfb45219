/* file/depth_file.c - depth maps out of pictures of one channel. */
/* SPDX-License-Identifier: MIT */
#include "file/depth_file.h"

#include "base/image/openexr.h"
#include "base/image/pfm.h"
#include "base/image/png.h"
#include "data/whole_file.h"
#include "file/image_file.h"

#include <math.h>
#include <string.h>

enum { COLOURS = 3 };

/* A channel called Z, else the first. */
static size_t channel_of(const struct image *image, struct arena *arena)
{
    size_t channel = 0;
    for (size_t k = image->channels; k-- > 0;) {
        channel = strcmp(image_channel(image, k, arena), "Z") == 0 ? k : channel;
    }
    return channel;
}

/* Are what may be red, green and blue the same everywhere? */
static bool check_grey_map(const char *path, const struct image *image, struct error *error)
{
    for (size_t i = 0; i < image->width * image->height; i++) {
        const float *pixel = image->pixels + i * image->channels;
        for (size_t k = 1; k < COLOURS; k++) {
            if (!(pixel[k] == pixel[0] || (isnan(pixel[k]) && isnan(pixel[0])))) {
                return fail_in(
                    error, path, 0, 0,
                    "the pixel in column %zu, row %zu has a colour: a depth is one number",
                    i % image->width + 1, i / image->width + 1);
            }
        }
    }
    return true;
}

static bool take_channel(const char *path, const struct image *image, struct arena *arena,
                         struct image *map, struct error *error)
{
    const size_t channel = channel_of(image, arena);
    const bool is_named = strcmp(image_channel(image, channel, arena), "Z") == 0;
    if (!is_named && image->channels >= COLOURS && !check_grey_map(path, image, error)) {
        return false;
    }
    *map = (struct image){
        .width = image->width, .height = image->height, .channels = 1, .aspect = image->aspect};
    if (image->channels == 1) {
        map->pixels = image->pixels;
        return true;
    }
    if (!image_new(map, arena, error)) {
        return false;
    }
    for (size_t i = 0; i < map->width * map->height; i++) {
        map->pixels[i] = image->pixels[i * image->channels + channel];
    }
    return true;
}

static bool check_depth_map(const char *path, struct text bytes, const struct depth_range *range,
                            struct error *error)
{
    const bool has_range = !isnan(range->near);
    if (png_is(bytes)) {
        return has_range || fail(error, ERROR_USAGE,
                                 "%.200s is a PNG, whose numbers are no distances: {depth} "
                                 "NEAR..FAR says what white and black are",
                                 path);
    }
    if (!pfm_is(bytes) && !openexr_is(bytes)) {
        return fail_in(error, path, 0, 0, "a depth map is PFM, OpenEXR or PNG");
    }
    return !has_range ||
           fail(error, ERROR_USAGE, "{depth} is for a PNG: %.200s has its distances in m", path);
}

bool depth_file_read(const char *path, const struct depth_range *range, struct arena *arena,
                     struct image *map, struct error *error)
{
    const struct image_wish wish = {IMAGE_CODES, IMAGE_SEEN_MOST};
    struct text bytes;
    struct image image;
    if (!file_of_kind(path, IMAGE_FILE_MOST, image_file_is, arena, &bytes, error)) {
        return error->code == ERROR_NONE ? fail(error, ERROR_IO, "there is no file %s", path)
                                         : false;
    }
    if (!check_depth_map(path, bytes, range, error) ||
        !image_file_parse(path, bytes, &wish, arena, &image, error) ||
        !take_channel(path, &image, arena, map, error)) {
        return false;
    }
    const double least = 1 / range->far, most = 1 / range->near;
    for (size_t i = 0; i < map->width * map->height && png_is(bytes); i++) {
        map->pixels[i] = (float)(1 / (least + (double)map->pixels[i] * (most - least)));
    }
    return true;
}
