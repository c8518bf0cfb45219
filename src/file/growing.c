/* file/growing.c - text that grows in the arena, for writers of files. */
/* SPDX-License-Identifier: MIT */
#include "file/growing.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void growing_put(struct growing *growing, const char *start, size_t length)
{
    if (length == 0) {
        return;
    }
    if (growing->length + length > growing->room) {
        size_t room = 2 * (growing->room + length) + 1024;
        char *more = arena_array(growing->arena, room, 1);
        if (growing->length > 0) {
            memcpy(more, growing->data, growing->length);
        }
        growing->data = more;
        growing->room = room;
    }
    memcpy(growing->data + growing->length, start, length);
    growing->length += length;
}

void growing_text(struct growing *growing, struct text text)
{
    growing_put(growing, text.start, text.length);
}

void growing_string(struct growing *growing, const char *string)
{
    growing_put(growing, string, strlen(string));
}

void growing_format(struct growing *growing, const char *format, ...)
{
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    int length = vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    growing_put(growing, line,
                length < 0                     ? 0
                : (size_t)length < sizeof line ? (size_t)length
                                               : sizeof line - 1);
}

void growing_number(struct growing *growing, double value)
{
    char number[NUMBER_LENGTH];
    growing_put(growing, number, (size_t)(number_write_shortest(number, value) - number));
}

void growing_figure(struct growing *growing, const struct figure *figure, struct number_scale unit)
{
    char number[PAIR_LENGTH];
    if (figure->typed.start != NULL) {
        growing_text(growing, figure->typed);
    } else {
        growing_put(growing, number,
                    (size_t)(pair_write_shortest(number, figure->value, unit) - number));
    }
}

struct text growing_done(const struct growing *growing)
{
    return (struct text){growing->data, growing->length};
}
