/* base/image/exif.h - how a camera says that it has exposed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_EXIF_H
#define LENSCALC_BASE_IMAGE_EXIF_H

#include "base/image/image.h"

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
