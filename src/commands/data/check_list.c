/* commands/data/check_list.c - the lens files of folders. */
/* SPDX-License-Identifier: MIT */
#include "commands/data/check_files.h"

#include "exchange/lens_formats.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { DEEPEST = 32 }; /* folders in folders; a link may lead around */

static bool is_folder(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

static void add_path(struct check_list *list, const char *path)
{
    list->paths =
        arena_grow(list->arena, list->paths, list->count, &list->room, sizeof list->paths[0]);
    list->paths[list->count++] = path;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

/* All names in a folder but hidden ones, sorted. */
static bool read_folder(const char *path, struct check_list *names, struct error *error)
{
    DIR *directory = opendir(path);
    if (directory == NULL) {
        return fail(error, ERROR_IO, "cannot read the folder %s: %s", path, strerror(errno));
    }
    for (struct dirent *entry = readdir(directory); entry != NULL; entry = readdir(directory)) {
        if (entry->d_name[0] != '.') {
            bool slash = path[0] != '\0' && path[strlen(path) - 1] == '/';
            add_path(names,
                     arena_printf(names->arena, "%s%s%s", path, slash ? "" : "/", entry->d_name));
        }
    }
    closedir(directory);
    if (names->count > 0) {
        qsort(names->paths, names->count, sizeof names->paths[0], by_name);
    }
    return true;
}

static bool add_folder(struct check_list *list, const char *path, int depth, struct error *error)
{
    struct check_list names = {.arena = list->arena};
    if (!read_folder(path, &names, error)) {
        return false;
    }
    for (size_t i = 0; i < names.count; i++) {
        if (is_folder(names.paths[i])) {
            if (depth < DEEPEST && !add_folder(list, names.paths[i], depth + 1, error)) {
                return false;
            }
        } else if (foreign_ends_as_lens(text_of(names.paths[i]))) {
            add_path(list, names.paths[i]);
        }
    }
    return true;
}

bool check_list_add(struct check_list *list, struct text path, struct error *error)
{
    const char *name = arena_string(list->arena, path.start, path.length);
    if (is_folder(name)) {
        return add_folder(list, name, 0, error);
    }
    add_path(list, name);
    return true;
}
