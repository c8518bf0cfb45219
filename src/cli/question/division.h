/* cli/question/division.h - runs that are divided: what a part was asked, so that merge can ask it again. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_DIVISION_H
#define LENSCALC_CLI_QUESTION_DIVISION_H

#include "base/file_type.h"
#include "cli/question/command.h"
#include "file/part.h"

/* MiB, of a part's file */
enum { DIVISION_FILE_MOST = 4096 };

/* The only type of files that parts have: .part. */
file_types division_types;

/* What a command says of its run; the rest is found here. */
struct division {
    struct part part;
    uint64_t seed, total; /* items of the whole run */
    struct text facts;    /* what else the result depends on: glasses, formats; may be empty */
    /* Options that only choose what is made of the items; ends with null. Where it is given, those
       that all commands have do not count either. Null: all of them count. */
    const char *const *aside;
};

/*
 * The head of a part of this run.
 *
 * Given     run   its arguments: their words are stored, but for options with OPTION_ASIDE and
 *                 artifacts
 * Result    head  `done` is 0; input: of command, version, words and facts, of the text of lenses,
 *                 and of what the files hold that options name
 * Errors    ERROR_USAGE: a lens from standard input; ERROR_IO: a file that cannot be read
 */
bool division_head(const struct run *run, const struct division *division, struct part_head *head,
                   struct error *error);

/*
 * What is there already of a run: the parts that are merged; else what it goes on from.
 *
 * Given     path  of the file that it goes on from; null: it begins anew
 * Result    count files, none if there is no file of that name
 * Errors    ERROR_IO; ERROR_DATA: a file that is no part, of another run, or of another part
 */
bool division_found(const struct run *run, const struct part_head *head, const char *path,
                    const struct part_file **files, size_t *count, struct error *error);

/*
 * Read the file of a part.
 *
 * Result    false with error->code ERROR_NONE if there is none of that name
 * Errors    ERROR_IO; as part_read
 */
bool division_read(const char *path, struct arena *arena, struct part_file *file,
                   struct error *error);

/* Write one: the body goes out as it is, not copied. */
void division_write(const struct part_head *head, struct text body, struct arena *arena,
                    struct output *sink);

#endif
