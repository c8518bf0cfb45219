/* data/lensdb.c - the program's data, and the user's own in front of it. */
/* SPDX-License-Identifier: MIT */
#include "data/lensdb.h"

#include "base/name_table.h"
#include "base/number.h"
#include "data/embedded.h"
#include "data/folder.h"
#include "data/whole_file.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A file of the user's folder, or the knowledge that there is none. */
struct lensdb_file {
    const char *name, *path;
    struct text content; /* start is null where there is no such file */
    struct lensdb_file *next;
};

static bool check_directory(const char *directory, struct error *error)
{
    struct stat status;
    if (stat(directory, &status) != 0) {
        return fail(error, ERROR_IO, "cannot read the folder %s: %s", directory, strerror(errno));
    }
    if (!S_ISDIR(status.st_mode)) {
        return fail(error, ERROR_IO, "cannot read %s: not a folder", directory);
    }
    return true;
}

/* What a folder of the user's folder has with an ending. */
struct lensdb_folder {
    const char *folder, *ending;
    const char **all, **files; /* all, and those that can be read; each ends with null */
    const char **named;        /* the first of each of `names` */
    size_t count, file_count;
    struct name_table names; /* without folder and ending */
    bool is_told;            /* what cannot be read */
    struct lensdb_folder *next;
};

static void lensdb_make_room(struct lensdb *db, struct lensdb_folder *known, size_t count)
{
    known->all = ARENA_ARRAY(db->arena, count + 1, const char *);
    known->files = ARENA_ARRAY(db->arena, count + 1, const char *);
    known->named = ARENA_ARRAY(db->arena, count + 1, const char *);
}

static bool read_folder(struct lensdb *db, struct lensdb_folder *known, struct error *error)
{
    struct folder_entry *entries;
    size_t count;
    const char *path = ARENA_JOIN(db->arena, db->directory, "/", known->folder);
    if (access(path, F_OK) != 0 && (errno == ENOENT || errno == ENOTDIR)) {
        return check_directory(db->directory, error);
    }
    if (!folder_read(path, NULL, db->arena, &entries, &count, error)) {
        return false;
    }
    lensdb_make_room(db, known, count);
    for (size_t i = 0; i < count; i++) {
        size_t length = strlen(entries[i].name), last = strlen(known->ending);
        if (length > last && text_same(text_of(entries[i].name + length - last), known->ending)) {
            const struct folder_entry *entry = &entries[i];
            const char *name = ARENA_JOIN(db->arena, known->folder, "/", entry->name);
            const struct text bare = {entry->name, strlen(entry->name) - strlen(known->ending)};
            known->all[known->count++] = name;
            if (name_table_find(&known->names, bare) == NAME_NONE) {
                known->named[name_table_add(&known->names, bare, db->arena)] = name;
            }
            if (entry->kind == FOLDER_FILE && access(entry->path, R_OK) == 0) {
                known->files[known->file_count++] = name;
            }
        }
    }
    return true;
}

/* It is read when it is first asked for. */
static struct lensdb_folder *folder_of(struct lensdb *db, const char *folder, const char *ending,
                                       struct error *error)
{
    struct lensdb_folder *known = db->folders;
    while (known != NULL &&
           (strcmp(known->folder, folder) != 0 || strcmp(known->ending, ending) != 0)) {
        known = known->next;
    }
    if (known != NULL) {
        return known;
    }
    known = ARENA_NEW(db->arena, struct lensdb_folder);
    *known = (struct lensdb_folder){.folder = folder, .ending = ending, .next = db->folders};
    lensdb_make_room(db, known, 0);
    if (db->directory != NULL && !read_folder(db, known, error)) {
        return NULL;
    }
    db->folders = known;
    return known;
}

