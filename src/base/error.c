/* base/error.c - one error, carried up by return value. */
/* SPDX-License-Identifier: MIT */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* What was typed or read goes to a terminal: no control characters. */
static void make_printable(char *string)
{
    for (; *string != '\0'; string++) {
        unsigned char c = (unsigned char)*string;
        *string = c < 0x20 || c == 0x7f ? '?' : *string;
    }
}

static void start(struct error *error, enum error_code code, const char *format, va_list arguments)
{
    error->code = code;
    error->line = 0;
    error->column = 0;
    error->caret = 0;
    error->source[0] = '\0';
    error->text[0] = '\0';
    error->hint[0] = '\0';
    vsnprintf(error->message, sizeof error->message, format, arguments);
    make_printable(error->message);
}

bool fail(struct error *error, enum error_code code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    start(error, code, format, arguments);
    va_end(arguments);
    return false;
}

/* A window of the text that contains the caret and fits. */
static void set_excerpt(struct error *error, const char *text, size_t length, size_t caret)
{
    size_t room = sizeof error->text - 1;
    size_t from = caret > room / 2 && length > room ? caret - room / 2 : 0;
    size_t kept = length - from < room ? length - from : room;
    for (size_t i = 0; i < kept; i++) {
        /* a NUL would end the text before the caret */
        error->text[i] = text[from + i] != '\0' ? text[from + i] : '?';
    }
    error->text[kept] = '\0';
    make_printable(error->text);
    error->caret = (int)(caret - from);
}

bool fail_at(struct error *error, enum error_code code, struct text text, size_t caret,
             const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    start(error, code, format, arguments);
    va_end(arguments);
    if (caret > text.length + 1) {
        caret = text.length + 1;
    }
    set_excerpt(error, text.start, text.length, caret);
    return false;
}

bool error_locate(struct error *error, const char *source, long line, size_t column)
{
    snprintf(error->source, sizeof error->source, "%s", source);
    make_printable(error->source);
    error->line = line;
    error->column = column < 1000000000 ? (int)column : 1000000000;
    return false;
}

bool error_hint(struct error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(error->hint, sizeof error->hint, format, arguments);
    va_end(arguments);
    make_printable(error->hint);
    return false;
}

bool error_prefix(struct error *error, const char *format, ...)
{
    char before[sizeof error->message];
    char after[sizeof error->message];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(before, sizeof before, format, arguments);
    va_end(arguments);
    make_printable(before);
    snprintf(after, sizeof after, "%s", error->message);
    size_t used = strlen(before);
    snprintf(error->message, sizeof error->message, "%s", before);
    snprintf(error->message + used, sizeof error->message - used, "%s", after);
    return false;
}
