/* base/image/stb.c - the one place of stb: packing and unpacking, PNG and JPEG decoded. */
/* SPDX-License-Identifier: MIT */
#include "base/image/stb.h"

#include <limits.h>
#include <stdlib.h>

#if defined(__has_include)
#if !__has_include(<stb/stb_image.h>)
#error "the headers of stb (libstb-dev) are not here: 'make deps' installs them"
#endif
#endif

/*
 * Memory for stb, or the end of the program: it asserts what it writes, and calls a picture damaged
 * that it has no memory for. What is new is empty, since tables that a damaged JPEG lacks are read
 * all the same.
 */
static void *stb_take(size_t size)
{
    void *memory = calloc(1, size);
    if (memory == NULL) {
        arena_end();
    }
    return memory;
}

static void *take_more(void *memory, size_t size)
{
    void *more = realloc(memory, size);
    if (more == NULL) {
        arena_end();
    }
    return more;
}

/* No files, no messages in variables, the same arithmetic on all processors. */
#define STBI_MALLOC(size)           stb_take(size)
#define STBI_REALLOC(memory, size)  take_more(memory, size)
#define STBI_FREE(memory)           free(memory)
#define STBIW_MALLOC(size)          stb_take(size)
#define STBIW_REALLOC(memory, size) take_more(memory, size)
#define STBIW_FREE(memory)          free(memory)
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_NO_FAILURE_STRINGS
#define STBI_NO_THREAD_LOCALS
#define STBI_NO_LINEAR
#define STBI_NO_SIMD
#include <stb/stb_image.h>
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

enum { QUALITY = 8 };

static uint32_t adler32(const unsigned char *data, size_t count)
{
    uint32_t a = 1, b = 0;
    for (size_t i = 0; i < count;) {
        /* so many that b stays below 2^32 */
        for (size_t end = i + 5552 < count ? i + 5552 : count; i < end; i++) {
            a += data[i];
            b += a;
        }
        a %= 65521;
        b %= 65521;
    }
    return b << 16 | a;
}

void stb_pack(struct bytes *to, const void *data, size_t count)
{
    int length = 0;
    /* it only reads them */
    unsigned char *packed =
        stbi_zlib_compress((unsigned char *)(size_t)data, (int)count, &length, QUALITY);
    if (packed == NULL) {
        /* more than there is: the program ends as it does wherever memory is used up */
        arena_array(to->arena, SIZE_MAX, 2);
    }
    bytes_put(to, packed, (size_t)length);
    free(packed);
}

void stb_store(struct bytes *to, const void *data, size_t count)
{
    enum { BLOCK_MOST = 65535, BLOCK_HEAD = 5 };
    const unsigned char *from = data;
    bytes_room(to, count + BLOCK_HEAD * (count / BLOCK_MOST + 1) + 6);
    bytes_put_big(to, 0x7801, 2);
    size_t done = 0;
    do {
        const size_t left = count - done, length = left < BLOCK_MOST ? left : BLOCK_MOST;
        bytes_put_little(to, length == left ? 1 : 0, 1); /* the last one */
        bytes_put_little(to, length | (uint64_t)(~length & 0xffff) << 16, 4);
        bytes_put(to, from + done, length);
        done += length;
    } while (done < count);
    bytes_put_big(to, adler32(from, count), 4);
}

bool stb_unpack(struct text packed, unsigned char *data, size_t count)
{
    if (packed.length < 6 || packed.length > INT_MAX || count > INT_MAX ||
        stbi_zlib_decode_buffer((char *)data, (int)count, packed.start, (int)packed.length) !=
            (int)count) {
        return false;
    }
    const unsigned char *end = (const unsigned char *)packed.start + packed.length;
    return bytes_big(end - 4, 4) == adler32(data, count);
}

bool stb_decode(struct text file, int bits, struct arena *arena, struct stb_picture *picture)
{
    const stbi_uc *data = (const stbi_uc *)file.start;
    int width = 0, height = 0, channels = 0;
    void *decoded = NULL;
    if (file.length <= INT_MAX) {
        decoded = bits == 16 ? (void *)stbi_load_16_from_memory(data, (int)file.length, &width,
                                                                &height, &channels, 0)
                             : (void *)stbi_load_from_memory(data, (int)file.length, &width,
                                                             &height, &channels, 0);
    }
    if (decoded == NULL) {
        return false;
    }
    const size_t count = (size_t)width * (size_t)height * (size_t)channels;
    uint16_t *values = ARENA_ARRAY(arena, count, uint16_t);
    for (size_t i = 0; i < count; i++) {
        values[i] = bits == 16 ? ((const uint16_t *)decoded)[i] : ((const stbi_uc *)decoded)[i];
    }
    free(decoded);
    *picture = (struct stb_picture){(size_t)width, (size_t)height, (size_t)channels, values};
    return true;
}
