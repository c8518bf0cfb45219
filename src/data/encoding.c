/* data/encoding.c - text files of other programs in any encoding, made UTF-8. */
/* SPDX-License-Identifier: MIT */
#include "data/encoding.h"

#include <stdint.h>
#include <string.h>

enum scheme { UTF_8, UTF_16_LITTLE, UTF_16_BIG, WINDOWS_1252 };

/* 0x80 .. 0x9f of Windows-1252; 0 = not assigned, kept as the control character. */
static const uint16_t windows_1252[32] = {
    0x20ac, 0,      0x201a, 0x0192, 0x201e, 0x2026, 0x2020, 0x2021, 0x02c6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017d, 0,      0,      0x2018, 0x2019, 0x201c, 0x201d, 0x2022,
    0x2013, 0x2014, 0x02dc, 0x2122, 0x0161, 0x203a, 0x0153, 0,      0x017e, 0x0178};

static unsigned byte_at(struct text content, size_t at)
{
    return (unsigned char)content.start[at];
}

static bool is_utf8(struct text content)
{
    for (size_t at = 0; at < content.length;) {
        size_t length = text_utf8_length(content.start + at, content.length - at);
        if (length == 0) {
            return false;
        }
        at += length;
    }
    return true;
}

/*
 * Keywords and numbers have a zero byte in every character of UTF-16; in a title of another script
 * the other byte may be zero here and there (U+3000, a wide blank).
 */
static bool zeros_dominate(struct text content, size_t first)
{
    size_t zeros = 0, others = 0, sample = content.length < 1024 ? content.length : 1024;
    for (size_t at = 0; at + 1 < sample; at += 2) {
        zeros += byte_at(content, at + first) == 0;
        others += byte_at(content, at + 1 - first) == 0;
    }
    return sample >= 4 && zeros > sample / 4 && others <= zeros / 8;
}

/* Tells the scheme and cuts off the mark. */
static enum scheme scheme_of(struct text *content)
{
    static const struct {
        const char *mark;
        size_t length;
        enum scheme scheme;
    } marks[] = {
        {"\xef\xbb\xbf", 3, UTF_8}, {"\xff\xfe", 2, UTF_16_LITTLE}, {"\xfe\xff", 2, UTF_16_BIG}};
    for (size_t i = 0; i < sizeof marks / sizeof marks[0]; i++) {
        size_t length = marks[i].length;
        if (content->length >= length && memcmp(content->start, marks[i].mark, length) == 0) {
            *content = (struct text){content->start + length, content->length - length};
            return marks[i].scheme == UTF_8 && !is_utf8(*content) ? WINDOWS_1252 : marks[i].scheme;
        }
    }
    if (zeros_dominate(*content, 1)) {
        return UTF_16_LITTLE;
    }
    if (zeros_dominate(*content, 0)) {
        return UTF_16_BIG;
    }
    return is_utf8(*content) ? UTF_8 : WINDOWS_1252;
}

static char *put_utf8(char *to, unsigned code)
{
    if (code < 0x80) {
        *to++ = (char)code;
        return to;
    }
    int rest = 1 + (code >= 0x800) + (code >= 0x10000);
    *to++ = (char)((0xf80u >> rest & 0xff) | code >> 6 * rest);
    while (rest-- > 0) {
        *to++ = (char)(0x80 | (code >> 6 * rest & 0x3f));
    }
    return to;
}

/* One character at *at, which moves on. False: half a character. */
static bool next_code(struct text content, enum scheme scheme, size_t *at, unsigned *code)
{
    if (scheme == WINDOWS_1252 || scheme == UTF_8) {
        *code = byte_at(content, (*at)++);
        bool special = scheme == WINDOWS_1252 && *code >= 0x80 && *code < 0xa0;
        *code = special && windows_1252[*code - 0x80] != 0 ? windows_1252[*code - 0x80] : *code;
        return true;
    }
    size_t low = scheme == UTF_16_LITTLE ? 0 : 1;
    unsigned unit[2] = {0, 0};
    int units = 0;
    do {
        if (*at + 2 > content.length) {
            return false;
        }
        unit[units++] = byte_at(content, *at + low) | byte_at(content, *at + 1 - low) << 8;
        *at += 2;
    } while (units == 1 && (unit[0] & 0xfc00) == 0xd800);
    *code = unit[0];
    if (units == 2) {
        *code = 0x10000 + ((unit[0] & 0x3ff) << 10) + (unit[1] & 0x3ff);
        return (unit[1] & 0xfc00) == 0xdc00;
    }
    return (unit[0] & 0xfc00) != 0xdc00;
}

bool encoding_to_utf8(const char *source, struct text content, struct arena *arena,
                      struct text *text, struct error *error)
{
    size_t whole = content.length;
    enum scheme scheme = scheme_of(&content);
    size_t mark = whole - content.length;
    if (content.length == 0 ||
        (scheme == UTF_8 && (memchr(content.start, '\r', content.length) == NULL &&
                             memchr(content.start, '\0', content.length) == NULL))) {
        *text = content;
        return true;
    }
    char *data = arena_array(arena, 3 * content.length + 4, 1), *to = data;
    bool after_return = false;
    for (size_t at = 0; at < content.length;) {
        size_t here = at;
        unsigned code;
        bool whole_character = next_code(content, scheme, &at, &code);
        if (!whole_character || code == 0) {
            return fail_in(error, source, 0, 0, "not text: %s at byte %zu",
                           whole_character ? "a NUL character" : "half a UTF-16 character",
                           mark + here);
        }
        bool skip = code == '\n' && after_return;
        after_return = code == '\r';
        if (skip) {
            continue;
        }
        if (scheme == UTF_8) {
            *to++ = code == '\r' ? '\n' : (char)code; /* its bytes are copied one by one */
        } else {
            to = put_utf8(to, code == '\r' ? '\n' : code);
        }
    }
    *text = text_between(data, to);
    return true;
}
