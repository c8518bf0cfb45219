/* exchange/lens_open.h - lenses by name: the user's folder, the embedded ones, files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_EXCHANGE_LENS_OPEN_H
#define LENSCALC_EXCHANGE_LENS_OPEN_H

#include "data/lensdb.h"
#include "exchange/lens_formats.h"
#include "file/lens_file.h"

/*
 * The text of a lens.
 *
 * Given     name     with a '/' or '.lens' at its end a file, "-" standard input, else a name in
 *                    lensdb (case, blanks, '-' and '_' do not count), else a file of that name
 *           source   receives what to call it in messages, in the arena
 *           content  receives the text, in the arena or embedded
 * Errors    ERROR_IO: a file that cannot be read; ERROR_USAGE with a suggestion: no such lens
 */
bool lens_open_text(struct lensdb *db, struct text name, struct arena *arena, const char **source,
                    struct text *content, struct error *error);

/* The file that a name stands for, whether there is one or not; null: what is embedded. */
const char *lens_open_path(struct lensdb *db, struct text name, struct arena *arena);

/*
 * Find and read a lens, also one of another program; where db->lossy, what is lost goes to
 * db->losses. Errors as lens_open_text and foreign_read.
 */
bool lens_open(struct lensdb *db, struct text name, struct arena *arena, struct lens *lens,
               struct error *error);

/* What --stop-size asks of a lens that was read. */
void lens_set_stop_size(struct lens *lens, enum stop_size size);

/* The names of all lenses of one place, sorted; an array in the arena that ends with null. */
bool lens_open_names(struct lensdb *db, enum lensdb_place place, struct arena *arena,
                     const char *const **names, struct error *error);

#endif
