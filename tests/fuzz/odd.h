/* tests/fuzz/odd.h - numbers out of the fuzzer's bytes, and texts made of them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_FUZZ_ODD_H
#define LENSCALC_TESTS_FUZZ_ODD_H

#include "fuzz.h"

#include <math.h>
#include <stdarg.h>

enum { CHUNK = 32, PAGE = 16384 }; /* bytes of a surface or thing; of a text, at most */

/* Bytes that are left of a chunk; behind its end there are zeros. */
struct bytes {
    const uint8_t *at, *end;
};

static inline unsigned bytes_next(struct bytes *bytes)
{
    return bytes->at < bytes->end ? *bytes->at++ : 0;
}

/* One of so many. */
static inline unsigned bytes_pick(struct bytes *bytes, unsigned count)
{
    return bytes_next(bytes) % count;
}

/* Between two positive amounts, evenly in their logarithms. */
static inline double bytes_amount(struct bytes *bytes, double least, double most)
{
    const unsigned high = bytes_next(bytes), step = high << 8 | bytes_next(bytes);
    return least * pow(most / least, step / 65535.0);
}

static inline double bytes_signed(struct bytes *bytes, double least, double most)
{
    const unsigned sign = bytes_pick(bytes, 5);
    return sign == 4 ? 0 : (sign % 2 == 0 ? 1 : -1) * bytes_amount(bytes, least, most);
}

/* The same, of two numbers: their order is that of the bytes. */
static inline void bytes_pair(struct bytes *bytes, double least, double most, double pair[2])
{
    pair[0] = bytes_signed(bytes, least, most);
    pair[1] = bytes_signed(bytes, least, most);
}

/* The next chunk of the input. */
static inline struct bytes bytes_chunk(struct bytes *input)
{
    const size_t left = (size_t)(input->end - input->at), size = left < CHUNK ? left : CHUNK;
    const struct bytes chunk = {input->at, input->at + size};
    input->at += size;
    return chunk;
}

/* A text that grows. */
struct page {
    char text[PAGE];
    size_t length;
};

__attribute__((format(printf, 2, 3))) static inline void page_add(struct page *page,
                                                                  const char *form, ...)
{
    va_list values;
    va_start(values, form);
    const int length = vsnprintf(page->text + page->length, PAGE - page->length, form, values);
    va_end(values);
    REQUIRE(length >= 0 && (size_t)length < PAGE - page->length);
    page->length += (size_t)length;
}

#endif
