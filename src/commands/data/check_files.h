/* commands/data/check_files.h - the files that lenscalc convert --check reads. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DATA_CHECK_FILES_H
#define LENSCALC_COMMANDS_DATA_CHECK_FILES_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

struct command;

/* A file, or a folder that cannot be read. */
struct check_item {
    const char *path;
    const char *problem; /* why it cannot be read; null: that is still to be seen */
    bool is_named;       /* by the user: a pipe, too, is read */
};

/* In the order in which they are to be reported. */
struct check_list {
    struct arena *arena;
    struct check_item *items;
    size_t count, room;
};

/*
 * Add a file, or of a folder all files, also in folders below, whose names end as those of lens
 * files do; in the order of their names. A folder to which several paths lead is read once.
 */
void check_list_add(struct check_list *list, struct text path);

/* convert --check */
extern const struct command command_convert_check;

#endif
