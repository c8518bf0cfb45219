/* base/text.c - spans of characters: compare, trim, split, find the nearest word. */
/* SPDX-License-Identifier: MIT */
#include "base/text.h"

#include <string.h>

enum { LONGEST_WORD = 63 };

struct text text_of(const char *string)
{
    return (struct text){string, strlen(string)};
}

struct text text_between(const char *start, const char *end)
{
    return (struct text){start, (size_t)(end - start)};
}

static char text_lower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c - 'A' + 'a') : c;
}

bool text_equal(struct text a, const char *b)
{
    size_t length = strlen(b);
    return a.length == length && memcmp(a.start, b, length) == 0;
}

bool text_identical(struct text a, struct text b)
{
    return a.length == b.length && memcmp(a.start, b.start, a.length) == 0;
}

int text_order(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

bool text_same(struct text a, const char *b)
{
    size_t i = 0;
    while (i < a.length && b[i] != '\0' && text_lower(a.start[i]) == text_lower(b[i])) {
        i++;
    }
    return i == a.length && b[i] == '\0';
}

/* The next character that counts in a name, in lower case; 0 at the end. */
static char next_letter(struct text *rest)
{
    while (rest->length > 0 &&
           (rest->start[0] == ' ' || rest->start[0] == '-' || rest->start[0] == '_')) {
        rest->start++;
        rest->length--;
    }
    if (rest->length == 0) {
        return '\0';
    }
    rest->length--;
    return text_lower(*rest->start++);
}

bool text_same_name(struct text a, struct text b)
{
    char c, d;
    do {
        c = next_letter(&a);
        d = next_letter(&b);
    } while (c == d && c != '\0');
    return c == d;
}

size_t text_shared_name(struct text a, struct text b)
{
    size_t count = 0;
    for (char c = next_letter(&a); c != '\0' && c == next_letter(&b); c = next_letter(&a)) {
        count++;
    }
    return count;
}

bool text_contains_name(struct text whole, struct text part)
{
    bool found = false;
    for (size_t i = 0; i <= whole.length && !found; i++) {
        /* does what begins here begin with the letters of the part? */
        struct text rest = {whole.start + i, whole.length - i}, letters = part;
        char wanted;
        do {
            wanted = next_letter(&letters);
        } while (wanted != '\0' && next_letter(&rest) == wanted);
        found = wanted == '\0';
    }
    return found;
}

static bool text_is_blank(char c)
{
    return c == ' ' || c == '\t';
}

struct text text_behind(struct text text, const char *begin)
{
    size_t length = strlen(begin);
    bool begins = text.length > length && memcmp(text.start, begin, length) == 0;
    return begins ? (struct text){text.start + length, text.length - length}
                  : (struct text){NULL, 0};
}

struct text text_trim(struct text text)
{
    while (text.length > 0 && text_is_blank(text.start[0])) {
        text.start++;
        text.length--;
    }
    while (text.length > 0 && text_is_blank(text.start[text.length - 1])) {
        text.length--;
    }
    return text;
}

struct text text_cut(struct text *rest, char separator)
{
    struct text all = *rest;
    const char *at = all.length > 0 ? memchr(all.start, separator, all.length) : NULL;
    if (at == NULL) {
        *rest = (struct text){NULL, 0};
        return all;
    }
    *rest = text_between(at + 1, all.start + all.length);
    return text_between(all.start, at);
}

bool text_lists(const char *words, struct text word)
{
    struct text rest = text_of(words != NULL ? words : "");
    bool found = false;
    while (rest.length > 0 && !found) {
        found = text_identical(text_cut(&rest, ' '), word);
    }
    return found;
}

bool text_lists_name(const char *names, struct text name)
{
    struct text rest = text_of(names);
    bool found = false;
    while (rest.length > 0 && !found) {
        found = text_same_name(name, text_cut(&rest, ' '));
    }
    return found;
}

struct text text_cut_range(struct text *rest)
{
    const struct text whole = *rest;
    for (size_t i = 0; i + 1 < whole.length; i++) {
        if (whole.start[i] == '.' && whole.start[i + 1] == '.') {
            *rest = (struct text){whole.start + i + 2, whole.length - i - 2};
            return (struct text){whole.start, i};
        }
    }
    return whole;
}

static int smaller(int a, int b)
{
    return a < b ? a : b;
}

int text_distance(struct text a, struct text b, int limit)
{
    if (a.length > LONGEST_WORD || b.length > LONGEST_WORD) {
        return limit + 1;
    }
    /* three rows of the dynamic programme: two above, above, this one */
    int rows[3][LONGEST_WORD + 1];
    for (size_t j = 0; j <= b.length; j++) {
        rows[0][j] = (int)j;
    }
    for (size_t i = 1; i <= a.length; i++) {
        int *here = rows[i % 3], *above = rows[(i + 2) % 3], *two_above = rows[(i + 1) % 3];
        here[0] = (int)i;
        for (size_t j = 1; j <= b.length; j++) {
            char c = text_lower(a.start[i - 1]), d = text_lower(b.start[j - 1]);
            int best = smaller(above[j], here[j - 1]) + 1;
            best = smaller(best, above[j - 1] + (c != d));
            if (i > 1 && j > 1 && c == text_lower(b.start[j - 2]) &&
                d == text_lower(a.start[i - 2])) {
                best = smaller(best, two_above[j - 2] + 1);
            }
            here[j] = best;
        }
    }
    return smaller(rows[a.length % 3][b.length], limit + 1);
}

void nearest_offer(struct nearest *nearest, struct text candidate)
{
    int limit = (int)(nearest->typed.length < 30 ? nearest->typed.length : 30) / 3;
    if (limit == 0) {
        limit = 1;
    }
    int distance = text_distance(nearest->typed, candidate, limit);
    /* the beginning of a word is as good as one slip */
    if (nearest->typed.length >= 3 && nearest->typed.length < candidate.length &&
        text_distance(nearest->typed, (struct text){candidate.start, nearest->typed.length}, 0) ==
            0) {
        distance = 1;
    }
    /* a word that merely shares a letter count with a very short one is no suggestion */
    if (distance > limit || (size_t)distance >= candidate.length) {
        return;
    }
    if (nearest->best.start == NULL || distance < nearest->distance) {
        nearest->best = candidate;
        nearest->distance = distance;
    }
}

int text_hex_digit(char c)
{
    if (c >= '0' && c <= '9') {
        return c - '0';
    }
    if (c >= 'a' && c <= 'f') {
        return c - 'a' + 10;
    }
    if (c >= 'A' && c <= 'F') {
        return c - 'A' + 10;
    }
    return -1;
}

size_t text_utf8_length(const char *start, size_t room)
{
    /* Unicode, table 3-7: well-formed sequences; bytes from the third on are 80 to bf */
    static const struct {
        unsigned char first, last, second_least, second_most, length;
    } forms[] = {{0xc2, 0xdf, 0x80, 0xbf, 2}, {0xe0, 0xe0, 0xa0, 0xbf, 3},
                 {0xe1, 0xec, 0x80, 0xbf, 3}, {0xed, 0xed, 0x80, 0x9f, 3},
                 {0xee, 0xef, 0x80, 0xbf, 3}, {0xf0, 0xf0, 0x90, 0xbf, 4},
                 {0xf1, 0xf3, 0x80, 0xbf, 4}, {0xf4, 0xf4, 0x80, 0x8f, 4}};
    const unsigned char *at = (const unsigned char *)start;
    size_t form = 0, forms_count = sizeof forms / sizeof forms[0];
    if (room == 0 || at[0] < 0x80) {
        return room > 0;
    }
    while (form < forms_count && at[0] > forms[form].last) {
        form++;
    }
    if (form == forms_count || at[0] < forms[form].first || forms[form].length > room ||
        at[1] < forms[form].second_least || at[1] > forms[form].second_most) {
        return 0;
    }
    for (size_t i = 2; i < forms[form].length; i++) {
        if ((at[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    return forms[form].length;
}

size_t text_column(struct text line, size_t byte)
{
    size_t column = 1;
    size_t at = 0;
    for (; at < byte && at < line.length; column++) {
        const size_t length = text_utf8_length(line.start + at, line.length - at);
        at += length > 0 ? length : 1;
    }
    return at < byte ? column + (byte - at) : column;
}

/* The code of a well-formed sequence. */
static unsigned long text_code_of(const char *start, size_t length)
{
    const unsigned char *byte = (const unsigned char *)start;
    unsigned long code = length < 2 ? byte[0] : byte[0] & (0x7fu >> length);
    for (size_t i = 1; i < length; i++) {
        code = code << 6 | (byte[i] & 0x3f);
    }
    return code;
}

size_t text_cells(struct text text)
{
    static const struct {
        unsigned long first, last;
        size_t cells;
    } ranges[] = {
        {0x300, 0x36f, 0},   {0x1100, 0x115f, 2},   {0x1ab0, 0x1aff, 0},   {0x1dc0, 0x1dff, 0},
        {0x200b, 0x200f, 0}, {0x20d0, 0x20ff, 0},   {0x2e80, 0x303e, 2},   {0x3041, 0x3098, 2},
        {0x3099, 0x309a, 0}, {0x309b, 0xa4cf, 2},   {0xac00, 0xd7a3, 2},   {0xf900, 0xfaff, 2},
        {0xfe00, 0xfe0f, 0}, {0xfe20, 0xfe2f, 0},   {0xfe30, 0xfe6f, 2},   {0xff00, 0xff60, 2},
        {0xffe0, 0xffe6, 2}, {0x1f300, 0x1f64f, 2}, {0x1f900, 0x1f9ff, 2}, {0x20000, 0x3fffd, 2}};
    size_t cells = 0;
    for (size_t at = 0; at < text.length;) {
        const size_t length = text_utf8_length(text.start + at, text.length - at);
        const unsigned long code = length > 1 ? text_code_of(text.start + at, length) : 0;
        size_t own = 1;
        for (size_t i = 0; i < sizeof ranges / sizeof ranges[0] && code >= ranges[i].first; i++) {
            own = code <= ranges[i].last ? ranges[i].cells : own;
        }
        cells += own;
        at += length > 0 ? length : 1;
    }
    return cells;
}

/* Marks and embeddings that turn the direction of writing, and separators of lines (Unicode 9). */
static bool text_turns(const unsigned char *at, size_t length)
{
    if (length == 2) {
        return at[0] == 0xd8 && at[1] == 0x9c; /* U+061C */
    }
    return length == 3 && at[0] == 0xe2 &&
           ((at[1] == 0x80 && (at[2] == 0x8e || at[2] == 0x8f)) || /* U+200E, U+200F */
            (at[1] == 0x80 && at[2] >= 0xa8 && at[2] <= 0xae) ||   /* U+2028 to U+202E */
            (at[1] == 0x81 && at[2] >= 0xa6 && at[2] <= 0xa9));    /* U+2066 to U+2069 */
}

size_t text_unprintable(const char *start, size_t room)
{
    const unsigned char *at = (const unsigned char *)start;
    if (room == 0 || (at[0] >= 0x20 && at[0] < 0x7f)) {
        return 0;
    }
    if (at[0] < 0x20 || at[0] == 0x7f) {
        return 1;
    }
    size_t length = text_utf8_length(start, room);
    if (length == 0) {
        return at[0] < 0xa0;
    }
    return (at[0] == 0xc2 && at[1] < 0xa0) || text_turns(at, length) ? length : 0;
}

void text_make_printable(char *string, const char *kept)
{
    const char *end = string + strlen(string);
    while (string < end) {
        if (*string >= 0x20 && *string < 0x7f) {
            string++; /* as nearly all */
            continue;
        }
        size_t bad = text_unprintable(string, (size_t)(end - string));
        size_t good = bad > 0 ? 0 : text_utf8_length(string, (size_t)(end - string));
        if (bad == 0 || strchr(kept, *string) != NULL) {
            string += good > 0 ? good : 1;
            continue;
        }
        memset(string, '?', bad);
        string += bad;
    }
}

struct text text_xml(struct text text, size_t *step)
{
    /* of a character that XML can hold (XML 1.0, production 2), else 0 */
    const unsigned char *byte = (const unsigned char *)text.start;
    size_t bytes = text_utf8_length(text.start, text.length);
    if (text.length > 0 && byte[0] < 0x20) {
        bytes = byte[0] == '\t' || byte[0] == '\n';
    } else if (bytes == 3 && byte[0] == 0xef && byte[1] == 0xbf && byte[2] > 0xbd) {
        bytes = 0; /* reserved */
    }
    *step = bytes > 0 ? bytes : 1;
    switch (*text.start) {
    case '&':
        return text_of("&amp;");
    case '<':
        return text_of("&lt;");
    case '>':
        return text_of("&gt;");
    case '"':
        return text_of("&quot;");
    default:
        return bytes > 0 ? (struct text){text.start, bytes} : text_of("?");
    }
}