bool lensdb_list(struct lensdb *db, const char *folder, const char *ending, bool all,
                 const char *const **names, struct error *error)
{
    struct lensdb_folder *known = folder_of(db, folder, ending, error);
    if (known == NULL) {
        return false;
    }
    if (!all) {
        /* Say once what is left out. */
        db->losses.arena = db->arena;
        for (size_t i = 0, file = 0; i < known->count && !known->is_told; i++) {
            const char *path = ARENA_JOIN(db->arena, db->directory, "/", known->all[i]);
            struct text content;
            struct error line;
            if (known->files[file] == known->all[i]) {
                file++;
            } else if (!regular_file(path, WHOLE_FILE_MOST, db->arena, &content, &line)) {
                growing_format(
                    &db->losses, "%s; it is left out\n",
                    line.code != ERROR_NONE
                        ? line.message
                        : arena_printf(db->arena, "cannot read %s: %s", path, strerror(ENOENT)));
            }
        }
        known->is_told = true;
    }
    *names = all ? known->all : known->files;
    return true;
}

bool lensdb_find(struct lensdb *db, const char *folder, const char *ending, struct text name,
                 const char **file, struct error *error)
{
    const struct lensdb_folder *known = folder_of(db, folder, ending, error);
    *file = NULL;
    if (known == NULL) {
        return false;
    }
    size_t at = name_table_find(&known->names, name);
    for (size_t i = 0; i < known->names.count && at == NAME_NONE; i++) {
        at = text_same_name(known->names.names[i], name) ? i : NAME_NONE;
    }
    *file = at != NAME_NONE ? known->named[at] : NULL;
    return true;
}

static bool lensdb_load(struct lensdb *db, const char *name, struct lensdb_file **found,
                        struct error *error)
{
    for (struct lensdb_file *file = db->loaded; file != NULL; file = file->next) {
        if (strcmp(file->name, name) == 0) {
            *found = file;
            return true;
        }
    }
    struct lensdb_file *file = ARENA_NEW(db->arena, struct lensdb_file);
    file->name = arena_string(db->arena, name, strlen(name));
    file->path = arena_printf(db->arena, "%s/%s", db->directory, name);
    if (!regular_file(file->path, WHOLE_FILE_MOST, db->arena, &file->content, error) &&
        (error->code != ERROR_NONE || !check_directory(db->directory, error))) {
        return false;
    }
    file->next = db->loaded;
    db->loaded = file;
    *found = file;
    return true;
}

static bool open_user(struct lensdb *db, const char *name, struct tsv *tsv, struct error *error)
{
    struct lensdb_file *file = NULL;
    if (db->directory == NULL || !lensdb_load(db, name, &file, error) ||
        file->content.start == NULL) {
        return false;
    }
    return tsv_open(tsv, file->path, file->content, error);
}

bool lensdb_open(struct lensdb *db, enum lensdb_place place, const char *file, struct tsv *tsv,
                 struct error *error)
{
    error->code = ERROR_NONE;
    if (place == LENSDB_USER) {
        return open_user(db, file, tsv, error);
    }
    for (const struct embedded_file *at = embedded_files; at->name != NULL; at++) {
        if (strcmp(at->name, file) == 0) {
            return tsv_open(tsv, at->name, (struct text){at->data, at->length}, error);
        }
    }
    return false;
}

bool lensdb_table_open(struct lensdb_table *table, struct lensdb *db, enum lensdb_place place,
                       const char *file, const char *const *names, size_t count, size_t needed,
                       struct error *error)
{
    table->place = place;
    return lensdb_open(db, place, file, &table->tsv, error) &&
           tsv_columns(&table->tsv, names, count, needed, table->columns, error);
}

struct text lensdb_table_cell(const struct lensdb_table *table, int column)
{
    return tsv_cell(&table->tsv, table->columns[column]);
}

bool lensdb_table_number(const struct lensdb_table *table, int column, double low, double high,
                         double *value, struct error *error)
{
    const size_t at = table->columns[column];
    if (!tsv_number(&table->tsv, at, value, error)) {
        return false;
    }
    return !(*value < low || *value > high) || tsv_fail(&table->tsv, at, error, "is out of range");
}

/* "1/125" or "0.3" or "5.6". */
static bool value_in_label(struct text label, double *value)
{
    const char *end = label.start + label.length;
    const char *after = number_read(label.start, end, NUMBER_UNSCALED, value);
    if (after != NULL && after < end && *after == '/') {
        double denominator;
        after = number_read(after + 1, end, NUMBER_UNSCALED, &denominator);
        *value /= denominator;
    }
    return after == end && *value > 0;
}

