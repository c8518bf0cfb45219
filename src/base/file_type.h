/* base/file_type.h - what a file may hold, and how its name ends. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_FILE_TYPE_H
#define LENSCALC_BASE_FILE_TYPE_H

#include "base/arena.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

struct file_type {
    struct word word;   /* "zmx", "Zemax OpticStudio" */
    const char *ending; /* ".zmx" */
};

/* A list of them: type i, the usual one first; null behind the last. */
typedef const struct file_type *file_types(size_t i);

/* Does the name end so? Case does not count; a name that is an ending alone has none. */
bool file_type_ends(struct text path, const char *ending);

/* The type whose ending the name has; null if there is none. */
const struct file_type *file_type_of(file_types *types, struct text path);

/* The endings in words: ".svg", ".svg or .png". */
const char *file_type_endings(file_types *types, struct arena *arena);

#endif
