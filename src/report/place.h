/* report/place.h - where a file lies that is to be written. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_PLACE_H
#define LENSCALC_REPORT_PLACE_H

#include "base/arena.h"

#include <stdbool.h>

/*
 * What a name stands for: the end of a chain of symbolic links, whether a file is there or not. A
 * name of something open, as /dev/stdout leads to, is such an end: what is open is meant, be it a
 * pipe or the middle of a file, not the name that it has or had.
 *
 * Result    the name itself if it is no link; null when the links run in a circle
 */
const char *place_of(const char *path, struct arena *arena);

/* What a name stands for that is open. */
enum {
    PLACE_CLOSED = -1, /* a name of a file */
    PLACE_FOREIGN = -2 /* another process has it open: this one can open it again, no more */
};

/*
 * Which descriptor of this process does a name stand for: /dev/stdout, /dev/fd/3, a link to one?
 *
 * Given     path  as place_of gives it
 * Result    the descriptor, or one of those above
 */
int place_descriptor(const char *path, struct arena *arena);

/* Does the name mean standard output: none, "-", or that of descriptor 1? */
bool place_is_standard(const char *path, struct arena *arena);

/* Is a regular file there that would be replaced? What is open is none. */
bool place_is_file(const char *path, struct arena *arena);

/* The folder of a path: "." for a bare name. */
const char *place_folder(const char *path, struct arena *arena);

/*
 * Do two names mean one file, or one open descriptor? Of files that are not there yet folder and
 * last name count.
 */
bool place_is_same(const char *a, const char *b, struct arena *arena);

/*
 * The name of a new file in the folder of `path`, by chance: whoever makes it asks again with
 * another `attempt` if there is such a file.
 */
const char *place_beside(const char *path, unsigned attempt, struct arena *arena);

#endif
