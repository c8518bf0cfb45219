/* cli/batch_json.c - flat JSON objects, one a line, as inputs. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch.h"

#include <math.h>
#include <string.h>

/* One line while it is read. */
struct json {
    struct text line;
    const char *at, *end;
    struct arena *arena;
    struct error *error;
};

enum json_kind { JSON_STRING, JSON_BARE, JSON_NULL };

struct json_value {
    enum json_kind kind;
    struct text text;
    size_t at; /* where it starts in the line, 1-based */
};

static bool wrong(struct json *json, const char *what)
{
    fail(json->error, ERROR_DATA, "%s", what);
    json->error->column = (int)(json->at - json->line.start) + 1;
    return false;
}

static void skip_blanks(struct json *json)
{
    while (json->at < json->end && (*json->at == ' ' || *json->at == '\t' || *json->at == '\r')) {
        json->at++;
    }
}

static bool take(struct json *json, char c)
{
    skip_blanks(json);
    if (json->at < json->end && *json->at == c) {
        json->at++;
        return true;
    }
    return false;
}

static int hex_digit(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* Four hexadecimal digits; -1 if they are none. */
static long hex4(struct json *json)
{
    long code = 0;
    if (json->end - json->at < 4) {
        return -1;
    }
    for (int i = 0; i < 4; i++) {
        int digit = hex_digit(*json->at++);
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
        return wrong(json, "a bad \\u escape");
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
        return wrong(json, "a bad escape in a string");
    }
    *(*to)++ = meant[found - letters];
    return true;
}

static bool read_string(struct json *json, struct text *text)
{
    if (!take(json, '"')) {
        return wrong(json, "a string in quotes is wanted here");
    }
    char *content = arena_array(json->arena, (size_t)(json->end - json->at) + 1, 1), *to = content;
    while (json->at < json->end && *json->at != '"') {
        char c = *json->at++;
        if (c != '\\') {
            *to++ = c;
        } else if (!read_escape(json, &to)) {
            return false;
        }
    }
    if (json->at == json->end) {
        return wrong(json, "a string is not closed");
    }
    json->at++;
    *text = text_between(content, to);
    return true;
}

/* null, true, false, or a number as JSON writes it. */
static bool is_bare_value(struct text text)
{
    double ignored;
    const char *end = text.start + text.length;
    char first = *text.start;
    return text_equal(text, "null") || text_equal(text, "true") || text_equal(text, "false") ||
           (((first >= '0' && first <= '9') || first == '-') && end[-1] != 'f' &&
            number_read(text.start, end, NUMBER_UNSCALED, &ignored) == end);
}

static bool read_value(struct json *json, struct json_value *value)
{
    skip_blanks(json);
    value->at = (size_t)(json->at - json->line.start) + 1;
    value->kind = JSON_STRING;
    if (json->at < json->end && *json->at == '"') {
        value->at++;
        return read_string(json, &value->text);
    }
    const char *from = json->at;
    while (json->at < json->end && strchr(",}]{[:\" \t\r", *json->at) == NULL) {
        json->at++;
    }
    value->text = text_between(from, json->at);
    value->kind = text_equal(value->text, "null") ? JSON_NULL : JSON_BARE;
    if (value->text.length > 0 && !is_bare_value(value->text)) {
        json->at = from;
        return wrong(json, "this is no JSON value: a text wants quotes");
    }
    if (value->text.length == 0) {
        return wrong(json, json->at < json->end && (*json->at == '{' || *json->at == '[')
                               ? "objects and arrays are no values of a row"
                               : "a value is missing");
    }
    return true;
}

/* The next "key": value; false at the end of the object or on failure. */
static bool next_pair(struct json *json, bool first, struct text *key, struct json_value *value)
{
    json->error->code = ERROR_NONE;
    if (take(json, '}')) {
        skip_blanks(json);
        return json->at == json->end ? false : wrong(json, "text follows the object");
    }
    if (!first && !take(json, ',')) {
        return wrong(json, "',' or '}' is wanted here");
    }
    if (!read_string(json, key)) {
        return false;
    }
    if (!take(json, ':')) {
        return wrong(json, "':' is wanted here");
    }
    return read_value(json, value);
}

static bool start(struct json *json, const struct batch *batch, struct text line,
                  struct error *error)
{
    *json = (struct json){line, line.start, line.start + line.length, batch->reader->arena, error};
    if (memchr(line.start, '\0', line.length) != NULL) {
        return wrong(json, "NUL bytes: this is no UTF-8 text");
    }
    return take(json, '{') || wrong(json, "a JSON object, {...}, is wanted on each line");
}

bool batch_json_header(struct batch *batch, struct text line, struct error *error)
{
    struct json json;
    struct text key;
    struct json_value value;
    bool first = true;
    if (!start(&json, batch, line, error)) {
        return error_locate(error, batch->source, batch->line, (size_t)error->column);
    }
    while (next_pair(&json, first, &key, &value)) {
        first = false;
        if (!batch_add_column(batch, key, value.at, error)) {
            return false;
        }
    }
    if (error->code != ERROR_NONE) {
        return error_locate(error, batch->source, batch->line, (size_t)error->column);
    }
    return true;
}

/* The column of a key: usually the one after the last. */
static struct batch_column *column_of(const struct batch *batch, struct text key, size_t guess)
{
    for (size_t i = 0; i < batch->column_count; i++) {
        struct batch_column *column = &batch->columns[(guess + i) % batch->column_count];
        if (column->name.length == key.length &&
            memcmp(column->name.start, key.start, key.length) == 0) {
            return column;
        }
    }
    return NULL;
}

static bool set_value(struct batch *batch, const struct batch_column *column,
                      const struct json_value *value, void *input, struct error *error)
{
    if (column->is_ignored) {
        return true;
    }
    if (column->option == NULL) {
        batch->passed[column->passed] =
            value->kind == JSON_NULL ? (struct text){"", 0} : value->text;
        batch->passed_bare[column->passed] = value->kind != JSON_STRING;
        return true;
    }
    if (value->kind == JSON_NULL) {
        return true;
    }
    if (!batch_read_cell(batch, column, value->text, input, error)) {
        error->column = (int)value->at + (error->caret > 0 ? error->caret - 1 : 0);
        return false;
    }
    return true;
}

/* Every member as it is without the row. */
static void reset(struct batch *batch, void *input)
{
    for (size_t i = 0; i < batch->column_count; i++) {
        const struct option *option = batch->columns[i].option;
        if (option != NULL) {
            memcpy((char *)input + option->offset, (const char *)batch->constants + option->offset,
                   option->kind->size);
        } else if (!batch->columns[i].is_ignored) {
            batch->passed[batch->columns[i].passed] = (struct text){"", 0};
            batch->passed_bare[batch->columns[i].passed] = true;
        }
    }
}

bool batch_json_row(struct batch *batch, struct text line, void *input, struct error *error)
{
    struct json json;
    struct text key;
    struct json_value value;
    size_t pairs = 0;
    if (!start(&json, batch, line, error)) {
        return false;
    }
    reset(batch, input);
    for (; next_pair(&json, pairs == 0, &key, &value); pairs++) {
        struct batch_column *column = column_of(batch, key, pairs);
        if (column != NULL && column->row == batch->line) {
            fail(error, ERROR_DATA, "the key '%.*s' stands twice", text_shown(key), key.start);
            error->column = (int)value.at;
            return false;
        }
        if (column == NULL) {
            fail(error, ERROR_DATA, "the first row has no key '%.*s'", text_shown(key), key.start);
            error->column = (int)value.at;
            return false;
        }
        column->row = batch->line;
        if (!set_value(batch, column, &value, input, error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}
