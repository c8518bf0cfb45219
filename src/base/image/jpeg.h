/* base/image/jpeg.h - JPEG, which is read only. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_JPEG_H
#define LENSCALC_BASE_IMAGE_JPEG_H

#include "base/image/image.h"

bool jpeg_is(struct text file);

/*
 * Read one, baseline or progressive, of 8 bits, grey or colours.
 *
 * Given     wish    its values, IMAGE_LIGHT: sRGB is undone, whatever profile it has
 * Result    channels Y or RGB; notes: as exif_notes. Its own way round: what Exif says of turning
 *           is not heard
 * Errors    ERROR_DATA: truncated, damaged, too large, of another kind
 */
bool jpeg_read(struct text file, const struct image_wish *wish, struct arena *arena,
               struct image *image, struct error *error);

#endif
