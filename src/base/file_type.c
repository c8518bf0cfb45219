/* base/file_type.c - what a file may hold, and how its name ends. */
/* SPDX-License-Identifier: MIT */
#include "base/file_type.h"

bool file_type_ends(struct text path, const char *ending)
{
    struct text last = text_of(ending);
    return path.length > last.length &&
           text_same((struct text){path.start + path.length - last.length, last.length}, ending);
}

const struct file_type *file_type_of(file_types *types, struct text path)
{
    size_t i = 0;
    while (types(i) != NULL && !file_type_ends(path, types(i)->ending)) {
        i++;
    }
    return types(i);
}

const char *file_type_endings(file_types *types, struct arena *arena)
{
    const char *all = "";
    for (size_t i = 0; types(i) != NULL; i++) {
        const char *between = types(i + 1) == NULL ? " or " : ", ";
        all = arena_printf(arena, "%s%s%s", all, i == 0 ? "" : between, types(i)->ending);
    }
    return all;
}
