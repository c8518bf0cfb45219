/* data/whole_file.c - all that a file holds, in memory. */
/* SPDX-License-Identifier: MIT */
#include "data/whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Room for what a file says it has, and for one more byte, so that its end is seen at once. */
static size_t first_room(int descriptor, size_t most)
{
    struct stat found;
    const bool is_known = fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) &&
                          found.st_size > 0 && (uintmax_t)found.st_size < most;
    return is_known ? (size_t)found.st_size + 1 : 65536;
}

/* `most` in MiB; `begins` null: it may begin as it likes. */
static bool whole_file_read_all(int descriptor, const char *path, size_t most,
                                bool (*begins)(struct text first), struct arena *arena,
                                struct text *content, struct error *error)
{
    bool is_known = begins == NULL;
    size_t room = first_room(descriptor, most << 20), used = 0;
    char *data = arena_array(arena, room, 1);
    for (;;) {
        ssize_t got = read(descriptor, data + used, room - used);
        if (got < 0) {
            return fail(error, ERROR_IO, "cannot read %s: %s", path, strerror(errno));
        }
        if (got == 0) {
            *content = (struct text){data, used};
            return true;
        }
        used += (size_t)got;
        if (!is_known && used >= WHOLE_FILE_FIRST) {
            is_known = begins((struct text){data, WHOLE_FILE_FIRST});
            if (!is_known) {
                *content = (struct text){data, WHOLE_FILE_FIRST};
                return true;
            }
        }
        if (used > most << 20) {
            return fail(error, ERROR_IO, "cannot read %s: larger than %zu MiB", path, most);
        }
        if (used == room) {
            data = memcpy(arena_array(arena, 2 * room, 1), data, used);
            room *= 2;
        }
    }
}

bool whole_stream(int descriptor, const char *path, struct arena *arena, struct text *content,
                  struct error *error)
{
    return whole_file_read_all(descriptor, path, WHOLE_FILE_MOST, NULL, arena, content, error);
}

bool file_of_kind(const char *path, size_t most, bool (*begins)(struct text), struct arena *arena,
                  struct text *content, struct error *error)
{
    int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    error->code = ERROR_NONE;
    if (descriptor < 0) {
        return errno != ENOENT &&
               fail(error, ERROR_IO, "cannot read %s: %s", path, strerror(errno));
    }
    bool done = whole_file_read_all(descriptor, path, most, begins, arena, content, error);
    close(descriptor);
    return done;
}

bool large_file(const char *path, size_t most, struct arena *arena, struct text *content,
                struct error *error)
{
    return file_of_kind(path, most, NULL, arena, content, error);
}

bool whole_file(const char *path, struct arena *arena, struct text *content, struct error *error)
{
    return large_file(path, WHOLE_FILE_MOST, arena, content, error);
}

bool regular_file(const char *path, size_t most, struct arena *arena, struct text *content,
                  struct error *error)
{
    struct stat found;
    if (stat(path, &found) == 0 && !S_ISREG(found.st_mode)) {
        return fail(error, ERROR_IO, "cannot read %s: no regular file", path);
    }
    return large_file(path, most, arena, content, error);
}
