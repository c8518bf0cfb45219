/* cli/question/division.c - runs that are divided: what a part was asked, so that merge can ask it again. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/division.h"

#include "cli/question/arguments.h"
#include "data/whole_file.h"
#include "exchange/lens_open.h"
#include "report/version.h"

#include <string.h>
#include <sys/stat.h>

static const struct file_type part_type = {{"part", "a part of a divided run"}, ".part"};

const struct file_type *division_types(size_t i)
{
    return i == 0 ? &part_type : NULL;
}

/* -------- what was asked -------- */

/* Does the answer depend on it? */
static bool division_counts(const struct argument *argument)
{
    return argument->is_given && (argument->is_input || argument->is_common) &&
           (argument->option->flags & OPTION_ASIDE) == 0;
}

/* Does the division leave it out? */
static bool is_aside(const struct argument *argument, const char *const *aside)
{
    bool found = aside != NULL && argument->is_common;
    for (size_t i = 0; aside != NULL && aside[i] != NULL && !found; i++) {
        found = strcmp(aside[i], argument->option->name) == 0;
    }
    return found;
}

/* Options in the order of their declaration, --name=value; several words of one come last. */
static struct text division_words_of(const struct arguments *arguments, const char *const *aside,
                                     struct arena *arena)
{
    size_t room = 1;
    for (size_t i = 0; i < arguments->count; i++) {
        room += arguments->all[i].text.length + 1;
    }
    char **words = ARENA_ARRAY(arena, arguments->count + room, char *);
    const struct argument *many = NULL;
    int count = 0;
    for (size_t i = 0; i < arguments->count; i++) {
        const struct argument *argument = &arguments->all[i];
        const struct option *option = argument->option;
        if (!division_counts(argument) || is_aside(argument, aside)) {
            continue;
        }
        if ((option->flags & (OPTION_MANY | OPTION_TOGETHER)) != 0) {
            many = argument;
            continue;
        }
        words[count++] = option->kind == &kind_flag
                             ? ARENA_JOIN(arena, "--", option->name)
                             : arena_printf(arena, "--%s=%.*s", option->name,
                                            (int)argument->text.length, argument->text.start);
    }
    if (many != NULL) {
        words[count++] = arena_string(arena, "--", 2);
        for (struct text rest = many->text; rest.start != NULL;) {
            const struct text word = text_cut(&rest, OPTION_MANY_SEPARATOR);
            words[count++] = arena_string(arena, word.start, word.length);
        }
    }
    return part_words(words, count, arena);
}

/* -------- what it was asked of -------- */

static bool add_lens(const struct run *run, struct text name, struct arena *arena,
                     struct digest *digest, struct error *error)
{
    const char *source;
    struct text content;
    if (text_equal(name, "-")) {
        return fail(error, ERROR_USAGE,
                    "the lens of a divided run cannot come from standard input: it is read again "
                    "for each part");
    }
    if (!lens_open_text(run->db, name, arena, &source, &content, error)) {
        return false;
    }
    digest_item(digest, content);
    return true;
}

/* What a file holds; a name that no file has adds nothing. */
static bool add_file(struct text name, struct arena *arena, struct digest *digest,
                     struct error *error)
{
    const char *path = arena_string(arena, name.start, name.length);
    struct stat found;
    struct text content;
    if (stat(path, &found) != 0 || !S_ISREG(found.st_mode)) {
        return true;
    }
    if (!large_file(path, DIVISION_FILE_MOST, arena, &content, error)) {
        return error->code == ERROR_NONE;
    }
    digest_item(digest, content);
    return true;
}

/* Files that options name, one or a list. */
static bool add_files(const struct run *run, struct digest *digest, struct error *error)
{
    const struct arguments *arguments = run->arguments;
    struct arena arena = {0};
    bool done = true;
    for (size_t i = 0; i < arguments->count && done; i++) {
        const struct argument *argument = &arguments->all[i];
        if (!division_counts(argument) || (argument->option->flags & OPTION_FILE) == 0) {
            continue;
        }
        if (argument->option->kind == &kind_lens) {
            done = add_lens(run, text_trim(argument->text), &arena, digest, error);
            continue;
        }
        done = add_file(argument->text, &arena, digest, error);
        for (struct text rest = argument->text; rest.start != NULL && done;) {
            const struct text item = text_cut(&rest, ',');
            done = item.length == argument->text.length ||
                   add_file(text_trim(item), &arena, digest, error);
        }
    }
    arena_free(&arena);
    return done;
}

bool division_head(const struct run *run, const struct division *division, struct part_head *head,
                   struct error *error)
{
    struct digest digest;
    *head =
        (struct part_head){.command = text_of(run->arguments->command->name),
                           .version = text_of(LENSCALC_VERSION),
                           .words = division_words_of(run->arguments, division->aside, run->arena),
                           .seed = division->seed,
                           .total = division->total,
                           .part = division->part};
    digest_begin(&digest);
    digest_item(&digest, head->command);
    digest_item(&digest, head->version);
    digest_item(&digest, head->words);
    digest_item(&digest, division->facts);
    if (!add_files(run, &digest, error)) {
        return false;
    }
    head->input = digest_end(&digest);
    return true;
}

/* -------- files -------- */

bool division_read(const char *path, struct arena *arena, struct part_file *file,
                   struct error *error)
{
    struct text content;
    return file_of_kind(path, DIVISION_FILE_MOST, part_is, arena, &content, error) &&
           part_read(path, content, file, error);
}

bool division_found(const struct run *run, const struct part_head *head, const char *path,
                    const struct part_file **files, size_t *count, struct error *error)
{
    *files = run->parts;
    *count = run->part_count;
    if (run->parts == NULL && path != NULL) {
        struct part_file *file = ARENA_NEW(run->arena, struct part_file);
        if (!division_read(path, run->arena, file, error)) {
            return error->code == ERROR_NONE;
        }
        const struct part part = head->part, other = file->head.part;
        if (other.count == part.count && other.number != part.number) {
            return fail(error, ERROR_DATA, "%s is part %ld/%ld, not %ld/%ld", file->path,
                        other.number, other.count, part.number, part.count);
        }
        *files = file;
        *count = 1;
    }
    for (size_t i = 0; i < *count; i++) {
        if (!part_is_of_run(&(*files)[i], head, "a run of these words and files", run->arena,
                            error)) {
            return false;
        }
    }
    return true;
}

void division_write(const struct part_head *head, struct text body, struct arena *arena,
                    struct output *sink)
{
    const struct text lines = part_lines(head, body, arena);
    output_text(sink, lines.start, lines.length);
    output_text(sink, body.start, body.length);
}
