/* base/image/image.h - pictures: pixels of any channels, and what is noted beside them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_IMAGE_H
#define LENSCALC_BASE_IMAGE_IMAGE_H

#include "base/arena.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    IMAGE_SIDE_MOST = 65535,
    IMAGE_CHANNELS_MOST = 64,
    IMAGE_VALUES_MOST = 1 << 29 /* of all channels: 2 GiB */
};

/* Something a file says of the picture besides pixels: "Lens", "tessar". */
struct image_note {
    const char *key, *value; /* the value in UTF-8 */
};

struct image {
    size_t width, height, channels; /* within the limits above, none of them 0 */
    float *pixels;                  /* rows from the top, the channels of a pixel together */
    const char *const *names;       /* of the channels; null: those of image_channel */
    struct image_note *notes;
    size_t note_count, note_room; /* copies of an image may share the room: by image_note only */
    int bits; /* of the whole numbers that a file had: 8, 16; 0: it had floats, or there is none */
    double gamma;           /* by which that file encodes light; 0: as sRGB does */
    double aspect;          /* of a pixel, its width over its height; 0: it is square */
    bool has_primaries;     /* other ones than those of sRGB: the reader of a format says so */
    double primaries[4][2]; /* x, y of red, green, blue and white */
    size_t beyond_srgb;     /* pixels whose colours were, before they lost saturation */
};

/* What pixels' proportions may be in a file: as of OpenEXR, whose float for 1e-6 lies below it. */
#define IMAGE_ASPECT_LEAST ((double)1e-6F)
#define IMAGE_ASPECT_MOST  1e6

/* Pixels of a picture: so many to the left of them and above, and so many across and down. */
struct image_area {
    size_t left, top, width, height;
};

/* What the values of a file with whole numbers stand for. */
enum image_values {
    IMAGE_LIGHT, /* proportional to light, white 1: the file's encoding is undone */
    IMAGE_CODES  /* the numbers themselves, the highest 1: raw data, distances */
};

/* How a picture is to be read. */
struct image_wish {
    enum image_values values; /* of formats with whole numbers */
    size_t pixels_most;       /* 0: as many as the limits above let be */
};

/* How a picture is to be written; each format looks at what it can choose. */
struct image_way {
    int bits;                 /* PNG: 8 or 16 */
    enum image_values values; /* PNG: LIGHT is encoded as sRGB, CODES are written as they are */
    bool half, packed;        /* OpenEXR: 16-bit floats; ZIP */
    bool stored;              /* in a hurry: PNG not packed at all, OpenEXR but for what is black */
    int threads;              /* that encode a stored PNG; 0 and 1: only this one */
};

/*
 * Room for pixels, all 0.
 *
 * Given     image   its width, height, channels and names; receives pixels
 * Errors    ERROR_DATA: no pixels, or more than the limits
 */
bool image_new(struct image *image, struct arena *arena, struct error *error);

/*
 * The same of a picture that a file's header describes, before anything of it is unpacked.
 *
 * Errors    ERROR_DATA: more pixels than wished, too
 */
bool image_new_wished(struct image *image, const struct image_wish *wish, struct arena *arena,
                      struct error *error);

/* Width over height of the whole picture. */
double image_proportion(const struct image *image);

/* Take the proportions of a pixel, its width over its height; false: beyond the limits. */
bool image_take_aspect(struct image *image, double aspect);

/* Light of a code, as a share of the highest, in the file that the picture was read from. */
double image_light(const struct image *image, double code);

static inline float *image_row(const struct image *image, size_t y)
{
    return image->pixels + y * image->width * image->channels;
}

/* A channel's name: its own, else Y; Y, A; R, G, B; R, G, B, A; behind these 1, 2, ... */
const char *image_channel(const struct image *image, size_t channel, struct arena *arena);

/*
 * Note something.
 *
 * Given     key    1 to 79 ASCII letters, digits, blanks and "-_."; else nothing is noted
 *           value  any: control characters become blanks, what is no UTF-8 '?'
 * Result    the image's own: copies of it that were made before do not have it
 */
void image_note(struct image *image, struct arena *arena, struct text key, struct text value);

/* What a pixel may be. */
enum image_range {
    IMAGE_NUMBERS,  /* anything but NaN */
    IMAGE_FINITE,   /* a finite number */
    IMAGE_POSITIVE, /* a finite number of at least 0 */
};

/* Errors: ERROR_DATA naming the first that is not, columns and rows from 1 at the top left */
bool image_check(const struct image *image, enum image_range range, struct error *error);

#endif
