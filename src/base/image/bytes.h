/* base/image/bytes.h - numbers as files of pictures hold them, and checksums of bytes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_BYTES_H
#define LENSCALC_BASE_IMAGE_BYTES_H

#include "base/arena.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t bytes_little(const unsigned char *at, int count)
{
    uint64_t value = 0;
    while (count-- > 0) {
        value = value << 8 | at[count];
    }
    return value;
}

static inline uint64_t bytes_big(const unsigned char *at, int count)
{
    uint64_t value = 0;
    for (int i = 0; i < count; i++) {
        value = value << 8 | at[i];
    }
    return value;
}

static inline float bytes_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline uint32_t bytes_bits(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static inline void bytes_store_little(unsigned char *to, uint64_t value, int count)
{
    for (int i = 0; i < count; i++) {
        to[i] = (unsigned char)(value >> 8 * i);
    }
}

static inline bool bytes_are_zero(const void *data, size_t count)
{
    const unsigned char *bytes = data;
    return count == 0 || (bytes[0] == 0 && memcmp(bytes, bytes + 1, count - 1) == 0);
}

/* What is being written; begins with {arena}. */
struct bytes {
    struct arena *arena;
    unsigned char *data;
    size_t used, room;
};

/* Room for `count` more behind what is there; then `used` may be moved on. */
unsigned char *bytes_room(struct bytes *bytes, size_t count);

void bytes_put(struct bytes *bytes, const void *data, size_t count);
void bytes_put_string(struct bytes *bytes, const char *string);
void bytes_put_little(struct bytes *bytes, uint64_t value, int count);
void bytes_put_big(struct bytes *bytes, uint64_t value, int count);

static inline struct text bytes_text(const struct bytes *bytes)
{
    return (struct text){(const char *)bytes->data, bytes->used};
}

/* The largest that is not rounded to infinity lies just under this. */
#define HALF_END 65520.0F

/*
 * IEEE 754's binary16: a sign, 5 bits of exponent, 10 of fraction.
 *
 * Given     value  any; above HALF_END it becomes infinity, a NaN stays one
 * Result    the nearest, ties to even
 */
uint16_t half_of_float(float value);

/* Exact. */
float half_value(uint16_t half);

/*
 * CRC-32 of bytes: polynomial 0x04c11db7, bits in reverse, begun and ended with all ones.
 *
 * Source    [PNG03] annex D; of "123456789" it is 0xcbf43926
 */
uint32_t crc_of(const void *data, size_t count);

#endif
