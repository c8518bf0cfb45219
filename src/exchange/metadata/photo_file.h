/* exchange/metadata/photo_file.h - files that are photographs. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_METADATA_PHOTO_FILE_H
#define LENSCALC_EXCHANGE_METADATA_PHOTO_FILE_H

#include "base/error.h"
#include "base/image/metadata.h"
#include "base/text.h"

#include <stdbool.h>

/* How the name of a photograph ends, ".jpg", ".heic" or ".cr3"; null: it is none of one. */
const char *photo_ending(struct text path);

/* Is that of a kind whose Exif data are read without another program? */
bool photo_is_plain(const char *ending);

/*
 * What the Exif data of a JPEG or TIFF file say. Nothing of it is read but the lists of tags, and
 * of a JPEG the heads of the segments before them.
 *
 * Errors    as exif_read; ERROR_IO: it cannot be read
 */
bool photo_file_read(const char *path, struct metadata *metadata, struct error *error);

#endif
