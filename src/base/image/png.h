/* base/image/png.h - PNG: whole numbers of 8 or 16 bits, compressed without loss. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_PNG_H
#define LENSCALC_BASE_IMAGE_PNG_H

#include "base/image/image.h"

bool png_is(struct text file);

/*
 * Read one of any kind: 1 to 16 bits, grey or colours or a palette, with or without transparency,
 * interlaced or not.
 *
 * Given     wish    its values, IMAGE_LIGHT: the samples are undone from the file's gAMA if it has
 *                   that alone, else from sRGB; transparency is no light. Profiles (iCCP) are
 *                   passed over
 * Result    1 to 4 channels: Y, YA, RGB, RGBA; notes: its texts that are not compressed
 * Source    [PNG03]
 * Errors    ERROR_DATA naming the byte: truncated, a checksum is wrong, not of PNG's form, more
 *           pixels than so many bytes can hold, colours that the palette lacks
 */
bool png_read(struct text file, const struct image_wish *wish, struct arena *arena,
              struct image *image, struct error *error);

/*
 * Write one of 1 to 4 channels, Y, YA, RGB, RGBA.
 *
 * Given     way    its bits, values, threads and whether it is stored: IMAGE_LIGHT is encoded as
 *                  sRGB and rounded to the nearest code; IMAGE_CODES are rounded, and a gAMA of 1
 *                  says so. 0 to 1, cut to that
 *           file   receives it, in the arena
 * Errors    ERROR_DATA: a value that is not a number, more than 4 channels, more than 512 MiB
 */
bool png_write(const struct image *image, const struct image_way *way, struct arena *arena,
               struct text *file, struct error *error);

/* The format's own numbers. */
#define PNG_SIGNATURE "\x89PNG\r\n\x1a\n"
enum {
    PNG_START = sizeof PNG_SIGNATURE - 1,
    PNG_HEADER = 13,          /* bytes of IHDR */
    PNG_FRAME = 12,           /* bytes of a chunk beside its data */
    PNG_GAMMA_LINEAR = 100000 /* of gAMA */
};

#endif
