/* data/whole_file.c - all that a file holds, in memory. */
/* SPDX-License-Identifier: MIT */
#include "data/whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

bool whole_stream(int descriptor, const char *path, struct arena *arena, struct text *content,
                  struct error *error)
{
    size_t room = 65536, used = 0;
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
        if (used > (size_t)WHOLE_FILE_MOST << 20) {
            return fail(error, ERROR_IO, "cannot read %s: larger than %d MiB", path,
                        WHOLE_FILE_MOST);
        }
        if (used == room) {
            char *more = arena_array(arena, 2 * room, 1);
            data = memcpy(more, data, used);
            room *= 2;
        }
    }
}

bool whole_file(const char *path, struct arena *arena, struct text *content, struct error *error)
{
    int descriptor = open(path, O_RDONLY | O_CLOEXEC);
    error->code = ERROR_NONE;
    if (descriptor < 0) {
        return errno != ENOENT &&
               fail(error, ERROR_IO, "cannot read %s: %s", path, strerror(errno));
    }
    bool done = whole_stream(descriptor, path, arena, content, error);
    close(descriptor);
    return done;
}
