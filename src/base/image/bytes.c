/* base/image/bytes.c - numbers as files of pictures hold them, and checksums of bytes. */
/* SPDX-License-Identifier: MIT */
#include "base/image/bytes.h"

#include <math.h>

unsigned char *bytes_room(struct bytes *bytes, size_t count)
{
    if (bytes->room - bytes->used < count) {
        const size_t room = bytes->used + count + bytes->room;
        unsigned char *larger = arena_buffer_array(bytes->arena, room, 1);
        if (bytes->used > 0) {
            memcpy(larger, bytes->data, bytes->used);
        }
        bytes->data = larger;
        bytes->room = room;
    }
    return bytes->data + bytes->used;
}

void bytes_put(struct bytes *bytes, const void *data, size_t count)
{
    if (count > 0) {
        memcpy(bytes_room(bytes, count), data, count);
        bytes->used += count;
    }
}

void bytes_put_string(struct bytes *bytes, const char *string)
{
    bytes_put(bytes, string, strlen(string));
}

void bytes_put_little(struct bytes *bytes, uint64_t value, int count)
{
    bytes_store_little(bytes_room(bytes, (size_t)count), value, count);
    bytes->used += (size_t)count;
}

void bytes_put_big(struct bytes *bytes, uint64_t value, int count)
{
    unsigned char *at = bytes_room(bytes, (size_t)count);
    for (int i = 0; i < count; i++) {
        at[i] = (unsigned char)(value >> 8 * (count - 1 - i));
    }
    bytes->used += (size_t)count;
}

uint16_t half_of_float(float value)
{
    const uint32_t bits = bytes_bits(value);
    const uint16_t sign = (uint16_t)(bits >> 16 & 0x8000);
    const float size = fabsf(value);
    if (isnan(value)) {
        return sign | 0x7e00;
    }
    if (size >= HALF_END) {
        return sign | 0x7c00;
    }
    /* in units of the last place: 2^-24 below 2^-14 */
    int exponent;
    frexp((double)size, &exponent);
    exponent = size < 0x1p-14F ? -13 : exponent;
    const double units = ldexp((double)size, 11 - exponent);
    uint32_t whole = (uint32_t)units;
    const double rest = units - whole;
    whole += rest > 0.5 || (rest >= 0.5 && whole % 2 != 0) ? 1 : 0;
    /* the leading one of a normal number counts as an exponent, and so does a carry */
    return (uint16_t)(sign | ((uint32_t)(exponent + 13) * 1024 + whole));
}

float half_value(uint16_t half)
{
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    float size = exponent == 0 ? ldexpf((float)fraction, -24)
                               : ldexpf((float)(1024 + fraction), exponent - 25);
    if (exponent == 31) {
        size = fraction != 0 ? NAN : INFINITY;
    }
    return half & 0x8000 ? -size : size;
}

/* Bytes that are taken at once, and from how many on their tables are worth it. */
enum { AT_ONCE = 8, WORTH = 16384 };

/* What is left of a byte after 1 .. AT_ONCE bytes (Kounavis and Berry 2005: slicing by 8).*/
static void crc_tables_fill(uint32_t rest[AT_ONCE][256])
{
    for (uint32_t i = 0; i < 256; i++) {
        uint32_t crc = i;
        for (int bit = 0; bit < 8; bit++) {
            crc = crc >> 1 ^ (0xedb88320U & (0U - (crc & 1)));
        }
        rest[0][i] = crc;
    }
    for (size_t k = 1; k < AT_ONCE; k++) {
        for (size_t i = 0; i < 256; i++) {
            rest[k][i] = rest[k - 1][i] >> 8 ^ rest[0][rest[k - 1][i] & 255];
        }
    }
}

uint32_t crc_of(const void *data, size_t count)
{
    /* what four bits leave */
    static const uint32_t rest[16] = {0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac,
                                      0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
                                      0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                      0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};
    const unsigned char *at = data;
    uint32_t crc = 0xffffffffU;
    const size_t many = count >= WORTH ? count - count % AT_ONCE : 0;
    if (many > 0) {
        uint32_t tables[AT_ONCE][256];
        crc_tables_fill(tables);
        for (size_t i = 0; i < many; i += AT_ONCE) {
            const uint64_t next = bytes_little(at + i, AT_ONCE) ^ crc;
            crc = 0;
            for (int k = 0; k < AT_ONCE; k++) {
                crc ^= tables[AT_ONCE - 1 - k][next >> 8 * k & 255];
            }
        }
    }
    for (size_t i = many; i < count; i++) {
        crc ^= at[i];
        crc = rest[crc & 15] ^ crc >> 4;
        crc = rest[crc & 15] ^ crc >> 4;
    }
    return ~crc;
}
