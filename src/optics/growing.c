/* optics/growing.c - text that grows in the arena, for writers of files. */
/* SPDX-License-Identifier: MIT */
#include "optics/growing.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The end, with room for so many characters more. */
static char *growing_make_room(struct text_buffer *growing, size_t length)
{
    if (growing->length + length > growing->room) {
        size_t room = 2 * (growing->room + length) + 1024;
        char *more = arena_array(growing->arena, room, 1);
        if (growing->length > 0) {
            memcpy(more, growing->data, growing->length);
        }
        growing->data = more;
        growing->room = room;
    }
    return growing->data + growing->length;
}

void growing_put(struct text_buffer *growing, const char *start, size_t length)
{
    if (length > 0) {
        memcpy(growing_make_room(growing, length), start, length);
        growing->length += length;
    }
}

void growing_text(struct text_buffer *growing, struct text text)
{
    growing_put(growing, text.start, text.length);
}

void growing_string(struct text_buffer *growing, const char *string)
{
    growing_put(growing, string, strlen(string));
}

void growing_format(struct text_buffer *growing, const char *format, ...)
{
    va_list arguments, again;
    va_start(arguments, format);
    va_copy(again, arguments);
    int length = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    if (length > 0) {
        char *end = growing_make_room(growing, (size_t)length + 1); /* and its null */
        vsnprintf(end, (size_t)length + 1, format, again);
        growing->length += (size_t)length;
    }
    va_end(again);
}

void growing_number(struct text_buffer *growing, double value)
{
    char number[NUMBER_LENGTH];
    growing_put(growing, number, (size_t)(number_write_shortest(number, value) - number));
}

void growing_figure(struct text_buffer *growing, const struct figure *figure,
                    struct number_scale unit)
{
    char number[PAIR_LENGTH];
    if (figure->typed.start != NULL) {
        growing_text(growing, figure->typed);
    } else {
        growing_put(growing, number,
                    (size_t)(pair_write_shortest(number, figure->value, unit) - number));
    }
}

struct text growing_done(const struct text_buffer *growing)
{
    return (struct text){growing->data, growing->length};
}
