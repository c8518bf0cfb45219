/* exchange/lens_open.c - lenses by name: the user's folder, the embedded ones, files. */
/* SPDX-License-Identifier: MIT */
#include "exchange/lens_open.h"

#include "data/embedded.h"
#include "data/whole_file.h"
#include "exchange/lens_formats.h"
#include "file/lens_glass.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char folder[] = "lenses/", ending[] = ".lens";
enum { FOLDER_LENGTH = sizeof folder - 1, ENDING_LENGTH = sizeof ending - 1 };

static bool ends_as_lens(struct text name)
{
    return name.length > ENDING_LENGTH &&
           memcmp(name.start + name.length - ENDING_LENGTH, ending, ENDING_LENGTH) == 0;
}

/* "lenses/double-gauss.lens" -> "double-gauss"; empty for other files. */
static struct text embedded_lens(const struct embedded_file *file)
{
    struct text name = text_of(file->name);
    if (strncmp(file->name, folder, FOLDER_LENGTH) != 0 || !ends_as_lens(name)) {
        return (struct text){file->name, 0};
    }
    return (struct text){file->name + FOLDER_LENGTH, name.length - FOLDER_LENGTH - ENDING_LENGTH};
}

/* Is it a file's, whatever lensdb has? */
static bool is_path(struct text name)
{
    return memchr(name.start, '/', name.length) != NULL || ends_as_lens(name);
}

static const char *lens_open_copy(struct arena *arena, struct text text)
{
    return arena_string(arena, text.start, text.length);
}

/* Those of the user, without folder and ending. */
static bool user_names(struct lensdb *db, struct arena *arena, const char ***names, size_t *count,
                       struct error *error)
{
    const char *const *files;
    if (!lensdb_list(db, "lenses", ending, true, &files, error)) {
        return false;
    }
    while (files[*count] != NULL) {
        ++*count;
    }
    *names = ARENA_ARRAY(arena, *count + 1, const char *);
    for (size_t i = 0; i < *count; i++) {
        const struct text name = text_of(files[i]);
        (*names)[i] =
            lens_open_copy(arena, (struct text){name.start + FOLDER_LENGTH,
                                                name.length - FOLDER_LENGTH - ENDING_LENGTH});
    }
    return true;
}

bool lens_open_names(struct lensdb *db, enum lensdb_place place, struct arena *arena,
                     const char *const **names, struct error *error)
{
    static const char *const none[] = {NULL};
    const char **all = NULL;
    size_t count = 0;
    if (place == LENSDB_USER) {
        if (db->directory != NULL && !user_names(db, arena, &all, &count, error)) {
            return false;
        }
    } else {
        size_t files = 0;
        while (embedded_files[files].name != NULL) {
            files++;
        }
        all = ARENA_ARRAY(arena, files + 1, const char *);
        for (size_t i = 0; i < files; i++) {
            struct text name = embedded_lens(&embedded_files[i]);
            if (name.length > 0) {
                all[count++] = lens_open_copy(arena, name);
            }
        }
    }
    *names = none;
    if (all != NULL) {
        qsort(all, count, sizeof all[0], text_order);
        *names = all;
    }
    return true;
}

static bool find_user(struct lensdb *db, struct text name, struct arena *arena, const char **source,
                      struct text *content, struct error *error)
{
    const char *file;
    error->code = ERROR_NONE;
    if (!lensdb_find(db, "lenses", ending, name, &file, error) || file == NULL) {
        return false;
    }
    *source = ARENA_JOIN(arena, db->directory, "/", file);
    return regular_file(*source, WHOLE_FILE_MOST, arena, content, error) ||
           (error->code == ERROR_NONE &&
            fail(error, ERROR_IO, "cannot read %s: %s", *source, strerror(ENOENT)));
}

static bool find_embedded(struct text name, const char **source, struct text *content)
{
    for (const struct embedded_file *file = embedded_files; file->name != NULL; file++) {
        struct text known = embedded_lens(file);
        if (known.length > 0 && text_same_name(known, name)) {
            *source = file->name;
            *content = (struct text){file->data, file->length};
            return true;
        }
    }
    return false;
}

