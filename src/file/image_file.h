/* file/image_file.h - pictures in files: which formats there are, read by content. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_IMAGE_FILE_H
#define LENSCALC_FILE_IMAGE_FILE_H

#include "base/file_type.h"
#include "base/image/image.h"

/* MiB, of a file that is read */
enum { IMAGE_FILE_MOST = 4096 };

/* Pixels of a picture that is looked at: a texture, a sky, a depth map; 16384 x 8192. */
enum { IMAGE_SEEN_MOST = 1 << 27 };

/* The formats that are written: .png, .exr, .pfm, .hdr. */
file_types image_file_types;

/* Does a file that begins so have a format that is read? */
bool image_file_is(struct text first);

/*
 * Read a picture; its first bytes say of which format, whatever its name. Where it names other
 * primaries than those of sRGB its light becomes that of sRGB, see colour_of_primaries; a colour
 * that sRGB does not have is moved towards the grey of its luminance until no part is below 0, and
 * counted: image_file_remark.
 *
 * Given     path    for messages, too
 *           wish    what the numbers are, and how many pixels it may have
 * Errors    ERROR_IO: there is none, it cannot be read; ERROR_DATA: of no format that is read, more
 *           pixels than wished, or what the format's own header says; named with the file
 */
bool image_file_read(const char *path, const struct image_wish *wish, struct arena *arena,
                     struct image *image, struct error *error);

/* The same of bytes that are there already. */
bool image_file_parse(const char *path, struct text bytes, const struct image_wish *wish,
                      struct arena *arena, struct image *image, struct error *error);

/* What is to be said of a picture that was read, in the arena; null: nothing. */
const char *image_file_remark(const char *path, const struct image *image, struct arena *arena);

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
