/* base/image/crc.h - the checksum of PNG and zip. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_IMAGE_CRC_H
#define LENSCALC_BASE_IMAGE_CRC_H

#include <stddef.h>
#include <stdint.h>

/*
 * CRC-32 of bytes: polynomial 0x04c11db7, bits in reverse, begun and ended with all ones.
 *
 * Source    [PNG03] annex D; of "123456789" it is 0xcbf43926
 */
uint32_t crc_of(const void *data, size_t count);

#endif
