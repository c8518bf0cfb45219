/* data/whole_file.h - all that a file holds, in memory. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DATA_WHOLE_FILE_H
#define LENSCALC_DATA_WHOLE_FILE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>

/* MiB; what is larger is something else */
enum { WHOLE_FILE_MOST = 64 };

/* bytes by which a kind of file is told */
enum { WHOLE_FILE_FIRST = 65536 };

/*
 * Everything a descriptor gives: a file, a pipe, a terminal.
 *
 * Given     path     for messages; content  receives it, in the arena
 * Errors    ERROR_IO: it cannot be read, or is larger than WHOLE_FILE_MOST
 */
bool whole_stream(int descriptor, const char *path, struct arena *arena, struct text *content,
                  struct error *error);

/*
 * Everything a file holds that may be as large as pictures are.
 *
 * Given     most   MiB
 * Result    false with error->code ERROR_NONE if there is none of that name
 */
bool large_file(const char *path, size_t most, struct arena *arena, struct text *content,
                struct error *error);

/*
 * The same of a kind of file that is told by how it begins: another one, which may be endless, is
 * not read to its end.
 *
 * Given     begins  does it, if these are its first bytes, all or WHOLE_FILE_FIRST?
 * Result    of another kind of file no more than these
 */
bool file_of_kind(const char *path, size_t most, bool (*begins)(struct text), struct arena *arena,
                  struct text *content, struct error *error);

/*
 * The same of a name that a folder or another file has: nobody waits at a pipe that lies there, or
 * reads a device that has no end.
 *
 * Errors    ERROR_IO: it is no regular file, too
 */
bool regular_file(const char *path, size_t most, struct arena *arena, struct text *content,
                  struct error *error);

/* The same, of at most WHOLE_FILE_MOST. */
bool whole_file(const char *path, struct arena *arena, struct text *content, struct error *error);

#endif
