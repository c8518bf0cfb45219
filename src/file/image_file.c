/* file/image_file.c - pictures in files: which formats there are, read by content. */
/* SPDX-License-Identifier: MIT */
#include "file/image_file.h"

#include "base/image/jpeg.h"
#include "base/image/openexr.h"
#include "base/image/pfm.h"
#include "base/image/png.h"
#include "base/image/radiance.h"
#include "data/whole_file.h"
#include "light/colour.h"

#include <assert.h>
#include <math.h>

typedef bool reader(struct text bytes, const struct image_wish *wish, struct arena *arena,
                    struct image *image, struct error *error);
typedef bool writer(const struct image *image, const struct image_way *way, struct arena *arena,
                    struct text *bytes, struct error *error);

static bool write_pfm(const struct image *image, const struct image_way *way, struct arena *arena,
                      struct text *bytes, struct error *error)
{
    (void)way;
    return pfm_write(image, arena, bytes, error);
}

static bool write_radiance(const struct image *image, const struct image_way *way,
                           struct arena *arena, struct text *bytes, struct error *error)
{
    (void)way;
    return radiance_write(image, arena, bytes, error);
}

static const struct image_file_format {
    struct file_type type;
    bool (*is)(struct text bytes);
    reader *read;
    writer *write; /* null: it is only read; these come last */
} formats[] = {
    {{{"png", "PNG, 8 or 16 bits"}, ".png"}, png_is, png_read, png_write},
    {{{"exr", "OpenEXR, floats of 16 or 32 bits"}, ".exr"},
     openexr_is,
     openexr_read,
     openexr_write},
    {{{"pfm", "PFM, floats of 32 bits"}, ".pfm"}, pfm_is, pfm_read, write_pfm},
    {{{"hdr", "Radiance, three floats in 32 bits"}, ".hdr"},
     radiance_is,
     radiance_read,
     write_radiance},
    {{{"jpg", "JPEG"}, ".jpg"}, jpeg_is, jpeg_read, NULL},
};
enum { FORMATS = sizeof formats / sizeof *formats };

const struct file_type *image_file_types(size_t i)
{
    return i < FORMATS && formats[i].write != NULL ? &formats[i].type : NULL;
}

static size_t format_of_bytes(struct text bytes)
{
    size_t i = 0;
    while (i < FORMATS && !formats[i].is(bytes)) {
        i++;
    }
    return i;
}

bool image_file_is(struct text first)
{
    return format_of_bytes(first) < FORMATS;
}

/* What is less below 0, of the largest part, is rounding. */
static const double least_negative = 1e-6;

/* Light of other primaries becomes that of sRGB, as near to grey as that has it. */
static bool take_primaries(struct image *image, struct error *error)
{
    struct colour_matrix matrix;
    struct error found;
    if (!colour_of_primaries((const double(*)[2])image->primaries, &matrix, &found)) {
        return fail(error, ERROR_DATA, "%s", found.message);
    }
    for (size_t i = 0; i < image->width * image->height; i++) {
        float *pixel = image->pixels + i * image->channels;
        const struct colour from = {{(double)pixel[0], (double)pixel[1], (double)pixel[2]}};
        struct colour to = colour_turned(&matrix, from);
        const double most = fmax(fmax(to.part[0], to.part[1]), to.part[2]);
        const double least = fmin(fmin(to.part[0], to.part[1]), to.part[2]);
        if (!(least >= -least_negative * most)) {
            /* of primaries that no light has luminance may be below 0: black */
            const double grey = fmax(colour_luminance(to.part), 0);
            const double share = colour_share_within(to.part, grey, (double)INFINITY);
            colour_move_from_grey(to.part, grey, share);
            image->beyond_srgb++;
        }
        for (int k = 0; k < 3; k++) {
            pixel[k] = (float)fmax(to.part[k], 0);
        }
    }
    image->has_primaries = false;
    return true;
}

const char *image_file_remark(const char *path, const struct image *image, struct arena *arena)
{
    return image->beyond_srgb == 0
               ? NULL
               : arena_printf(arena, "%s: %zu of %zu pixels are beyond sRGB and lose saturation",
                              path, image->beyond_srgb, image->width * image->height);
}

bool image_file_parse(const char *path, struct text bytes, const struct image_wish *wish,
                      struct arena *arena, struct image *image, struct error *error)
{
    const size_t i = format_of_bytes(bytes);
    if (i == FORMATS) {
        return fail_in(error, path, 0, 0, "neither PNG, JPEG, OpenEXR, PFM nor a Radiance picture");
    }
    return (formats[i].read(bytes, wish, arena, image, error) &&
            (!image->has_primaries || take_primaries(image, error))) ||
           error_locate(error, path, 0, 0);
}

bool image_file_read(const char *path, const struct image_wish *wish, struct arena *arena,
                     struct image *image, struct error *error)
{
    struct text bytes;
    if (!file_of_kind(path, IMAGE_FILE_MOST, image_file_is, arena, &bytes, error)) {
        return error->code == ERROR_NONE ? fail(error, ERROR_IO, "there is no file %s", path)
                                         : false;
    }
    return image_file_parse(path, bytes, wish, arena, image, error);
}

bool image_file_bytes(const struct image *image, const struct file_type *type,
                      const struct image_way *way, struct arena *arena, struct text *bytes,
                      struct error *error)
{
    size_t i = 0;
    while (i < FORMATS && &formats[i].type != type) {
        i++;
    }
    assert(i < FORMATS && formats[i].write != NULL);
    return formats[i].write(image, way, arena, bytes, error);
}
