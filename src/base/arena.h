/* base/arena.h - memory that is given back all at once. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_ARENA_H
#define LENSCALC_BASE_ARENA_H

#include <stddef.h>

struct arena_block;

/* Start with { 0 }; one a command. */
struct arena {
    struct arena_block *block;
    struct arena_block *spare; /* given up, and kept for what is taken next */
    size_t spare_size;         /* bytes */
    struct arena *within;      /* takes its memory there; null: from the system */
};

struct arena_mark {
    struct arena_block *block;
    size_t used;
};

/*
 * An arena that takes its memory from another and is given up with it: what is taken and reset in
 * it again and again leaves that one alone.
 */
struct arena arena_within(struct arena *arena);

/* End the program, which cannot go on without memory: "out of memory", status ERROR_IO. */
void arena_end(void);

/*
 * Memory for `count` objects of `size` bytes, zeroed, aligned for any type.
 *
 * Result    never null: when memory is used up, or count * size overflows, the program cannot go
 *           on: it says "out of memory" and ends with ERROR_IO
 */
void *arena_array(struct arena *arena, size_t count, size_t size);

/* The same, not zeroed: pages that are never written to cost nothing. */
void *arena_buffer_array(struct arena *arena, size_t count, size_t size);

/*
 * One object, not zeroed.
 *
 * Given     size  bytes, a constant of the program, or about those of something that there is
 */
void *arena_buffer(struct arena *arena, size_t size);

/*
 * Room for one more in an array that grows by doubling.
 *
 * Given     count  objects of `size` bytes in it
 *           room   for how many it has room; the array is null for 0
 * Result    the array, moved if it was full
 */
void *arena_grow(struct arena *arena, void *array, size_t count, size_t *room, size_t size);

/* One more in such an array, which is counted; its address. */
#define ARENA_ADD(arena, all, count, room)                                                         \
    ((all) = arena_grow((arena), (all), (count), &(room), sizeof *(all)), &(all)[(count)++])

/* A copy of an array of `count` objects of `size` bytes, with room for `more`, zeroed, behind. */
void *arena_copy(struct arena *arena, const void *array, size_t count, size_t more, size_t size);
#define ARENA_COPY(arena, array, count, more)                                                      \
    arena_copy((arena), (array), (count), (more), sizeof *(array))

/* A copy of `length` characters with a NUL behind. */
char *arena_string(struct arena *arena, const char *start, size_t length);

/* Strings one after the other: a tenth of the time of arena_printf. A null one is empty. */
char *arena_join(struct arena *arena, const char *const *strings, size_t count);

#define ARENA_JOIN(arena, ...)                                                                     \
    arena_join((arena), (const char *const[]){__VA_ARGS__},                                        \
               sizeof((const char *const[]){__VA_ARGS__}) / sizeof(char *))

/* A string made as by printf. */
char *arena_printf(struct arena *arena, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Where the arena stands now, and back to it: what was taken since is given up. */
struct arena_mark arena_mark(const struct arena *arena);
void arena_reset(struct arena *arena, struct arena_mark mark);

/* All of `other`, which becomes empty, lives as long as what this arena hands out now. */
void arena_adopt(struct arena *arena, struct arena *other);

void arena_free(struct arena *arena);

#define ARENA_NEW(arena, type)          ((type *)arena_array((arena), 1, sizeof(type)))
#define ARENA_ARRAY(arena, count, type) ((type *)arena_array((arena), (count), sizeof(type)))

#endif
