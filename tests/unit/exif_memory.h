/* tests/unit/exif_memory.h - Exif data read from memory. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_EXIF_MEMORY_H
#define LENSCALC_TESTS_UNIT_EXIF_MEMORY_H

#include "base/image/exif.h"

#include <string.h>

static inline bool exif_memory_read(const void *context, size_t at, void *into, size_t count)
{
    memcpy(into, (const char *)context + at, count);
    return true;
}

static inline struct exif_bytes exif_memory(const void *memory, size_t length)
{
    return (struct exif_bytes){.read = exif_memory_read, .context = memory, .length = length};
}

#endif