static bool fail_unknown(struct lensdb *db, struct text name, struct arena *arena,
                         struct error *error)
{
    struct nearest nearest = {.typed = name};
    for (int place = 0; place < LENSDB_PLACES; place++) {
        const char *const *names;
        struct error ignored;
        if (lens_open_names(db, (enum lensdb_place)place, arena, &names, &ignored)) {
            for (; *names != NULL; names++) {
                nearest_offer(&nearest, text_of(*names));
            }
        }
    }
    fail(error, ERROR_USAGE, "no lens '%.*s' in lensdb, and no file of that name", text_shown(name),
         name.start);
    if (nearest.best.start != NULL) {
        return error_hint(error, "did you mean '%.*s'?", (int)nearest.best.length,
                          nearest.best.start);
    }
    return error_hint(error, "see 'lenscalc list lenses'");
}

/* A name that ends as files of lenses do is no misspelt name of lensdb. */
static bool ends_as_file(struct text name)
{
    for (size_t i = 0; lens_types(i) != NULL; i++) {
        if (file_type_ends(name, lens_types(i)->ending)) {
            return true;
        }
    }
    return false;
}

bool lens_open_text(struct lensdb *db, struct text name, struct arena *arena, const char **source,
                    struct text *content, struct error *error)
{
    const char *path = lens_open_copy(arena, name);
    if (text_equal(name, "-")) {
        *source = "standard input";
        return whole_stream(STDIN_FILENO, *source, arena, content, error);
    }
    bool is_file = is_path(name);
    if (!is_file) {
        if (find_user(db, name, arena, source, content, error)) {
            return true;
        }
        if (error->code != ERROR_NONE) {
            return false;
        }
        if (find_embedded(name, source, content)) {
            return true;
        }
    }
    *source = path;
    if (whole_file(path, arena, content, error)) {
        return true;
    }
    if (error->code != ERROR_NONE) {
        return false;
    }
    return is_file || ends_as_file(name)
               ? fail(error, ERROR_IO, "cannot read %s: %s", path, strerror(ENOENT))
               : fail_unknown(db, name, arena, error);
}

const char *lens_open_path(struct lensdb *db, struct text name, struct arena *arena)
{
    const char *file, *embedded;
    struct text content;
    struct error ignored;
    if (is_path(name) || text_equal(name, "-")) {
        return lens_open_copy(arena, name);
    }
    if (lensdb_find(db, "lenses", ending, name, &file, &ignored) && file != NULL) {
        return ARENA_JOIN(arena, db->directory, "/", file);
    }
    return find_embedded(name, &embedded, &content) ? NULL : lens_open_copy(arena, name);
}

struct lensdb_told {
    const char *source;
    struct lensdb_told *next;
};

/* List what a file lost, once, however often it is read. */
static void tell_losses(struct lensdb *db, const struct foreign_job *job)
{
    for (const struct lensdb_told *told = db->told_of; told != NULL; told = told->next) {
        if (strcmp(told->source, job->source) == 0) {
            return;
        }
    }
    struct lensdb_told *told = ARENA_NEW(db->arena, struct lensdb_told);
    *told = (struct lensdb_told){lens_open_copy(db->arena, text_of(job->source)), db->told_of};
    db->told_of = told;
    db->losses.arena = db->arena;
    foreign_losses(job, &db->losses);
}

void lens_set_stop_size(struct lens *lens, enum stop_size size)
{
    if (size != STOP_SIZE_OF_LENS) {
        lens->stop_is_real = size == STOP_SIZE_REAL;
    }
}

bool lens_open(struct lensdb *db, struct text name, struct arena *arena, struct lens *lens,
               struct error *error)
{
    const char *source;
    struct text content;
    struct lens_glasses place = {db, arena};
    const struct glass_source glasses = lens_glass_source(&place);
    if (!lens_open_text(db, name, arena, &source, &content, error)) {
        return false;
    }
    struct foreign_job job = {.source = source,
                              .arena = arena,
                              .glasses = &glasses,
                              .reads_beside = text_equal(name, source), /* else no file */
                              .lossy = db->lossy,
                              .glass_numbers = db->glass_numbers};
    if (!foreign_read(&job, content, lens, error)) {
        return false;
    }
    if (job.loss_count > 0) {
        tell_losses(db, &job);
    }
    lens_set_stop_size(lens, db->stop_size);
    return true;
}
