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

static bool read_all(int descriptor, const char *path, size_t most, struct arena *arena,
                     struct text *content, struct error *error)
{
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
        if (used > most << 20) {
            return fail(error, ERROR_IO, "cannot read %s: larger than %zu MiB", path, most);
        }
        if (used == room) {
            char *more = arena_array(arena, 2 * room, 1);
            data = memcpy(more, data, used);
            room *= 2;
        }
    }
}

bool whole_stream(int descriptor, const char *path, struct arena *arena, struct text *content,
                  struct error *error)
{
    return read_all(descriptor, path, WHOLE_FILE_MOST, arena, content, error);
}

bool large_file(const char *path, size_t most, struct arena *arena, struct text *content,
                struct error *error)
{
    int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    error->code = ERROR_NONE;
    if (descriptor < 0) {
        return errno != ENOENT &&
               fail(error, ERROR_IO, "cannot read %s: %s", path, strerror(errno));
    }
    bool done = read_all(descriptor, path, most, arena, content, error);
    close(descriptor);
    return done;
}

bool whole_file(const char *path, struct arena *arena, struct text *content, struct error *error)
{
    return large_file(path, WHOLE_FILE_MOST, arena, content, error);
}
