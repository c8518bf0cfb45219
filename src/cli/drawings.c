/* cli/drawings.c - drawings that commands make themselves. */
/* SPDX-License-Identifier: MIT */
#include "cli/drawings.h"

#include "report/output.h"

#include <string.h>

enum { MOST_INPUTS = 100 };

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

bool picture_write(const struct command *command, const struct sweep *sweep, void *input,
                   const char *path, struct arena *arena, struct error *error)
{
    if (sweep->total > MOST_INPUTS) {
        return fail(error, ERROR_USAGE, "--plot would draw %zu questions: at most %d", sweep->total,
                    MOST_INPUTS);
    }
    const void **inputs = ARENA_ARRAY(arena, sweep->total, const void *);
    for (size_t i = 0; i < sweep->total; i++) {
        void *copy = arena_array(arena, 1, command->input_size);
        sweep_set(sweep, i, input);
        memcpy(copy, input, command->input_size);
        inputs[i] = copy;
    }
    struct svg svg = {.arena = arena};
    return command->picture(inputs, sweep->total, &svg, error) &&
           output_file(path, svg.data, svg.length, arena, error);
}
