/* base/arena.c - memory that is given back all at once. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_SIZE = 32 * 1024, ALIGNMENT = _Alignof(max_align_t) };

struct arena_block {
    struct arena_block *previous;
    size_t size, used;
    _Alignas(max_align_t) char data[];
};

static struct arena_block *new_block(struct arena_block *previous, size_t size)
{
    size_t room = size > BLOCK_SIZE ? size : BLOCK_SIZE;
    if (room > SIZE_MAX - sizeof(struct arena_block)) {
        abort();
    }
    struct arena_block *block = malloc(sizeof *block + room);
    if (block == NULL) {
        abort();
    }
    block->previous = previous;
    block->size = room;
    block->used = 0;
    return block;
}

/* The next `bytes`, a multiple of ALIGNMENT, as they come. */
static void *take(struct arena *arena, size_t bytes)
{
    if (arena->block == NULL || arena->block->size - arena->block->used < bytes) {
        arena->block = new_block(arena->block, bytes);
    }
    char *memory = arena->block->data + arena->block->used;
    arena->block->used += bytes;
    return memory;
}

void *arena_array(struct arena *arena, size_t count, size_t size)
{
    if (size > 0 && count > (SIZE_MAX - ALIGNMENT) / size) {
        abort();
    }
    size_t bytes = (count * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
    return memset(take(arena, bytes), 0, bytes);
}

void *arena_buffer(struct arena *arena, size_t size)
{
    return take(arena, (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT);
}

void *arena_grow(struct arena *arena, void *array, size_t count, size_t *room, size_t size)
{
    if (count < *room) {
        return array;
    }
    size_t more = *room > 0 ? 2 * *room : 16;
    void *larger = arena_array(arena, more, size);
    if (count > 0) {
        memcpy(larger, array, count * size);
    }
    *room = more;
    return larger;
}

char *arena_string(struct arena *arena, const char *start, size_t length)
{
    char *copy = arena_array(arena, length + 1, 1);
    if (length > 0) {
        memcpy(copy, start, length);
    }
    return copy;
}

char *arena_join(struct arena *arena, const char *const *strings, size_t count)
{
    size_t length = 0;
    for (size_t i = 0; i < count; i++) {
        length += strings[i] != NULL ? strlen(strings[i]) : 0;
    }
    char *joined = arena_array(arena, length + 1, 1), *at = joined;
    for (size_t i = 0; i < count; i++) {
        size_t part = strings[i] != NULL ? strlen(strings[i]) : 0;
        if (part > 0) {
            memcpy(at, strings[i], part);
        }
        at += part;
    }
    return joined;
}

char *arena_printf(struct arena *arena, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    char probe[1];
    int length = vsnprintf(probe, sizeof probe, format, arguments);
    va_end(arguments);
    size_t room = length > 0 ? (size_t)length + 1 : 1;
    char *string = arena_array(arena, room, 1);
    va_start(arguments, format);
    vsnprintf(string, room, format, arguments);
    va_end(arguments);
    return string;
}

struct arena_mark arena_mark(const struct arena *arena)
{
    return (struct arena_mark){arena->block, arena->block == NULL ? 0 : arena->block->used};
}

void arena_reset(struct arena *arena, struct arena_mark mark)
{
    while (arena->block != mark.block) {
        struct arena_block *previous = arena->block->previous;
        free(arena->block);
        arena->block = previous;
    }
    if (arena->block != NULL) {
        arena->block->used = mark.used;
    }
}

void arena_free(struct arena *arena)
{
    arena_reset(arena, (struct arena_mark){NULL, 0});
}
