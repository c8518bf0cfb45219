/* cli/drawings.c - the drawings that options of a command ask for with a file name. */
/* SPDX-License-Identifier: MIT */
#include "cli/drawings.h"

static const char *path_of(const void *input, const struct drawing *drawing)
{
    return *(const char *const *)(const void *)((const char *)input + drawing->offset);
}

bool drawings_check(const struct command *command, const void *input, bool many,
                    struct error *error)
{
    const struct drawing *drawing = command->drawings;
    for (; drawing != NULL && drawing->option != NULL; drawing++) {
        if (path_of(input, drawing) != NULL && many) {
            return fail(error, ERROR_USAGE, "--%s draws one answer: no lists, ranges or --batch",
                        drawing->option);
        }
    }
    return true;
}

bool drawings_write(const struct command *command, const void *input, struct arena *arena,
                    struct error *error)
{
    const struct drawing *drawing = command->drawings;
    for (; drawing != NULL && drawing->option != NULL; drawing++) {
        const char *path = path_of(input, drawing);
        if (path == NULL) {
            continue;
        }
        struct svg svg = {.arena = arena};
        if (!drawing->draw(input, &svg, error) ||
            !output_file(path, svg.data, svg.length, arena, error)) {
            return false;
        }
    }
    return true;
}
