/* base/image/stb.h - the one place of stb: packing and unpacking, PNG and JPEG decoded. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_STB_H
#define LENSCALC_BASE_IMAGE_STB_H

#include "base/arena.h"
#include "base/image/bytes.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

enum { STB_PACKED_MOST = 1 << 29 }; /* bytes that can be packed at once; its counts are ints */

/* Append bytes as a zlib stream (RFC 1950). Given: at most STB_PACKED_MOST. */
void stb_pack(struct bytes *to, const void *data, size_t count);

/* The same of rows of `stride` bytes (> 0) at once: they are kept as they are, but for zeros. */
void stb_store(struct bytes *to, const void *data, size_t rows, size_t stride);

/*
 * Unpack a zlib stream.
 *
 * Given     packed  the stream, of at most 2^31 - 1 bytes
 *           data    receives `count` bytes, 1 to 2^31 - 1
 * Result    false: the stream is damaged, or does not hold exactly so many
 */
bool stb_unpack(struct text packed, unsigned char *data, size_t count);

/* What a picture with whole numbers was decoded to. */
struct stb_picture {
    size_t width, height, channels;
    const uint16_t *values; /* rows from the top */
};

/*
 * Decode a PNG or a JPEG.
 *
 * Given     bits  how many the values shall have: 8, 16
 * Result    false: it is damaged, or of a kind that stb does not read
 */
bool stb_decode(struct text file, int bits, struct arena *arena, struct stb_picture *picture);

#endif
