/* data/folder.h - what lies in a folder. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_FOLDER_H
#define LENSCALC_DATA_FOLDER_H

#include "base/arena.h"
#include "base/error.h"
#include "base/name_table.h"

#include <stdbool.h>
#include <stddef.h>

enum folder_kind {
    FOLDER_FILE,   /* a regular one, or a link that leads nowhere */
    FOLDER_FOLDER, /* also a link to one */
    FOLDER_OTHER   /* a pipe, a device, a socket: nobody waits at it */
};

struct folder_entry {
    const char *name, *path; /* the path begins with that of the folder */
    enum folder_kind kind;
};

/*
 * All names in a folder but hidden ones, sorted; kinds are those of what links lead to.
 *
 * Given     seen  folders that were read, and receives this one; null: that does not matter
 *           entries, count  receive them, in the arena: none of a folder that was seen, by
 *                 whatever path
 * Errors    ERROR_IO: it cannot be read
 */
bool folder_read(const char *path, struct name_table *seen, struct arena *arena,
                 struct folder_entry **entries, size_t *count, struct error *error);

/* Is there a folder of that name, or a link to one? */
bool folder_exists(const char *path);

#endif
