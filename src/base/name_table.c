/* base/name_table.c - numbers of names: which of a list has this one. */
/* SPDX-License-Identifier: MIT */
#include "base/name_table.h"

#include <stdint.h>

/* Where a name stands, or could; there is a free slot. */
static size_t name_table_slot_of(const struct name_table *index, struct text name)
{
    /* Fowler, Noll and Vo's, with 64 bits */
    uint64_t hash = 0xcbf29ce484222325;
    for (size_t i = 0; i < name.length; i++) {
        hash = (hash ^ (unsigned char)name.start[i]) * 0x100000001b3;
    }
    size_t slot = (size_t)(hash ^ hash >> 32) & (index->slot_count - 1);
    while (index->slots[slot] != 0 && !text_identical(index->names[index->slots[slot] - 1], name)) {
        slot = (slot + 1) & (index->slot_count - 1);
    }
    return slot;
}

size_t name_table_find(const struct name_table *index, struct text name)
{
    const size_t slot = index->slot_count > 0 ? name_table_slot_of(index, name) : 0;
    return index->slot_count > 0 && index->slots[slot] != 0 ? index->slots[slot] - 1 : NAME_NONE;
}

size_t name_table_add(struct name_table *index, struct text name, struct arena *arena)
{
    if (2 * (index->count + 1) > index->slot_count) {
        index->slot_count = index->slot_count > 0 ? 2 * index->slot_count : 64;
        index->slots = ARENA_ARRAY(arena, index->slot_count, size_t);
        for (size_t i = 0; i < index->count; i++) {
            index->slots[name_table_slot_of(index, index->names[i])] = i + 1;
        }
    }
    index->names =
        arena_grow(arena, index->names, index->count, &index->room, sizeof index->names[0]);
    index->names[index->count] = name;
    index->slots[name_table_slot_of(index, name)] = index->count + 1;
    return index->count++;
}
