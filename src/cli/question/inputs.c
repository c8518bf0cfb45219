/* cli/question/inputs.c - files that the words of a command name to be read. */
/* SPDX-License-Identifier: MIT */
#include "cli/question/inputs.h"

#include "exchange/lens_open.h"
#include "report/place.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Is this a name of that file? "-" is standard input's. */
static bool is_name_of(struct text name, const struct stat *file, struct arena *arena)
{
    const char *path = arena_string(arena, name.start, name.length);
    struct stat found;
    const bool is_there =
        strcmp(path, "-") == 0 ? fstat(STDIN_FILENO, &found) == 0 : stat(path, &found) == 0;
    return is_there && found.st_dev == file->st_dev && found.st_ino == file->st_ino;
}

/* A word is a name, or one with something behind a '=', or several. */
static bool word_names(struct text word, const struct stat *file, struct arena *arena)
{
    size_t sign = word.length;
    while (sign > 0 && word.start[sign - 1] != '=') {
        sign--;
    }
    bool found = is_name_of(word, file, arena) ||
                 (sign > 1 && is_name_of((struct text){word.start, sign - 1}, file, arena));
    while (word.start != NULL && !found) {
        found = is_name_of(text_trim(text_cut(&word, ',')), file, arena);
    }
    return found;
}

static bool inputs_reads(const struct argument *argument, struct lensdb *db,
                         const struct stat *file, struct arena *arena)
{
    const struct option *option = argument->option;
    const bool is_lens = option->kind == &kind_lens || option->kind == &kind_lens_text;
    if (!argument->is_given || (option->flags & OPTION_FILE) == 0 ||
        !(argument->is_input || argument->is_common) || strcmp(option->name, "output") == 0 ||
        strcmp(option->name, "plot") == 0) {
        return false;
    }
    bool found = false;
    for (struct text rest = argument->text; rest.start != NULL && !found;) {
        const struct text word = text_cut(&rest, OPTION_MANY_SEPARATOR);
        /* a lens is one of lensdb before it is a file */
        const char *path = is_lens ? lens_open_path(db, text_trim(word), arena) : NULL;
        found = is_lens ? path != NULL && is_name_of(text_of(path), file, arena)
                        : word_names(word, file, arena);
    }
    return found;
}

bool inputs_spare(const struct arguments *arguments, struct lensdb *db, bool force,
                  const char *path, struct arena *arena, struct error *error)
{
    struct stat file;
    if (force || path == NULL || !place_is_file(path, arena) || stat(path, &file) != 0) {
        return true;
    }
    for (size_t i = 0; i < arguments->photograph_count; i++) {
        if (is_name_of(text_of(arguments->photographs[i]), &file, arena)) {
            return fail(error, ERROR_IO, "%s is also read: --force overwrites it", path);
        }
    }
    for (size_t i = 0; i < arguments->count; i++) {
        if (inputs_reads(&arguments->all[i], db, &file, arena)) {
            return fail(error, ERROR_IO, "%s is also read: --force overwrites it", path);
        }
    }
    return true;
}
