/* cli/batch/batch_rows.c - the rows of a file or pipe, one by one. */
/* SPDX-License-Identifier: MIT */
#include "cli/batch/batch.h"

#include "cli/interrupt.h"

#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LONGEST_LINE = 256 * 1024 * 1024, BLOCK = BATCH_BLOCK, BEHIND = BATCH_BEHIND };

bool batch_refill(struct batch *batch, struct error *error)
{
    size_t kept = (size_t)(batch->end - batch->at);
    if (batch->before_read != NULL && !batch->before_read(batch->waiting, error)) {
        return false;
    }
    error->code = ERROR_NONE;
    if (kept > 0) {
        memmove(batch->buffer, batch->at, kept);
    }
    if (batch->capacity - kept < BLOCK / 2) {
        if (batch->capacity >= LONGEST_LINE) {
            fail(error, ERROR_DATA, "a line is longer than 256 MiB");
            return error_locate(error, batch->source, batch->next_line, 0);
        }
        char *buffer = realloc(batch->buffer, 2 * batch->capacity + BEHIND);
        if (buffer == NULL) {
            return fail(error, ERROR_IO, "out of memory reading %s", batch->source);
        }
        batch->buffer = buffer;
        batch->capacity *= 2;
    }
    batch->at = batch->buffer;
    batch->end = batch->buffer + kept;
    ssize_t got;
    interrupt_release();
    do {
        got = read(batch->descriptor, batch->buffer + kept, batch->capacity - kept);
    } while (got < 0 && errno == EINTR && !interrupt_came());
    const int reason = errno;
    interrupt_hold();
    if (got < 0 && reason == EINTR) {
        return interrupt_fail(error);
    }
    if (got < 0) {
        return fail(error, ERROR_IO, "cannot read %s: %s", batch->source, strerror(reason));
    }
    batch->at_end = got == 0;
    batch->end += got;
    memset(batch->buffer + kept + got, 0, BEHIND);
    return got > 0;
}

/* How far a row has been looked through, from batch->at, while its end is searched for. */
struct scan {
    size_t offset;
    bool quoted;        /* inside a quoted cell, where a line break belongs to the cell */
    size_t just_closed; /* offset behind the last closing quote: a quote there opens again */
};

/* Does a quote at this offset open a cell? As cut_cell sees it: only at the cell's start. */
static bool opens_cell(const struct batch *batch, const struct scan *scan)
{
    if (scan->offset == 0 || scan->offset == scan->just_closed) {
        return true;
    }
    char before = batch->at[scan->offset - 1];
    /* before the header is read the separator is not known yet */
    const bool any = batch->columns == NULL && batch->format != BATCH_TSV;
    return before == batch->separator || (any && before == ';') ||
           (batch->format == BATCH_AUTO && before == '\t');
}

/* The line feed that ends the row, or null if it has not arrived. */
static const char *find_row_end(const struct batch *batch, struct scan *scan)
{
    const size_t length = (size_t)(batch->end - batch->at);
    /* do quotes mean anything in the row that begins here? Not in comments, not in JSON */
    char first = batch->at < batch->end ? *batch->at : '\0';
    if (batch->format == BATCH_JSONL || first == '#' ||
        (batch->format == BATCH_AUTO && first == '{')) {
        const char *from = batch->at + scan->offset;
        scan->offset = length;
        return from < batch->end ? memchr(from, '\n', (size_t)(batch->end - from)) : NULL;
    }
    for (; scan->offset < length; scan->offset++) {
        char c = batch->at[scan->offset];
        if (c == '\n' && !scan->quoted) {
            return batch->at + scan->offset;
        }
        if (c == '"' && scan->quoted) {
            scan->quoted = false;
            scan->just_closed = scan->offset + 1;
        } else if (c == '"') {
            scan->quoted = opens_cell(batch, scan);
        }
    }
    return NULL;
}

/*
 * Take the next row, without its end. A line break in a quoted cell belongs to the row. False at
 * the end of the file (ERROR_NONE) or on failure.
 */
static bool batch_rows_next_line(struct batch *batch, struct text *line, struct error *error)
{
    struct scan scan = {.just_closed = SIZE_MAX};
    const char *stop;
    error->code = ERROR_NONE;
    while ((stop = find_row_end(batch, &scan)) == NULL && !batch->at_end) {
        if (!batch_refill(batch, error) && error->code != ERROR_NONE) {
            return false;
        }
    }
    if (stop == NULL && batch->at == batch->end) {
        return false;
    }
    *line = text_between(batch->at, stop != NULL ? stop : batch->end);
    batch->at = stop != NULL ? stop + 1 : batch->end;
    return true;
}

long batch_breaks(struct text text)
{
    long breaks = 0;
    for (size_t i = 0; i < text.length; i++) {
        breaks += text.start[i] == '\n';
    }
    return breaks;
}

bool batch_next_row(struct batch *batch, struct text *line, struct error *error)
{
    while (batch_rows_next_line(batch, line, error)) {
        batch->line = batch->next_line;
        batch->next_line++;
        while (line->length > 0 && line->start[line->length - 1] == '\r') {
            line->length--;
        }
        if (line->length > 0 && line->start[0] != '#' && text_trim(*line).length > 0) {
            return true;
        }
    }
    return false;
}

/* One character ahead; false at the end of the file (ERROR_NONE) or on failure. */
static bool peek(struct batch *batch, size_t offset, char *c, struct error *error)
{
    error->code = ERROR_NONE;
    while ((size_t)(batch->end - batch->at) <= offset) {
        if (batch->at_end || (!batch_refill(batch, error) && error->code != ERROR_NONE)) {
            return false;
        }
    }
    *c = batch->at[offset];
    return true;
}

static bool wrong_array(const struct batch *batch, const char *what, struct error *error)
{
    fail(error, ERROR_DATA, "%s", what);
    return error_locate(error, batch->source, batch->next_line, 0);
}

/* Pass over what stands between the items of an array; false at its end or on failure. */
static bool skip_to_object(struct batch *batch, struct error *error)
{
    char c;
    while (peek(batch, 0, &c, error) && c != '\0' && strchr("[], \t\r\n", c) != NULL) {
        batch->next_line += c == '\n';
        batch->is_closed = batch->is_closed || c == ']';
        batch->at++;
    }
    if (error->code != ERROR_NONE) {
        return false;
    }
    if (batch->at == batch->end) {
        return !batch->is_closed && wrong_array(batch, "the array is not closed: ']'", error);
    }
    return !batch->is_closed || wrong_array(batch, "text follows the array", error);
}

bool batch_next_object(struct batch *batch, struct text *object, struct error *error)
{
    size_t length = 0;
    int depth = 0;
    bool quoted = false;
    char c;
    if (!skip_to_object(batch, error)) {
        return false;
    }
    batch->line = batch->next_line;
    while (peek(batch, length, &c, error)) {
        length++;
        if (quoted && c == '\\' && peek(batch, length, &c, error)) {
            length++;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (!quoted) {
            depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        }
        if (depth <= 0 && !quoted) {
            break;
        }
    }
    if (error->code != ERROR_NONE) {
        return false;
    }
    *object = (struct text){batch->at, length};
    batch->at += length;
    batch->next_line += batch_breaks(*object);
    return true;
}
