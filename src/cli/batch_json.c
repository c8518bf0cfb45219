/* cli/batch_json.c - flat JSON objects, one a line, as inputs. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch.h"

#include "base/json_read.h"

#include <math.h>
#include <string.h>

static bool read_value(struct json *json, struct json_value *value)
{
    json_skip_blanks(json);
    if (json->at < json->end && (*json->at == '{' || *json->at == '[')) {
        return json_fail(json, "objects and arrays cannot be values of a row");
    }
    return json_scalar(json, value);
}

/* The next "key": value; false at the end of the object or on failure. */
static bool next_pair(struct json *json, bool first, struct text *key, struct json_value *value)
{
    json->error->code = ERROR_NONE;
    if (json_take(json, '}')) {
        json_skip_blanks(json);
        return json->at == json->end ? false : json_fail(json, "text follows the object");
    }
    if (!first && !json_take(json, ',')) {
        return json_fail(json, "expected ',' or '}' here");
    }
    if (!json_string(json, key)) {
        return false;
    }
    if (!json_take(json, ':')) {
        return json_fail(json, "expected ':' here");
    }
    return read_value(json, value);
}

static bool start(struct json *json, const struct batch *batch, struct text line,
                  struct error *error)
{
    *json = json_open(line, batch->reader->arena, error);
    if (memchr(line.start, '\0', line.length) != NULL) {
        return json_fail(json, "NUL bytes: this is not UTF-8 text");
    }
    return json_take(json, '{') || json_fail(json, "expected a JSON object, {...}, on each line");
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
        if (text_identical(column->name, key)) {
            return column;
        }
    }
    return NULL;
}

static bool set_value(struct batch *batch, struct batch_column *column,
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
            batch_reset_member(batch, option, input);
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
    batch->objects++;
    if (!start(&json, batch, line, error)) {
        return false;
    }
    reset(batch, input);
    for (; next_pair(&json, pairs == 0, &key, &value); pairs++) {
        struct batch_column *column = column_of(batch, key, pairs);
        if (column != NULL && column->row == batch->objects) {
            fail(error, ERROR_DATA, "the key '%.*s' appears twice", text_shown(key), key.start);
            error->column = (int)value.at;
            return false;
        }
        if (column == NULL) {
            fail(error, ERROR_DATA, "the first row has no key '%.*s'", text_shown(key), key.start);
            error->column = (int)value.at;
            return false;
        }
        column->row = batch->objects;
        if (!set_value(batch, column, &value, input, error)) {
            return false;
        }
    }
    return error->code == ERROR_NONE;
}
