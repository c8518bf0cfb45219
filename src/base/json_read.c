/* base/json_read.c - reading JSON (RFC 8259): value by value, or a whole text as a tree. */
/* SPDX-License-Identifier: MIT */
#include "base/json_read.h"

#include "base/number.h"

#include <string.h>

enum { DEEPEST = 32 };

struct json json_open(struct text text, struct arena *arena, struct error *error)
{
    /* nothing may be nowhere, from where nothing is counted */
    const char *end = text.length > 0 ? text.start + text.length : text.start;
    return (struct json){text, text.start, end, arena, error};
}

bool json_fail(struct json *json, const char *what)
{
    fail(json->error, ERROR_DATA, "%s", what);
    json->error->column = (int)(json->at - json->text.start) + 1;
    return false;
}

void json_skip_blanks(struct json *json)
{
    while (json->at < json->end &&
           (*json->at == ' ' || *json->at == '\t' || *json->at == '\r' || *json->at == '\n')) {
        json->at++;
    }
}

bool json_take(struct json *json, char c)
{
    json_skip_blanks(json);
    if (json->at < json->end && *json->at == c) {
        json->at++;
        return true;
    }
    return false;
}

/* Four hexadecimal digits; -1 if they are none. */
static long hex4(struct json *json)
{
    long code = 0;
    if (json->end - json->at < 4) {
        return -1;
    }
    for (int i = 0; i < 4; i++) {
        int digit = text_hex_digit(*json->at++);
        if (digit < 0) {
            return -1;
        }
        code = 16 * code + digit;
    }
    return code;
}

static char *write_utf8(char *to, long code)
{
    if (code < 0x80) {
        *to++ = (char)code;
        return to;
    }
    if (code < 0x800) {
        *to++ = (char)(0xc0 | code >> 6);
    } else if (code < 0x10000) {
        *to++ = (char)(0xe0 | code >> 12);
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
    } else {
        *to++ = (char)(0xf0 | code >> 18);
        *to++ = (char)(0x80 | (code >> 12 & 0x3f));
        *to++ = (char)(0x80 | (code >> 6 & 0x3f));
    }
    *to++ = (char)(0x80 | (code & 0x3f));
    return to;
}

/* What follows "\u": one or two groups of four digits. */
static bool read_unicode(struct json *json, char **to)
{
    long code = hex4(json);
    if (code >= 0xd800 && code < 0xdc00 && json->end - json->at > 6 && json->at[0] == '\\' &&
        json->at[1] == 'u') {
        json->at += 2;
        long low = hex4(json);
        code = low >= 0xdc00 && low < 0xe000 ? 0x10000 + (code - 0xd800) * 1024 + low - 0xdc00 : -1;
    }
    if (code <= 0 || (code >= 0xd800 && code < 0xe000)) {
        return json_fail(json, "a bad \\u escape");
    }
    *to = write_utf8(*to, code);
    return true;
}

static bool read_escape(struct json *json, char **to)
{
    static const char letters[] = "\"\\/bfnrt", meant[] = "\"\\/\b\f\n\r\t";
    char c = json->at < json->end ? *json->at++ : '\0';
    if (c == 'u') {
        return read_unicode(json, to);
    }
    const char *found = c != '\0' ? strchr(letters, c) : NULL;
    if (found == NULL) {
        return json_fail(json, "a bad escape in a string");
    }
    *(*to)++ = meant[found - letters];
    return true;
}

bool json_string(struct json *json, struct text *text)
{
    if (!json_take(json, '"')) {
        return json_fail(json, "expected a quoted string here");
    }
    /* where a string ends whose first quote was taken: at the next one that is not escaped */
    const char *end = json->at;
    while (end < json->end && *end != '"') {
        end += *end == '\\' && end + 1 < json->end ? 2 : 1;
    }
    char *content = arena_array(json->arena, (size_t)(end - json->at) + 1, 1), *to = content;
    while (json->at < end) {
        char c = *json->at++;
        if (c != '\\') {
            *to++ = c;
        } else if (!read_escape(json, &to)) {
            return false;
        }
    }
    if (json->at == json->end) {
        return json_fail(json, "a string is not closed");
    }
    json->at++;
    *text = text_between(content, to);
    return true;
}

