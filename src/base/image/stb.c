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

/* The checksum of zlib, of what follows `sum`. */
static uint32_t adler32(uint32_t sum, const unsigned char *data, size_t count)
{
    uint32_t a = sum & 0xffff, b = sum >> 16;
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

/* Bits of a deflate stream, the least first. */
struct bit_writer {
    struct bytes *to;
    uint64_t bits;
    unsigned count;
};

static void put_bits(struct bit_writer *writer, uint64_t bits, unsigned count)
{
    writer->bits |= bits << writer->count;
    writer->count += count;
    while (writer->count >= 8) {
        bytes_put_little(writer->to, writer->bits & 0xff, 1);
        writer->bits >>= 8;
        writer->count -= 8;
    }
}

void stb_store(struct bytes *to, const void *data, size_t rows, size_t stride)
{
    const unsigned char *from = data;
    struct bit_writer writer = {.to = to};
    uint32_t sum = 1;
    bytes_put_big(to, 0x7801, 2);
    for (size_t i = 0, next; i < rows; i = next) {
        const bool is_zero = bytes_are_zero(from + i * stride, stride);
        next = i + 1;
        while (next < rows && bytes_are_zero(from + next * stride, stride) == is_zero) {
            next++;
        }
        const size_t count = (next - i) * stride;
        if (is_zero) {
            /* a block of fixed codes (RFC 1951, 3.2.6): a zero, and copies of the one before it */
            enum { COPIED_MOST = 258 };
            put_bits(&writer, 1U << 1, 3);
            for (size_t left = count; left > 0;) {
                const bool is_copied = left < count && left >= COPIED_MOST;
                put_bits(&writer, is_copied ? 0xa3 : 0x0c, is_copied ? 8 + 5 : 8);
                left -= is_copied ? COPIED_MOST : 1;
            }
            put_bits(&writer, 0, 7);
            const uint64_t a = sum & 0xffff, b = sum >> 16;
            sum = (uint32_t)((b + count % 65521 * a) % 65521 << 16 | a);
        } else {
            enum { BLOCK_MOST = 65535 };
            for (size_t done = 0, length; done < count; done += length) {
                length = count - done < BLOCK_MOST ? count - done : BLOCK_MOST;
                put_bits(&writer, 0, 3);
                put_bits(&writer, 0, -writer.count & 7);
                bytes_put_little(writer.to, length | (uint64_t)(~length & 0xffff) << 16, 4);
                bytes_put(writer.to, from + i * stride + done, length);
            }
            sum = adler32(sum, from + i * stride, count);
        }
    }
    put_bits(&writer, 1U | 1U << 1, 3); /* the last block, empty */
    put_bits(&writer, 0, 7);
    put_bits(&writer, 0, -writer.count & 7);
    bytes_put_big(to, sum, 4);
}

bool stb_unpack(struct text packed, unsigned char *data, size_t count)
{
    if (packed.length < 6 || packed.length > INT_MAX || count > INT_MAX ||
        stbi_zlib_decode_buffer((char *)data, (int)count, packed.start, (int)packed.length) !=
            (int)count) {
        return false;
    }
    const unsigned char *end = (const unsigned char *)packed.start + packed.length;
    return bytes_big(end - 4, 4) == adler32(1, data, count);
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
