/* file/image_file.h - pictures in files: which formats there are, read by content. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_IMAGE_FILE_H
#define LENSCALC_FILE_IMAGE_FILE_H

#include "base/file_type.h"
#include "base/image/image.h"

/* MiB, of a file that is read */
enum { IMAGE_FILE_MOST = 4096 };

/* The formats that are written: .png, .exr, .pfm, .hdr. */
file_types image_file_types;

/* Does a file that begins so have a format that is read? */
bool image_file_is(struct text first);

/*
 * Read a picture; its first bytes say of which format, whatever its name.
 *
 * Given     path    for messages, too
 *           values  of formats with whole numbers
 * Errors    ERROR_IO: there is none, it cannot be read; ERROR_DATA: of no format that is read, or
 *           what the format's own header says; named with the file
 */
bool image_file_read(const char *path, enum image_values values, struct arena *arena,
                     struct image *image, struct error *error);

/* The same of bytes that are there already. */
bool image_file_parse(const char *path, struct text bytes, enum image_values values,
                      struct arena *arena, struct image *image, struct error *error);

/*
 * The bytes of a file.
 *
 * Given     type   one of image_file_types
 *           way    what it can choose of that
 * Errors    as the format's own header says
 */
bool image_file_bytes(const struct image *image, const struct file_type *type,
                      const struct image_way *way, struct arena *arena, struct text *bytes,
                      struct error *error);

#endif
