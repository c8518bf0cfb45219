/* base/arena.c - memory that is given back all at once. */
/* SPDX-License-Identifier: MIT */
#include "base/arena.h"

#include "base/error.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { BLOCK_SIZE = 32 * 1024, ALIGNMENT = _Alignof(max_align_t) };

/*
 * What an arena keeps of what it was given back: pages that are returned to the system and asked
 * for again cost more than most of what is computed in them. Under the address sanitizer nothing,
 * so that it sees who uses memory that was given up.
 */
#ifdef __SANITIZE_ADDRESS__
static const size_t most_spare = 0;
#else
static const size_t most_spare = 8 * 1024 * 1024;
#endif

struct arena_block {
    struct arena_block *previous;
    size_t size, used;
    _Alignas(max_align_t) char data[];
};

/* The smallest spare block that is large enough, out of its list; null: there is none. */
static struct arena_block *take_spare(struct arena *arena, size_t size)
{
    struct arena_block **best = NULL;
    for (struct arena_block **at = &arena->spare; *at != NULL; at = &(*at)->previous) {
        if ((*at)->size >= size && (best == NULL || (*at)->size < (*best)->size)) {
            best = at;
        }
    }
    if (best == NULL) {
        return NULL;
    }
    struct arena_block *block = *best;
    *best = block->previous;
    arena->spare_size -= block->size;
    return block;
}

/*
 * The one end of the program below main: to hand this up from every allocation would double the
 * code, and nothing can be said with formats, which want memory. Files are still beside their
 * places, most without a name, so none is left in half.
 */
_Noreturn void arena_end(void)
{
    static const char message[] = "lenscalc: out of memory\n";
    ssize_t written = write(STDERR_FILENO, message, sizeof message - 1);
    (void)written; /* nobody is left to be told */
    _exit(ERROR_IO);
}

static struct arena_block *new_block(struct arena *within, size_t size)
{
    size_t room = size > BLOCK_SIZE ? size : BLOCK_SIZE;
    if (room > SIZE_MAX - sizeof(struct arena_block)) {
        arena_end();
    }
    struct arena_block *block =
        within != NULL ? arena_buffer(within, sizeof *block + room) : malloc(sizeof *block + room);
    if (block == NULL) {
        arena_end();
    }
    block->size = room;
    return block;
}

/* The next `bytes`, a multiple of ALIGNMENT, as they come. */
static void *arena_take(struct arena *arena, size_t bytes)
{
    if (arena->block == NULL || arena->block->size - arena->block->used < bytes) {
        struct arena_block *block = take_spare(arena, bytes);
        block = block != NULL ? block : new_block(arena->within, bytes);
        block->previous = arena->block;
        block->used = 0;
        arena->block = block;
    }
    char *memory = arena->block->data + arena->block->used;
    arena->block->used += bytes;
    return memory;
}

/* A multiple of ALIGNMENT that has room for them. */
static size_t bytes_of(size_t count, size_t size)
{
    if (size > 0 && count > (SIZE_MAX - ALIGNMENT) / size) {
        arena_end();
    }
    return (count * size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

void *arena_array(struct arena *arena, size_t count, size_t size)
{
    const size_t bytes = bytes_of(count, size);
    return memset(arena_take(arena, bytes), 0, bytes);
}

void *arena_buffer_array(struct arena *arena, size_t count, size_t size)
{
    return arena_take(arena, bytes_of(count, size));
}

void *arena_buffer(struct arena *arena, size_t size)
{
    return arena_take(arena, bytes_of(1, size));
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

void *arena_copy(struct arena *arena, const void *array, size_t count, size_t more, size_t size)
{
    void *copy = arena_array(arena, count + more, size);
    return count > 0 ? memcpy(copy, array, count * size) : copy;
}

char *arena_string(struct arena *arena, const char *start, size_t length)
{
    char *copy = arena_buffer(arena, length + 1);
    if (length > 0) {
        memcpy(copy, start, length);
    }
    copy[length] = '\0';
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

struct arena arena_within(struct arena *arena)
{
    return (struct arena){.within = arena};
}

struct arena_mark arena_mark(const struct arena *arena)
{
    return (struct arena_mark){arena->block, arena->block == NULL ? 0 : arena->block->used};
}

void arena_reset(struct arena *arena, struct arena_mark mark)
{
    while (arena->block != mark.block) {
        struct arena_block *given = arena->block;
        arena->block = given->previous;
        if (arena->within == NULL &&
            (given->size > most_spare || arena->spare_size > most_spare - given->size)) {
            free(given);
            continue;
        }
        given->previous = arena->spare;
        arena->spare = given;
        arena->spare_size += given->size;
    }
    if (arena->block != NULL) {
        arena->block->used = mark.used;
    }
}

void arena_adopt(struct arena *arena, struct arena *other)
{
    struct arena_block **last = &other->block;
    while (*last != NULL) {
        last = &(*last)->previous;
    }
    *last = arena->block;
    arena->block = other->block;
    other->block = NULL;
    arena_free(other);
}

void arena_free(struct arena *arena)
{
    arena_reset(arena, (struct arena_mark){NULL, 0});
    while (arena->spare != NULL) {
        struct arena_block *block = arena->spare;
        arena->spare = block->previous;
        if (arena->within == NULL) {
            free(block);
        }
    }
    arena->spare_size = 0;
}
