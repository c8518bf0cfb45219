/* optics/growing.h - text that grows in the arena, for writers of files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_GROWING_H
#define LENSCALC_OPTICS_GROWING_H

#include "base/arena.h"
#include "base/text.h"
#include "optics/lens.h"

/* Start with { .arena = arena }. */
struct text_buffer {
    struct arena *arena;
    char *data;
    size_t length, room;
};

void growing_put(struct text_buffer *growing, const char *start, size_t length);
void growing_text(struct text_buffer *growing, struct text text);
void growing_string(struct text_buffer *growing, const char *string);
void growing_format(struct text_buffer *growing, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* A double with the shortest digits. */
void growing_number(struct text_buffer *growing, double value);

/* A figure as it was typed; a computed one with the digits that read back to its pair. */
void growing_figure(struct text_buffer *growing, const struct figure *figure,
                    struct number_scale unit);

struct text growing_done(const struct text_buffer *growing);

#endif
