/* data/agf_catalogs.c - the AGF files of the user. */
/* SPDX-License-Identifier: MIT */
#include "data/agf.h"

#include "data/whole_file.h"

#include <errno.h>
#include <string.h>

/* `end` is where the list ends. */
static bool agf_catalogs_add(struct lensdb *db, const char *path, const struct agf_catalog *first,
                             const struct agf_catalog ***end, struct error *error)
{
    struct text content;
    struct agf_catalog *catalog = ARENA_NEW(db->arena, struct agf_catalog);
    if (!whole_file(path, db->arena, &content, error)) {
        return error->code == ERROR_NONE &&
               fail(error, ERROR_IO, "cannot read %s: %s", path, strerror(ENOENT));
    }
    if (!agf_read(path, content, db->arena, catalog, error)) {
        return false;
    }
    for (const struct agf_catalog *one = first; one != NULL; one = one->next) {
        if (text_same_name(one->name, catalog->name)) {
            fail(error, ERROR_USAGE, "two glass catalogues are called %.*s: %s and %s",
                 (int)one->name.length, one->name.start, one->source, path);
            return error_hint(error, "a catalogue has the name of its file");
        }
    }
    /* Say which glasses are left out. */
    const size_t most = 20;
    db->losses.arena = db->arena;
    for (size_t i = 0; i < catalog->damaged_count && i < most; i++) {
        const struct error *one = &catalog->damaged[i].error;
        struct error line; /* printable */
        fail(&line, one->code, "%s:%ld: %s; the glass '%.*s' is left out", one->source, one->line,
             one->message, text_shown(catalog->damaged[i].name), catalog->damaged[i].name.start);
        growing_format(&db->losses, "%s\n", line.message);
    }
    if (catalog->damaged_count > most) {
        growing_format(&db->losses, "%s: %zu more glasses are left out\n", catalog->source,
                       catalog->damaged_count - most);
    }
    **end = catalog;
    *end = &catalog->next;
    return true;
}

bool agf_catalogs(struct lensdb *db, const struct agf_catalog **first, struct error *error)
{
    const struct agf_catalog *list = NULL, **end = &list;
    const char *const *names;
    *first = db->agf_catalogs;
    if (db->agf_is_read) {
        return true;
    }
    struct text rest = text_of(db->agf != NULL ? db->agf : "");
    while (rest.start != NULL && rest.length > 0) {
        struct text path = text_cut(&rest, ',');
        if (path.length > 0 &&
            !agf_catalogs_add(db, arena_string(db->arena, path.start, path.length), list, &end,
                              error)) {
            return false;
        }
    }
    if (!lensdb_list(db, "glass", ".agf", false, &names, error)) {
        return false;
    }
    for (; *names != NULL; names++) {
        if (!agf_catalogs_add(db, arena_printf(db->arena, "%s/%s", db->directory, *names), list,
                              &end, error)) {
            return false;
        }
    }
    db->agf_is_read = true;
    *first = db->agf_catalogs = list;
    return true;
}
