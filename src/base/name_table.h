/* base/name_table.h - numbers of names: which of a list has this one. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_NAME_TABLE_H
#define LENSCALC_BASE_NAME_TABLE_H

#include "base/arena.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* Names in the order in which they came, found in a time that does not grow. Start with { 0 }. */
struct name_table {
    size_t count, room, slot_count;
    struct text *names;
    size_t *slots; /* one more than the number of a name; 0: free */
};

#define NAME_NONE ((size_t)-1)

/* The number of a name; NAME_NONE: it is not there. */
size_t name_table_find(const struct name_table *index, struct text name);

/* Add a name that is not there, whose letters stay where they are; its number. */
size_t name_table_add(struct name_table *index, struct text name, struct arena *arena);

#endif
