/* tests/unit/test_batch.c - the option that a column of a batch stands for, by all its names. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "cli/batch/batch.h"
#include "commands/commands.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static struct arena arena;
static struct lensdb db = {.arena = &arena};
static struct lens_cache lenses = {.arena = &arena};
/* Values of which every kind of option takes at least two. */
static const char *const values[] = {
    "2",         "3",         "0.2",      "0.3",          "0.02",
    "0.03",      "50",        "60",       "true",         "false",
    "5000",      "6000",      "0.03mm",   "35mm",         "aps-c",
    "0:0:1",     "0:1:0",     "0:0.5",    "0.5:0",        "1/60",
    "1/30",      "500nm",     "600nm",    "A4",           "A3",
    "1/4",       "2/4",       "sunny",    "moon",         "A4@1m",
    "A3@1m",     "tri-x-400", "hp5-plus", "d65",          "a",
    "N-BK7",     "N-SF6",     "0.5..0.6", "0.5..0.7",     "2stops",
    "3stops",    "rms",       "third",    "half",         "mtf@20",
    "mtf@40/mm", "a.csv",     "b.csv",    "double-gauss", "cooke-triplet-50",
    "100x75mm",  "80x60mm",   "f 9cm",    "f 8cm",
};
enum { VALUE_COUNT = sizeof values / sizeof values[0] };

/* A command's input with one option given, and rows of one column read beside it. */
struct asked {
    struct arguments arguments;
    struct reader reader;
    char *constants, *input;
    const struct option *option;
    const struct sheet *sheet;
};

static struct asked ask(const struct command *command, const struct option *option,
                        const char *value)
{
    struct asked asked = {.reader = {.db = &db, .arena = &arena, .lenses = &lenses},
                          .option = option,
                          .sheet = &command->sheet};
    struct error error;
    char word[80];
    snprintf(word, sizeof word, "--%s%s%s", option->name, option->kind == &kind_flag ? "" : "=",
             option->kind == &kind_flag ? "" : value);
    char *words[] = {word};
    CHECK(arguments_parse(&asked.arguments, command, 1, words, &arena, &error));
    asked.constants = arena_array(&arena, 1, command->input_size);
    asked.input = arena_array(&arena, 1, command->input_size);
    for (size_t i = 0; i < command->option_count; i++) {
        option_clear(&command->options[i], asked.constants + command->options[i].offset);
    }
    CHECK(option_read(&asked.reader, option, text_of(value), asked.constants + option->offset,
                      &error));
    memcpy(asked.input, asked.constants, command->input_size);
    return asked;
}

static bool open_rows(struct asked *asked, const char *text, struct batch *batch,
                      struct error *error)
{
    int ends[2] = {-1, -1};
    const size_t length = strlen(text);
    CHECK(pipe(ends) == 0 && write(ends[1], text, length) == (ssize_t)length);
    close(ends[1]);
    const char *path = arena_printf(&arena, "/dev/fd/%d", ends[0]);
    *batch = (struct batch){.arguments = &asked->arguments,
                            .reader = &asked->reader,
                            .arena = &arena,
                            .commands = commands,
                            .constants = asked->constants};
    const bool is_open = batch_open(batch, path, BATCH_AUTO, error);
    close(ends[0]);
    return is_open;
}

static bool is_constant(const struct asked *asked)
{
    const struct option *option = asked->option;
    return memcmp(asked->input + option->offset, asked->constants + option->offset,
                  option->kind->size) == 0;
}

/* A filled cell wins over the option, an empty one leaves it, whatever the column is called. */
static bool fills(struct asked *asked, const char *name, const char *cell)
{
    struct batch batch = {0};
    struct error error;
    const char *text = arena_printf(&arena, "\"%s\",x y\n%s,1\n,1\n%s,1\n,2\n", name, cell, cell);
    bool good = open_rows(asked, text, &batch, &error) && batch_has(&batch, asked->option->name) &&
                batch_settle(&batch, asked->sheet, false, &error);
    for (int i = 0; i < 4 && good; i++) {
        good = batch_next(&batch, asked->input, &error) == BATCH_ROW &&
               is_constant(asked) == (i % 2 == 1);
    }
    batch_close(&batch);
    return good;
}

static const char *with_underscores(const char *name)
{
    char *other = arena_string(&arena, name, strlen(name));
    for (char *c = other; *c != '\0'; c++) {
        *c = *c == '-' ? '_' : *c;
    }
    return other;
}

static void check_name(const struct command *command, struct asked *asked, const char *name,
                       const char *cell)
{
    const bool good = fills(asked, name, cell);
    CHECK(good);
    if (!good) {
        printf("    %s --%s, column '%s' with '%s'\n", command->name, asked->option->name, name,
               cell);
    }
}

