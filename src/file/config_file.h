/* file/config_file.h - the file of defaults and kits: sections, and lines with "name = value". */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_CONFIG_FILE_H
#define LENSCALC_FILE_CONFIG_FILE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>

/* What a line is for: all commands, those of [COMMAND], or who asks for [kit NAME]. */
enum config_scope { CONFIG_ALL, CONFIG_COMMAND, CONFIG_KIT };

/* One line "name = value". Texts point into the content. */
struct config_entry {
    enum config_scope scope;
    struct text section; /* name of the command or kit */
    struct text name, value;
    struct text line; /* all of it */
    long number;      /* of that line, 1-based */
};

struct config_file {
    const char *source; /* for messages; null: there is nowhere to look */
    bool is_there;
    struct config_entry *entries;
    size_t count;
    struct config_entry
        *sections; /* their heads, whose name is empty: a section may hold nothing */
    size_t section_count;
};

/*
 * Read a file: "name = value", under [COMMAND] or [kit NAME], or above all of them. What follows a
 * '#' is a comment, in a value only behind a blank; a value between quotes, "...", is taken as it
 * is.
 *
 * Given     source   for messages
 *           content  as long as the entries are used
 * Errors    ERROR_DATA with line and column: no plain text, no section, no name, no value
 */
bool config_file_read(struct config_file *file, const char *source, struct text content,
                      struct arena *arena, struct error *error);

/* Say what is wrong with a part of an entry's line, as ERROR_DATA. Returns false. */
bool config_file_fail(const struct config_file *file, const struct config_entry *entry,
                      struct text part, struct error *error, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

#endif
