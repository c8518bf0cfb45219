/* base/base64.c - bytes as letters: base 64. */
/* SPDX-License-Identifier: MIT */
#include "base/base64.h"

#include <string.h>

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void base64_letters(struct text bytes, size_t at, char four[4])
{
    unsigned group = 0;
    for (size_t k = 0; k < 3; k++) {
        const bool is_inside = at + k < bytes.length;
        group = group << 8 | (is_inside ? (unsigned)(unsigned char)bytes.start[at + k] : 0U);
    }
    for (size_t k = 0; k < 4; k++) {
        four[k] = at + k > bytes.length ? '=' : digits[group >> (18 - 6 * k) & 63];
    }
}

struct text base64_bytes(struct text letters, struct arena *arena)
{
    char *bytes = arena_buffer(arena, letters.length + 1);
    size_t length = 0;
    unsigned group = 0, bits = 0;
    for (size_t i = 0; i < letters.length; i++) {
        const char *at = letters.start[i] != '\0' ? strchr(digits, letters.start[i]) : NULL;
        if (at == NULL) {
            continue;
        }
        group = (group << 6 | (unsigned)(at - digits)) & 0xffffff;
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes[length++] = (char)(group >> bits & 0xff);
        }
    }
    return (struct text){bytes, length};
}