/* Two values that differ; false where there are no two in the list. */
static bool find_values(const struct option *option, const char *found[2])
{
    struct reader reader = {.db = &db, .arena = &arena, .lenses = &lenses};
    char *member[2] = {arena_array(&arena, 1, option->kind->size),
                       arena_array(&arena, 1, option->kind->size)};
    size_t count = 0, words = 0;
    struct error error;
    while (option_word(option, words) != NULL) {
        words++;
    }
    for (size_t i = 0; i < words + VALUE_COUNT && count < 2; i++) {
        const char *value = i < words ? option_word(option, i)->word : values[i - words];
        option_clear(option, member[count]);
        if (option_read(&reader, option, text_of(value), member[count], &error) &&
            (count == 0 || memcmp(member[0], member[1], option->kind->size) != 0)) {
            found[count++] = value;
        }
    }
    return count == 2;
}

/* A choice of one thing only. */
static bool has_one_word(const struct option *option)
{
    return option_word(option, 0) != NULL && option_word(option, 1) == NULL;
}

static const struct {
    const char *tag, *option;
} tags[] = {
    {"FNumber", "aperture"},
    {"EXIF:FNumber", "aperture"},
    {"Composite:Aperture", "aperture"},
    {"ExifIFD:ExposureTime", "time"},
    {"ShutterSpeed", "time"},
    {"EXIF:ExifIFD:FocalLength", "focal-length"},
    {"Focal Length", "focal-length"},
    {"SubjectDistance", "distance"},
    {"Nikon:FocusDistance", "distance"},
    {"IFD0:Model", "sensor"},
    {"Camera Model Name", "sensor"},
    {"ISO", "iso"},
    /* what people write over the columns of spreadsheets */
    {"F-stop", "aperture"},
    {"f/stop", "aperture"},
    {"f/#", "aperture"},
    {"F number", "aperture"},
    {"f/No.", "aperture"},
    {"Focal ratio", "aperture"},
    {"Aperture (f/)", "aperture"},
    {"Aperture (f-stop)", "aperture"},
    {"FL (mm)", "focal-length"},
    {"EFL", "focal-length"},
    {"Focal length (Millimeters)", "focal-length"},
    {"Focal length (f)", "focal-length"},
    {"Focal length in mm", "focal-length"},
    {"Subject distance", "distance"},
    {"Distance to subject (m)", "distance"},
    {"Distance\n(m)", "distance"},
    {"Distance (Feet)", "distance"},
    {"Shutter", "time"},
    {"Shutter speed (s)", "time"},
    {"Exposure time (sec)", "time"},
    {"Film speed", "iso"},
    {"ISO (ASA)", "iso"},
    {"Camera", "sensor"},
    {"Sensor size", "sensor"},
    {"Circle of confusion (mm)", "coc"},
    {"Pupil ratio", "pupil"},
};

static void check_option(const struct command *command, const struct option *option)
{
    const char *found[2];
    const bool is_known = find_values(option, found);
    CHECK(is_known || has_one_word(option));
    if (!is_known) {
        printf("    %s --%s: no two values\n", command->name, option->name);
        return;
    }
    /* a flag that is given is true */
    const bool is_flag = option->kind == &kind_flag;
    struct asked asked = ask(command, option, is_flag ? "true" : found[0]);
    const char *cell = is_flag ? "false" : found[1];
    const char letter[2] = {option->letter, '\0'};
    check_name(command, &asked, option->name, cell);
    check_name(command, &asked, with_underscores(option->name), cell);
    if (option->letter != '\0') {
        check_name(command, &asked, letter, cell);
    }
    if (option->column != NULL) {
        check_name(command, &asked, option->column, cell);
    }
    for (size_t i = 0; i < sizeof tags / sizeof tags[0]; i++) {
        if (strcmp(tags[i].option, option->name) == 0) {
            check_name(command, &asked, tags[i].tag, cell);
        }
    }
    const struct unit *unit = option_unit(option);
    if (option->kind == &kind_quantity && unit != NULL && unit->name[0] != '\0') {
        const char *name = with_underscores(option->name);
        check_name(command, &asked, arena_printf(&arena, "%s_%s", name, unit->name), cell);
        check_name(command, &asked, arena_printf(&arena, "%s (%s)", name, unit->name), cell);
        check_name(command, &asked, arena_printf(&arena, "%s [%s]", name, unit->label), cell);
        check_name(command, &asked, arena_printf(&arena, "%s %s", name, unit->name), cell);
        check_name(command, &asked, arena_printf(&arena, "%s in %s", name, unit->name), cell);
        check_name(command, &asked, arena_printf(&arena, "%s, %s", name, unit->name), cell);
        check_name(command, &asked, arena_printf(&arena, "%s/%s", name, unit->name), cell);
    }
}

static void check_commands(void)
{
    size_t count = 0;
    for (size_t i = 0; commands[i] != NULL; i++) {
        const struct command *command = commands[i];
        bool has_batch = false;
        const struct option *common = NULL;
        while ((common = command_next_common(command, common)) != NULL) {
            has_batch = has_batch || strcmp(common->name, "batch") == 0;
        }
        for (size_t k = 0; k < command->option_count && has_batch; k++) {
            check_option(command, &command->options[k]);
            count++;
        }
    }
    CHECK(count > 400);
}

int main(void)
{
    check_commands();
    arena_free(&arena);
    return check_report();
}
