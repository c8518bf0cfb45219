/* cli/batch/batch_json.c - flat JSON objects, one a line, as inputs. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/batch.h"

#include "base/json_read.h"

#include <math.h>
#include <string.h>

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
    json_skip_blanks(json);
    if (json->at < json->end && (*json->at == '{' || *json->at == '[')) {
        return json_fail(json, "objects and arrays cannot be values of a row");
    }
    return json_scalar(json, value);
}

static bool batch_json_start(struct json *json, const struct batch *batch, struct text line,
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
    if (!batch_json_start(&json, batch, line, error)) {
        return error_locate(error, batch->source, batch->line, (size_t)error->column);
    }
    while (next_pair(&json, first, &key, &value)) {
        first = false;
        key.start = arena_string(batch->arena, key.start, key.length);
        if (!batch_add_column(batch, key, value.at, error)) {
            return false;
        }
    }
    if (error->code != ERROR_NONE) {
        return error_locate(error, batch->source, batch->line, (size_t)error->column);
    }
    return true;
}

/* One value of a row; `guess` is where among the columns its key may be. */
static bool take_pair(struct batch *batch, struct text key, size_t guess,
                      const struct json_value *value, void *input, struct error *error)
{
    /* the column of a key: usually the one after the last */
    struct batch_column *column = NULL;
    for (size_t i = 0; i < batch->column_count && column == NULL; i++) {
        struct batch_column *other = &batch->columns[(guess + i) % batch->column_count];
        if (text_identical(other->name, key)) {
            column = other;
        }
    }
    if (column == NULL) {
        column = batch_add_late(batch, key, error);
    }
    if (column == NULL) {
        error->column = (int)value->at;
        return false;
    }
    const bool is_twice = column->row == batch->objects;
    column->row = batch->objects;
    if (is_twice) {
        fail(error, ERROR_DATA, "the key '%.*s' appears twice", text_shown(key), key.start);
        error->column = (int)value->at;
        return false;
    }
    if (column->is_ignored) {
        return true;
    }
    if (column->option == NULL) {
        batch->passed[column->passed] = (struct passed_cell){
            .text = value->kind == JSON_NULL ? (struct text){"", 0} : value->text,
            .is_bare = value->kind != JSON_STRING};
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

/*
 * After a bad value the others are still looked at: what is passed through belongs to its row even
 * if that fails.
 */
bool batch_json_row(struct batch *batch, struct text line, void *input, struct error *error)
{
    struct json json;
    struct text key;
    struct json_value value;
    struct error later;
    bool good = true;
    size_t pairs = 0;
    batch->objects++;
    /* every member as it is without the row; of what is passed through, first keys are null */
    for (size_t i = 0; i < batch->column_count; i++) {
        const struct batch_column *column = &batch->columns[i];
        const struct option *option = column->option;
        if (option != NULL) {
            batch_reset_member(batch, option, input);
        } else if (!column->is_ignored && column->is_late) {
            batch->passed[column->passed].text = (struct text){NULL, 0};
        }
    }
    if (!batch_json_start(&json, batch, line, error)) {
        return false;
    }
    for (; next_pair(&json, pairs == 0, &key, &value); pairs++) {
        if (!take_pair(batch, key, pairs, &value, input, json.error)) {
            json.error = &later;
            good = false;
        }
    }
    return good && error->code == ERROR_NONE;
}
