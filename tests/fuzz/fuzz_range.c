/* tests/fuzz/fuzz_range.c - lists and ranges: first byte the option of dof, then its text. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/command.h"
#include "cli/question/settle.h"
#include "cli/question/sweep.h"
#include "commands/commands.h"
#include "fuzz.h"

#include <math.h>

enum { MOST = 1000000 };

static void require_axis(const struct axis *axis)
{
    REQUIRE(axis->count >= 2 && axis->count <= MOST);
    if (axis->option->kind != &kind_quantity) {
        return;
    }
    for (size_t i = 0; i < axis->count; i++) {
        double value = axis_number(axis, i);
        REQUIRE(!isnan(value));
        REQUIRE(axis->option->lowest == axis->option->highest ||
                (value >= axis->option->lowest && value <= axis->option->highest));
    }
}

static void try_words(int count, char **words, bool nominal)
{
    struct arena arena = {0};
    struct lensdb db = {.arena = &arena};
    struct reader reader = {.db = &db, .arena = &arena, .nominal = nominal};
    struct arguments arguments = {0};
    struct sweep sweep = {0};
    struct error error = {0};
    const struct command *command = command_find(text_of("dof"));
    void *input = arena_array(&arena, 1, command->input_size);
    if (arguments_parse(&arguments, command, count, words, &arena, &error) &&
        arguments_settle(&arguments, &arena, &error) &&
        sweep_build(&sweep, &arguments, &reader, false, input, &error)) {
        REQUIRE(sweep.total >= 1 && sweep.total <= MOST);
        size_t product = 1;
        for (size_t i = 0; i < sweep.axis_count; i++) {
            require_axis(&sweep.axes[i]);
            product *= sweep.axes[i].count;
        }
        REQUIRE(product == sweep.total);
        sweep_set(&sweep, 0, input);
        sweep_set(&sweep, sweep.total - 1, input);
    } else {
        fuzz_require_error(&error);
    }
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const options[] = {"--distance", "--aperture",     "--focal-length",
                                          "--coc",      "--pupil",        "--magnification",
                                          "--sensor",   "--wavelength",   "--model",
                                          "--overlap",  "--focal-length", "--near"};
    enum { COUNT = sizeof options / sizeof options[0] };
    if (size < 1) {
        return 0;
    }
    char name[32];
    snprintf(name, sizeof name, "%s", options[data[0] % COUNT]);
    char *text = malloc(size);
    REQUIRE(text != NULL);
    memcpy(text, data + 1, size - 1);
    text[size - 1] = '\0';
    try_words(2, (char *[]){name, text, NULL}, data[0] / COUNT % 2 == 1);
    free(text);
    return 0;
}
