/* report/place.h - where a file lies that is to be written. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_PLACE_H
#define LENSCALC_REPORT_PLACE_H

#include "base/arena.h"

#include <stdbool.h>

/*
 * What a name stands for: the end of a chain of symbolic links, whether a file is there or not.
 *
 * Result    the name itself if it is no link; null when the links run in a circle
 */
const char *place_of(const char *path, struct arena *arena);

/* The folder of a path: "." for a bare name. */
const char *place_folder(const char *path, struct arena *arena);

/* Do two names mean one file? Of files that are not there yet folder and last name count. */
bool place_is_same(const char *a, const char *b, struct arena *arena);

/*
 * The name of a new file in the folder of `path`, by chance: whoever makes it asks again with
 * another `attempt` if there is such a file.
 */
const char *place_beside(const char *path, unsigned attempt, struct arena *arena);

#endif
