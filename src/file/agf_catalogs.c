/* file/agf_catalogs.c - the AGF files of the user. */
/* SPDX-License-Identifier: MIT */
#include "file/agf_catalogs.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_USER_CATALOGS = 1000 };

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

static bool ends_with(const char *name, const char *ending)
{
    size_t length = strlen(name), last = strlen(ending);
    return length > last && text_same(text_of(name + length - last), ending);
}

bool agf_catalog_files(const struct lensdb *db, const char *ending, struct arena *arena,
                       const char ***names, struct error *error)
{
    *names = ARENA_ARRAY(arena, MOST_USER_CATALOGS + 1, const char *);
    if (db->directory == NULL) {
        return true;
    }
    const char *path = arena_printf(arena, "%s/glass", db->directory);
    DIR *folder = opendir(path);
    if (folder == NULL) {
        return errno == ENOENT || errno == ENOTDIR ||
               fail(error, ERROR_IO, "cannot read the folder %s: %s", path, strerror(errno));
    }
    size_t count = 0;
    for (struct dirent *entry = readdir(folder); entry != NULL && count < MOST_USER_CATALOGS;
         entry = readdir(folder)) {
        if (entry->d_name[0] != '.' && ends_with(entry->d_name, ending)) {
            (*names)[count++] = arena_printf(arena, "glass/%s", entry->d_name);
        }
    }
    closedir(folder);
    qsort(*names, count, sizeof **names, by_name);
    return true;
}

/* A list that grows at its end. */
struct list {
    const struct agf_catalog *first;
    struct agf_catalog *last;
};

static bool add(struct lensdb *db, const char *path, struct list *list, struct error *error)
{
    struct text content;
    struct agf_catalog *catalog = ARENA_NEW(db->arena, struct agf_catalog);
    if (!lensdb_read_file(db, path, &content, error)) {
        return error->code == ERROR_NONE &&
               fail(error, ERROR_IO, "cannot read %s: %s", path, strerror(ENOENT));
    }
    if (!agf_read(path, content, db->arena, catalog, error)) {
        return false;
    }
    for (const struct agf_catalog *one = list->first; one != NULL; one = one->next) {
        if (text_same_name(one->name, catalog->name)) {
            fail(error, ERROR_USAGE, "two glass catalogues are called %.*s: %s and %s",
                 (int)one->name.length, one->name.start, one->source, path);
            return error_hint(error, "a catalogue has the name of its file");
        }
    }
    if (list->last != NULL) {
        list->last->next = catalog;
    } else {
        list->first = catalog;
    }
    list->last = catalog;
    return true;
}

bool agf_catalogs(struct lensdb *db, const struct agf_catalog **first, struct error *error)
{
    struct list list = {NULL, NULL};
    const char **names;
    *first = db->agf_catalogs;
    if (db->agf_is_read) {
        return true;
    }
    struct text rest = text_of(db->agf != NULL ? db->agf : "");
    while (rest.start != NULL && rest.length > 0) {
        struct text path = text_cut(&rest, ',');
        if (path.length > 0 &&
            !add(db, arena_string(db->arena, path.start, path.length), &list, error)) {
            return false;
        }
    }
    if (!agf_catalog_files(db, ".agf", db->arena, &names, error)) {
        return false;
    }
    for (; *names != NULL; names++) {
        if (!add(db, arena_printf(db->arena, "%s/%s", db->directory, *names), &list, error)) {
            return false;
        }
    }
    db->agf_is_read = true;
    *first = db->agf_catalogs = list.first;
    return true;
}
