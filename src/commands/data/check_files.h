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

/* Paths in the order in which they are to be reported. */
struct check_list {
    struct arena *arena;
    const char **paths;
    size_t count, room;
};

/*
 * Add a file, or of a folder all files, also in folders below, whose names end as those of lens
 * files do; in the order of their names.
 *
 * Errors    ERROR_IO: a folder that cannot be read
 */
bool check_list_add(struct check_list *list, struct text path, struct error *error);

/* convert --check */
extern const struct command command_convert_check;

#endif
