/* commands/design/cmd_merge.c - lenscalc merge: the parts of a divided run. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/arguments.h"
#include "cli/question/division.h"
#include "commands/commands.h"
#include "report/version.h"

struct merge_input {
    const char *files; /* separated by OPTION_MANY_SEPARATOR */
    const char *output;
    bool incomplete;
};

static const struct option options[] = {
    {OPTION(struct merge_input, files), .name = "parts", .value = "FILE", .types = division_types,
     .flags = OPTION_OPERAND | OPTION_TOGETHER | OPTION_FILE,
     .help = "all parts of a run, in any order"},
    {OPTION(struct merge_input, incomplete), .name = "incomplete",
     .help = "merge what there is, although parts are missing or incomplete"},
    {OPTION(struct merge_input, output), .name = "output", .letter = 'o', .value = "FILE",
     .flags = OPTION_FILE, .help = "file for the whole, as with the command that was divided"},
};

static bool again(const void *data, struct run *run, struct again *question, struct error *error)
{
    const struct merge_input *input = data;
    struct arena *arena = run->kept;
    struct part_file *files = NULL;
    size_t count = 0, room = 0;
    if (input->files == NULL) {
        fail(error, ERROR_USAGE, "no part is given");
        return error_hint(error, "name all of a run, as in 'lenscalc merge X*.part -o FILE'");
    }
    for (struct text rest = text_of(input->files); rest.start != NULL; count++) {
        const struct text name = text_cut(&rest, OPTION_MANY_SEPARATOR);
        const char *path = arena_string(arena, name.start, name.length);
        files = arena_grow(arena, files, count, &room, sizeof *files);
        if (!division_read(path, arena, &files[count], error)) {
            return error->code == ERROR_NONE ? fail(error, ERROR_IO, "there is no file %s", path)
                                             : false;
        }
    }
    if (!parts_order(files, count, !input->incomplete, arena, error)) {
        return false;
    }
    const struct part_head *head = &files[0].head;
    char **words = part_split(head->words, &question->count, arena);
    question->command = command_find(head->command);
    if (question->command == NULL || !question->command->is_divided || words == NULL) {
        return fail(error, ERROR_DATA,
                    "%s is of a command '%.*s' that this program does not divide", files[0].path,
                    text_shown(head->command), head->command.start);
    }
    if (!text_equal(head->version, LENSCALC_VERSION)) {
        return fail(error, ERROR_DATA, "%s was made by version %.*s, and this is %s", files[0].path,
                    text_shown(head->version), head->version.start, LENSCALC_VERSION);
    }
    question->words = ARENA_ARRAY(arena, (size_t)question->count + 2, char *);
    int all = 0;
    if (arguments_given(run->arguments, "force")) {
        question->words[all++] = ARENA_JOIN(arena, "--force");
    }
    if (input->output != NULL) {
        question->words[all++] = ARENA_JOIN(arena, "--output=", input->output);
    }
    for (int i = 0; i < question->count; i++) {
        question->words[all++] = words[i];
    }
    question->count = all;
    question->parts = files;
    question->part_count = count;
    return true;
}

static const struct example examples[] = {
    {"render chart:star --lens double-gauss-50 -s 3m --size 96x64 --part 1/2 -o half-1.part",
     "the first part, by one machine"},
    {"render chart:star --lens double-gauss-50 -s 3m --size 96x64 --part 2/2 -o half-2.part",
     "the second, by another"},
    {"merge half-*.part -o whole.png", "the picture"},
    {NULL, NULL},
};

const struct command command_merge = {
    .name = "merge",
    .group = "design",
    .summary = "combine the parts of a divided run",
    COMMAND_ASKS(struct merge_input),
    .again = again,
};
