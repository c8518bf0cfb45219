/* base/image/crc.c - the checksum of PNG and zip. */
/* SPDX-License-Identifier: MIT */
#include "base/image/crc.h"

uint32_t crc_of(const void *data, size_t count)
{
    /* what four bits leave */
    static const uint32_t rest[16] = {0x00000000, 0x1db71064, 0x3b6e20c8, 0x26d930ac,
                                      0x76dc4190, 0x6b6b51f4, 0x4db26158, 0x5005713c,
                                      0xedb88320, 0xf00f9344, 0xd6d6a3e8, 0xcb61b38c,
                                      0x9b64c2b0, 0x86d3d2d4, 0xa00ae278, 0xbdbdf21c};
    const unsigned char *at = data;
    uint32_t crc = 0xffffffffU;
    for (size_t i = 0; i < count; i++) {
        crc ^= at[i];
        crc = rest[crc & 15] ^ crc >> 4;
        crc = rest[crc & 15] ^ crc >> 4;
    }
    return ~crc;
}
