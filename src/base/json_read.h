/* base/json_read.h - reading JSON (RFC 8259): value by value, or a whole text as a tree. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_JSON_READ_H
#define LENSCALC_BASE_JSON_READ_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* A text while it is read. */
struct json {
    struct text text;
    const char *at, *end; /* what is still to read */
    struct arena *arena;  /* for strings with escapes taken out, and for trees */
    struct error *error;
};

enum json_kind { JSON_STRING, JSON_BARE, JSON_NULL, JSON_ARRAY, JSON_OBJECT };

struct json_value {
    enum json_kind kind;
    struct text
        text;        /* of a string without its escapes; of true, false and a number as it stands */
    size_t at;       /* where it begins in the text, 1-based; of a string behind the quote */
    struct text key; /* in an object */
    struct json_value *first, *next; /* items of an array or object; null ends them */
    size_t count;                    /* of items */
};

/* Begin to read. */
struct json json_open(struct text text, struct arena *arena, struct error *error);

/* Report something wrong here: ERROR_DATA with the column in the text. Returns false. */
bool json_fail(struct json *json, const char *what);

void json_skip_blanks(struct json *json);

/* Pass over blanks and this character, if it comes next. */
bool json_take(struct json *json, char c);

/* A string in quotes. Errors: ERROR_DATA, no string, not closed, a bad escape */
bool json_string(struct json *json, struct text *text);

/* A string, number, true, false or null. Errors: ERROR_DATA, none of these */
bool json_scalar(struct json *json, struct json_value *value);

/*
 * The whole text as a tree in the arena.
 *
 * Errors    ERROR_DATA with the column in the text: no JSON, text behind the value, values nested
 *           more than 32 deep
 */
bool json_tree(struct json *json, struct json_value *value);

/* The item of an object with this key; null if there is none. */
const struct json_value *json_item(const struct json_value *object, const char *key);

#endif
