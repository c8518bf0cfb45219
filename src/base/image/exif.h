/* base/image/exif.h - what the Exif data of a JPEG or TIFF file say of its photograph. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_EXIF_H
#define LENSCALC_BASE_IMAGE_EXIF_H

#include "base/error.h"
#include "base/image/image.h"
#include "base/image/metadata.h"

#include <stddef.h>

/* Where bytes come from: an open file, or memory. */
struct exif_bytes {
    /* Read `count` bytes from byte `at`, which are within the length. False: they cannot be had */
    bool (*read)(const void *context, size_t at, void *into, size_t count);
    const void *context; /* its first argument */
    size_t length;
};

/*
 * Read what a JPEG or TIFF says of the camera and its settings. Of a JPEG the segments before the
 * picture are looked through, of a TIFF the first list of tags; of both the list of Exif.
 *
 * Given     bytes     the file from its first byte
 *           metadata  receives what there is; numbers that Exif calls unknown stay NaN
 * Source    [Exif10] 4.6.2 (lists of tags and their types), 4.6.5 (exposure; subject distance:
 *           a numerator of 0xFFFFFFFF is infinity, 0 unknown), 4.7.2 (the segment APP1 of a
 *           JPEG), annex C (APEX: time = 2^-T, N = 2^(A/2))
 * Errors    ERROR_DATA: neither JPEG nor TIFF, no Exif data in a JPEG, a list of tags that is cut
 *           short. A tag of another type, or whose value lies outside the file, is passed over
 * Limits    Reads no makers' notes, thumbnails and further pictures. No list is read twice: files
 *           whose lists form loops end
 */
bool exif_read(const struct exif_bytes *bytes, struct metadata *metadata, struct error *error);

/*
 * Note what Exif tells of the exposure.
 *
 * Given     tiff   the data behind "Exif\0\0": a TIFF of tags; no start: nothing is noted
 *           image  gets "Exposure time" ("0.008 s"), "Aperture" ("f/2.8") and "ISO", as far as they
 *                  are there and above 0; what is damaged is not there
 */
void exif_notes(struct text tiff, struct image *image, struct arena *arena);

#endif
