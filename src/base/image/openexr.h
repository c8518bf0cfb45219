/* base/image/openexr.h - OpenEXR: scanlines of halves and floats. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_OPENEXR_H
#define LENSCALC_BASE_IMAGE_OPENEXR_H

#include "base/image/image.h"

bool openexr_is(struct text file);

/*
 * Read one of scanlines, of halves, floats or whole numbers, packed by none, RLE, ZIPS or ZIP.
 *
 * Result    all channels, those of a set in its order (RGB, RGBA, Y, YA, XYZ), others in that of
 *           their names; notes: its attributes that are strings
 * Source    [OpenEXR23] file layout
 * Errors    ERROR_DATA naming the byte: truncated, damaged, tiles, several parts, depths of a
 *           pixel, another packing, channels of lower resolution, pixels that are not square, a
 *           picture that is part of a larger one, NaN
 */
bool openexr_read(struct text file, const struct image_wish *wish, struct arena *arena,
                  struct image *image, struct error *error);

/*
 * Write one of scanlines, from the top.
 *
 * Given     way    its `half` and `packed`: ZIP, 16 rows at once. Notes become attributes of type
 *                  string
 * Errors    ERROR_DATA: NaN; a value that is larger than half floats have
 */
bool openexr_write(const struct image *image, const struct image_way *way, struct arena *arena,
                   struct text *file, struct error *error);

/* The format's own numbers. */
enum {
    OPENEXR_MAGIC = 20000630,
    OPENEXR_WHOLE = 0,
    OPENEXR_HALF = 1,
    OPENEXR_FLOAT = 2,
    OPENEXR_NONE = 0,
    OPENEXR_RLE = 1,
    OPENEXR_ZIPS = 2,
    OPENEXR_ZIP = 3,
    OPENEXR_ZIP_ROWS = 16
};

#endif