static double exact_stop(const char *file, int step, int divisor)
{
    double stops = (double)step / divisor;
    if (strcmp(file, "fstops.tsv") == 0) {
        return exp2(stops / 2);
    }
    return strcmp(file, "shutters.tsv") == 0 ? exp2(-stops) : 3.125 * exp2(stops);
}

static int divisor_of(const char *series)
{
    if (strcmp(series, "full") == 0) {
        return 1;
    }
    if (strcmp(series, "half") == 0) {
        return 2;
    }
    return 3;
}

static bool lensdb_read_stop(const struct tsv *tsv, const size_t *columns, const char *file,
                             const char *series, struct lensdb_stop *stop, struct error *error)
{
    double step;
    if (!tsv_number(tsv, columns[1], &step, error)) {
        return false;
    }
    if (!(fabs(step) <= 1000) || step != floor(step)) {
        return tsv_fail(tsv, columns[1], error, "must be a whole number from -1000 to 1000");
    }
    *stop = (struct lensdb_stop){.label = tsv->cells[columns[2]],
                                 .note = tsv->cells[columns[3]],
                                 .step = (int)step,
                                 .divisor = divisor_of(series)};
    stop->exact = exact_stop(file, stop->step, stop->divisor);
    if (!value_in_label(stop->label, &stop->value)) {
        return tsv_fail(tsv, columns[2], error, "is not a label of a stop series");
    }
    return true;
}

/* Read one table's rows of the series behind those already there. */
static bool lensdb_add_stops(struct lensdb *db, enum lensdb_place place, const char *file,
                             const char *series, struct lensdb_stop *stops, size_t most,
                             size_t *count, struct error *error)
{
    static const char *const names[] = {"series", "step", "label", "note"};
    struct tsv tsv;
    size_t columns[4];
    if (!lensdb_open(db, place, file, &tsv, error)) {
        return error->code == ERROR_NONE;
    }
    if (!tsv_columns(&tsv, names, 4, 4, columns, error)) {
        return false;
    }
    while (*count < most && tsv_next(&tsv, error)) {
        struct lensdb_stop *stop = &stops[*count];
        if (!text_equal(tsv.cells[columns[0]], series)) {
            continue;
        }
        if (!lensdb_read_stop(&tsv, columns, file, series, stop, error)) {
            return false;
        }
        stop->label.start = arena_string(db->arena, stop->label.start, stop->label.length);
        ++*count;
    }
    return error->code == ERROR_NONE;
}

/* A series is read once: a batch asks for it in every row. */
struct lensdb_series {
    const char *file, *name;
    struct lensdb_stop *stops;
    size_t count;
    struct lensdb_series *next;
};

bool lensdb_stops(struct lensdb *db, const char *file, const char *series,
                  struct lensdb_stop **stops, size_t *count, struct error *error)
{
    enum { MOST_STOPS = 512 };
    error->code = ERROR_NONE;
    for (const struct lensdb_series *at = db->series; at != NULL; at = at->next) {
        if (strcmp(at->file, file) == 0 && strcmp(at->name, series) == 0) {
            *stops = at->stops;
            *count = at->count;
            return true;
        }
    }
    *stops = ARENA_ARRAY(db->arena, MOST_STOPS, struct lensdb_stop);
    *count = 0;
    /* the user's series replaces the embedded one: two in one would not be a series */
    for (enum lensdb_place place = LENSDB_USER; place < LENSDB_PLACES && *count == 0; place++) {
        if (!lensdb_add_stops(db, place, file, series, *stops, MOST_STOPS, count, error)) {
            return false;
        }
    }
    struct lensdb_series *read = ARENA_NEW(db->arena, struct lensdb_series);
    *read = (struct lensdb_series){arena_string(db->arena, file, strlen(file)),
                                   arena_string(db->arena, series, strlen(series)), *stops, *count,
                                   db->series};
    db->series = read;
    return true;
}
