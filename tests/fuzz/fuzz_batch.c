/* tests/fuzz/fuzz_batch.c - rows of a batch: first byte command and format, then the file. */
/* SPDX-License-Identifier: MIT */
#define _GNU_SOURCE /* memfd_create */
#include "cli/batch/batch.h"
#include "cli/question/sweep.h"
#include "commands/commands.h"
#include "fuzz.h"

#include <math.h>
#include <sys/mman.h>
#include <unistd.h>

enum { MOST_ROWS = 500 };

static bool count_row(struct run *run, const void *row)
{
    REQUIRE(row != NULL);
    ++*(size_t *)run->driver;
    return true;
}

static size_t lines_in(const uint8_t *data, size_t size)
{
    size_t lines = 1;
    for (size_t i = 0; i < size; i++) {
        lines += data[i] == '\n';
    }
    return lines;
}

/* Cells handed through are memory that may be read, of bad rows too. */
static void require_passed(const struct batch *batch)
{
    volatile unsigned char last = 0;
    for (size_t i = 0; i < batch->passed_count; i++) {
        for (size_t j = 0; j < batch->passed[i].text.length; j++) {
            last = (unsigned char)batch->passed[i].text.start[j];
        }
    }
    (void)last;
}

/* Numbers are only absent where the command line left them absent. */
static void require_input(const struct batch *batch, const void *input, const void *constants)
{
    for (size_t i = 0; i < batch->column_count; i++) {
        const struct option *option = batch->columns[i].option;
        if (option == NULL || option->kind != &kind_quantity) {
            continue;
        }
        double value = *(const double *)(const void *)((const char *)input + option->offset);
        double usual = *(const double *)(const void *)((const char *)constants + option->offset);
        REQUIRE(!isnan(value) || isnan(usual));
    }
}

static void read_rows(struct batch *batch, const struct command *command, struct run *run,
                      void *input, const void *constants, size_t lines)
{
    struct error error = {0};
    for (int i = 0; i < MOST_ROWS; i++) {
        struct arena_mark mark = arena_mark(run->arena);
        enum batch_result result = batch_next(batch, input, &error);
        if (result == BATCH_END) {
            break;
        }
        require_passed(batch);
        if (result != BATCH_ROW) {
            fuzz_require_error(&error);
            REQUIRE(result != BATCH_BAD_ROW || error.line >= 1);
            REQUIRE(error.line <= (long)lines);
        } else {
            require_input(batch, input, constants);
            if (!command->run(input, run, &error)) {
                fuzz_require_error(&error);
            }
        }
        if (result == BATCH_FAILED) {
            break;
        }
        arena_reset(run->arena, mark);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char *const names[] = {"dof", "fov", "hyperfocal"};
    if (size < 1) {
        return 0;
    }
    int file = memfd_create("batch", 0);
    REQUIRE(file >= 0 && write(file, data + 1, size - 1) == (ssize_t)(size - 1));
    char path[64];
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    const struct command *command = command_find(text_of(names[data[0] % 3]));
    struct arena arena = {0}, row_arena = {0};
    struct lensdb db = {.arena = &arena};
    struct reader reader = {.db = &db, .arena = &arena};
    struct arguments arguments = {0};
    struct sweep sweep = {0};
    struct batch batch = {0};
    struct error error = {0};
    size_t rows = 0;
    struct run run = {
        .arena = &row_arena, .kept = &arena, .db = &db, .emit = count_row, .driver = &rows};
    void *input = arena_array(&arena, 1, command->input_size);
    REQUIRE(arguments_parse(&arguments, command, 0, NULL, &arena, &error));
    REQUIRE(sweep_build(&sweep, &arguments, &reader, false, input, &error));
    void *constants = arena_array(&arena, 1, command->input_size);
    memcpy(constants, input, command->input_size);
    reader.arena = &row_arena;
    batch = (struct batch){.arguments = &arguments,
                           .reader = &reader,
                           .arena = &arena,
                           .sheet = &command->sheet,
                           .commands = commands,
                           .constants = constants};
    if (batch_open(&batch, path, (enum batch_format)(data[0] / 3 % 4), &error) &&
        batch_settle(&batch, &command->sheet, data[0] / 12 % 2 == 0, &error)) {
        read_rows(&batch, command, &run, input, constants, lines_in(data + 1, size - 1));
    } else {
        fuzz_require_error(&error);
    }
    batch_close(&batch);
    arena_free(&row_arena);
    arena_free(&arena);
    close(file);
    return 0;
}
