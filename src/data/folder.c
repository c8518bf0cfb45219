/* data/folder.c - what lies in a folder. */
/* SPDX-License-Identifier: MIT */
#include "data/folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool folder_exists(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* The reason is behind the path, which may be longer than a message. */
static bool fail_folder(const char *path, int why, struct error *error)
{
    const size_t most = 200;
    return fail(error, ERROR_IO, "cannot read the folder %.*s%s: %s", (int)most, path,
                strlen(path) > most ? ".." : "", strerror(why));
}

/* Was the folder read before? Links may lead around; device and inode are the same by any path. */
static bool folder_is_seen(DIR *directory, struct name_table *seen, struct arena *arena)
{
    struct stat status;
    if (seen == NULL || fstat(dirfd(directory), &status) != 0) {
        return false;
    }
    const char *key =
        arena_printf(arena, "%jx %jx", (uintmax_t)status.st_dev, (uintmax_t)status.st_ino);
    if (name_table_find(seen, text_of(key)) != NAME_NONE) {
        return true;
    }
    name_table_add(seen, text_of(key), arena);
    return false;
}

static enum folder_kind folder_kind_of(DIR *directory, const char *name)
{
    struct stat status;
    if (fstatat(dirfd(directory), name, &status, 0) != 0) {
        return FOLDER_FILE; /* which says why when it is opened */
    }
    if (S_ISDIR(status.st_mode)) {
        return FOLDER_FOLDER;
    }
    if (S_ISREG(status.st_mode)) {
        return FOLDER_FILE;
    }
    return FOLDER_OTHER;
}

/* The next name; null at the end with errno 0, or where it cannot be read. */
static const char *next_name(DIR *directory)
{
    errno = 0;
    const struct dirent *entry = readdir(directory);
    return entry != NULL ? entry->d_name : NULL;
}

static int folder_by_name(const void *a, const void *b)
{
    return strcmp(((const struct folder_entry *)a)->name, ((const struct folder_entry *)b)->name);
}

bool folder_read(const char *path, struct name_table *seen, struct arena *arena,
                 struct folder_entry **entries, size_t *count, struct error *error)
{
    const size_t length = strlen(path);
    const char *slash = length > 0 && path[length - 1] == '/' ? "" : "/";
    size_t room = 0;
    *entries = NULL;
    *count = 0;
    DIR *directory = opendir(path);
    const bool is_open = directory != NULL && faccessat(dirfd(directory), ".", X_OK, 0) == 0;
    if (!is_open) {
        fail_folder(path, errno, error);
        if (directory != NULL) {
            closedir(directory);
        }
        return false;
    }
    const bool again = folder_is_seen(directory, seen, arena);
    const char *name = next_name(directory);
    for (; name != NULL && !again; name = next_name(directory)) {
        if (name[0] != '.') {
            const char *whole = ARENA_JOIN(arena, path, slash, name);
            *ARENA_ADD(arena, *entries, *count, room) = (struct folder_entry){
                whole + length + strlen(slash), whole, folder_kind_of(directory, name)};
        }
    }
    const int wrong = errno;
    closedir(directory);
    if (wrong != 0) {
        return fail_folder(path, wrong, error);
    }
    if (*count > 0) {
        qsort(*entries, *count, sizeof **entries, folder_by_name);
    }
    return true;
}