static const char *skip_digits(const char *at, const char *end)
{
    while (at < end && char_is_digit(*at)) {
        at++;
    }
    return at;
}

/* A number as JSON writes it: no +, no 0 before other digits, digits on both sides of a point. */
static bool is_json_number(struct text text)
{
    const char *const end = text.start + text.length;
    const char *digits = text.start + (text.length > 0 && *text.start == '-');
    const char *at = skip_digits(digits, end);
    bool good = at > digits && (*digits != '0' || at == digits + 1);
    if (at < end && *at == '.') {
        digits = at + 1;
        at = skip_digits(digits, end);
        good = good && at > digits;
    }
    if (at < end && (*at == 'e' || *at == 'E')) {
        digits = at + 1;
        digits += digits < end && (*digits == '+' || *digits == '-');
        at = skip_digits(digits, end);
        good = good && at > digits;
    }
    return good && at == end;
}

bool json_scalar(struct json *json, struct json_value *value)
{
    json_skip_blanks(json);
    *value = (struct json_value){JSON_STRING, .at = (size_t)(json->at - json->text.start) + 1};
    if (json->at < json->end && *json->at == '"') {
        value->at++;
        return json_string(json, &value->text);
    }
    const char *from = json->at;
    while (json->at < json->end && strchr(",}]{[:\" \t\r\n", *json->at) == NULL) {
        json->at++;
    }
    value->text = text_between(from, json->at);
    value->kind = text_equal(value->text, "null") ? JSON_NULL : JSON_BARE;
    if (value->text.length == 0) {
        return json_fail(json, "a value is missing");
    }
    if (!(text_equal(value->text, "null") || text_equal(value->text, "true") ||
          text_equal(value->text, "false") || is_json_number(value->text))) {
        json->at = from;
        return json_fail(json, strchr("+-.0123456789", *from) != NULL
                                   ? "this is not a number as JSON writes it"
                                   : "this is not a JSON value: text needs quotes");
    }
    return true;
}

static bool json_read_value(struct json *json, int depth, struct json_value *value)
{
    json_skip_blanks(json);
    const char *at = json->at;
    bool object = json_take(json, '{');
    if (!object && !json_take(json, '[')) {
        return json_scalar(json, value);
    }
    if (depth >= DEEPEST) {
        return json_fail(json, "values nested more than 32 deep");
    }
    *value = (struct json_value){object ? JSON_OBJECT : JSON_ARRAY,
                                 .at = (size_t)(at - json->text.start) + 1};
    /* what stands between the brackets */
    char closing = object ? '}' : ']';
    struct json_value **next = &value->first;
    if (json_take(json, closing)) {
        return true;
    }
    do {
        struct json_value *item = ARENA_NEW(json->arena, struct json_value);
        struct text key = {NULL, 0};
        if (object && !json_string(json, &key)) {
            return false;
        }
        if (object && !json_take(json, ':')) {
            return json_fail(json, "expected ':' here");
        }
        if (!json_read_value(json, depth + 1, item)) {
            return false;
        }
        item->key = key;
        *next = item;
        next = &item->next;
        value->count++;
    } while (json_take(json, ','));
    return json_take(json, closing) ||
           json_fail(json, object ? "expected ',' or '}' here" : "expected ',' or ']' here");
}

bool json_tree(struct json *json, struct json_value *value)
{
    if (!json_read_value(json, 0, value)) {
        return false;
    }
    json_skip_blanks(json);
    return json->at == json->end || json_fail(json, "text follows the value");
}

const struct json_value *json_item(const struct json_value *object, const char *key)
{
    for (const struct json_value *item = object->first; item != NULL; item = item->next) {
        if (text_equal(item->key, key)) {
            return item;
        }
    }
    return NULL;
}
