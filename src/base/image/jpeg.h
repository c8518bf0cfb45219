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

/*
 * Note what Exif tells of the exposure.
 *
 * Given     tiff   the data behind "Exif\0\0": a TIFF of tags; no start: nothing is noted
 *           image  gets "Exposure time" ("0.008 s"), "Aperture" ("f/2.8") and "ISO", as far as they
 *                  are there and above 0; what is damaged is not there
 * Source    [Exif10] 4.5.2 (TIFF), 4.6.5: ExposureTime 33434, FNumber 33437, ISO 34855
 */
void exif_notes(struct text tiff, struct image *image, struct arena *arena);

#endif
