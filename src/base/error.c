/* base/error.c - one error, carried up by return value. */
/* SPDX-License-Identifier: MIT */
#include "base/error.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* What stands for the braces while the arguments, which may hold braces too, are put in. */
enum { OPENS = 0x0e, CLOSES = 0x0f, LONGEST_FORMAT = 1024 };

/* May this letter stand in a format's braces? A conversion for the name may. */
static bool is_of_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ' ' ||
           c == '-' || c == '%';
}

/* One printed text of an error, and the quantities in it. */
static void compose(char *text, size_t size, struct mentions *mentions, const char *format,
                    va_list arguments)
{
    char marked[LONGEST_FORMAT], whole[LONGEST_FORMAT];
    /* the format with marks in place of the braces around names */
    char *open = NULL;
    size_t i = 0;
    for (; format[i] != '\0' && i + 1 < LONGEST_FORMAT; i++) {
        marked[i] = format[i];
        if (format[i] == '{') {
            open = &marked[i];
        } else if (format[i] == '}' && open != NULL && &marked[i] > open + 1) {
            *open = OPENS;
            marked[i] = CLOSES;
            open = NULL;
        } else if (!is_of_name(format[i])) {
            open = NULL;
        }
    }
    marked[i] = '\0';
    vsnprintf(whole, sizeof whole, marked, arguments);
    /* take the marks out of the text, noting what stood between them */
    char *to = whole;
    open = NULL;
    mentions->count = 0;
    for (const char *from = whole; *from != '\0'; from++) {
        if (*from == OPENS) {
            open = to;
        } else if (*from == CLOSES) {
            if (open != NULL && mentions->count < ERROR_MENTIONS) {
                mentions->all[mentions->count++] =
                    (struct mention){(short)(open - whole), (short)(to - open)};
            }
            open = NULL;
        } else {
            *to++ = *from;
        }
    }
    *to = '\0';
    text_make_printable(whole, "");
    size_t length = strlen(whole);
    if (length >= size) {
        length = size - 1;
        while (length > 0 && (whole[length] & 0xc0) == 0x80) {
            length--; /* no half characters */
        }
    }
    whole[length] = '\0';
    memcpy(text, whole, length + 1);
}

static void error_start(struct error *error, enum error_code code, const char *format,
                        va_list arguments)
{
    error->code = code;
    error->line = 0;
    error->column = 0;
    error->caret = 0;
    error->source[0] = '\0';
    error->text[0] = '\0';
    error->hint[0] = '\0';
    error->in_hint.count = 0;
    compose(error->message, sizeof error->message, &error->in_message, format, arguments);
    error->more = NULL;
}

bool fail(struct error *error, enum error_code code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_start(error, code, format, arguments);
    va_end(arguments);
    return false;
}

/* Does this byte of UTF-8 continue a character? */
static bool is_continued(char byte)
{
    return ((unsigned char)byte & 0xc0) == 0x80;
}

/* A window of the text that contains the caret and fits. */
static void set_excerpt(struct error *error, const char *text, size_t length, size_t caret)
{
    size_t room = sizeof error->text - 1;
    size_t from = caret > room / 2 && length > room ? caret - room / 2 : 0;
    /* no half characters, which lack three bytes at the most: more are none */
    for (int i = 0; i < 3 && from > 0 && from < length && is_continued(text[from]); i++) {
        from++;
    }
    size_t kept = length - from < room ? length - from : room;
    for (int i = 0; i < 3 && from + kept < length && is_continued(text[from + kept]); i++) {
        kept--;
    }
    for (size_t i = 0; i < kept; i++) {
        /* a NUL would end the text before the caret */
        error->text[i] = text[from + i] != '\0' ? text[from + i] : '?';
    }
    error->text[kept] = '\0';
    text_make_printable(error->text, "");
    error->caret = (int)(caret - from);
}

bool fail_at(struct error *error, enum error_code code, struct text text, size_t caret,
             const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    error_start(error, code, format, arguments);
    va_end(arguments);
    if (caret > text.length + 1) {
        caret = text.length + 1;
    }
    set_excerpt(error, text.start, text.length, caret);
    return false;
}

bool error_within(struct error *error, struct text whole, struct text part)
{
    const char *from = part.length > 0 ? text_trim(part).start : part.start;
    if (error->caret > 0 && from >= whole.start && from <= whole.start + whole.length) {
        const size_t caret = (size_t)(from - whole.start) + (size_t)error->caret;
        set_excerpt(error, whole.start, whole.length,
                    caret <= whole.length + 1 ? caret : whole.length + 1);
    }
    return false;
}

bool error_locate(struct error *error, const char *source, long line, size_t column)
{
    snprintf(error->source, sizeof error->source, "%s", source);
    text_make_printable(error->source, "");
    error->line = line;
    error->column = column < 1000000000 ? (int)column : 1000000000;
    return false;
}

bool error_count_characters(struct error *error, struct text line)
{
    if (error->column > 0) {
        error->column = (int)text_column(line, (size_t)error->column - 1);
    }
    return false;
}

bool error_hint(struct error *error, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    compose(error->hint, sizeof error->hint, &error->in_hint, format, arguments);
    va_end(arguments);
    return false;
}

bool error_prefix(struct error *error, const char *format, ...)
{
    char before[sizeof error->message];
    char after[sizeof error->message];
    const struct mentions behind = error->in_message;
    struct mentions *all = &error->in_message;
    va_list arguments;
    va_start(arguments, format);
    compose(before, sizeof before, all, format, arguments);
    va_end(arguments);
    snprintf(after, sizeof after, "%s", error->message);
    size_t used = strlen(before);
    snprintf(error->message, sizeof error->message, "%s", before);
    snprintf(error->message + used, sizeof error->message - used, "%s", after);
    for (int i = 0; i < behind.count && all->count < ERROR_MENTIONS; i++) {
        all->all[all->count] = behind.all[i];
        all->all[all->count++].at += (short)used;
    }
    return false;
}

/* Does the text begin with a blank and a value? */
static bool is_value(const char *text)
{
    const char *value = text + (*text == ' ');
    value += *value == '-';
    return (*value >= '0' && *value <= '9') || strncmp(value, "inf", 3) == 0 ||
           strncmp(value, "nan", 3) == 0;
}

static void rename_in(char *text, size_t size, struct mentions *mentions,
                      const char *(*name_of)(void *, struct text, bool), void *context)
{
    char rest[sizeof((struct error *)0)->message];
    /* from the last to the first, so that the places of the others stay */
    while (mentions->count > 0) {
        struct mention name = mentions->all[--mentions->count];
        size_t behind = (size_t)name.at + (size_t)name.length;
        if (behind > strlen(text)) {
            continue; /* cut off */
        }
        struct text words = {text + name.at, (size_t)name.length};
        /* the name without the article that a sentence may want before it */
        const struct text bare = text_behind(words, "the ");
        const char *instead =
            name_of(context, bare.start != NULL ? bare : words, !is_value(text + behind));
        if (instead != NULL) {
            snprintf(rest, sizeof rest, "%s", text + behind);
            snprintf(text + name.at, size - (size_t)name.at, "%s%s", instead, rest);
        }
    }
    text_make_printable(text, "");
}

void error_name(struct error *error,
                const char *(*name_of)(void *context, struct text quantity, bool asked),
                void *context)
{
    rename_in(error->message, sizeof error->message, &error->in_message, name_of, context);
    rename_in(error->hint, sizeof error->hint, &error->in_hint, name_of, context);
}
