/* exchange/metadata/photo_file.h - files that are photographs. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_METADATA_PHOTO_FILE_H
#define LENSCALC_EXCHANGE_METADATA_PHOTO_FILE_H

#include "base/error.h"
#include "base/file_type.h"
#include "base/image/metadata.h"

#include <stdbool.h>

/* Kinds of files that are photographs: .jpg, .heic, .cr3, ... */
const struct file_type *photo_types(size_t i);

/* Is it of a kind whose Exif data are read without another program? */
bool photo_is_plain(const struct file_type *type);

/*
 * What the Exif data of a JPEG or TIFF file say. Nothing of it is read but the lists of tags, and
 * of a JPEG the heads of the segments before them.
 *
 * Errors    as exif_read; ERROR_IO: it cannot be read
 */
bool photo_file_read(const char *path, struct metadata *metadata, struct error *error);

#endif
