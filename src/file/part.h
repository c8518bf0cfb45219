/* file/part.h - parts of a divided run: their files, and how they come together again. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_FILE_PART_H
#define LENSCALC_FILE_PART_H

#include "base/arena.h"
#include "base/digest.h"
#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { PART_MOST = 100000 };

/* Part `number` of `count`: 3/8. */
struct part {
    long number, count; /* 1 .. count, which is at most PART_MOST */
};

/*
 * Read "3/8".
 *
 * Errors    ERROR_USAGE with a caret: not two whole numbers, not 1 to count
 */
bool part_parse(struct text text, struct part *part, struct error *error);

/* Items begin .. end - 1 of a run; parts differ by one item at most, and may have none. */
struct part_range {
    uint64_t begin, end;
};

struct part_range part_range(struct part part, uint64_t total);

/* What must be the same in all parts of one run, and which part it is. */
struct part_head {
    struct text command, version;
    struct text words;        /* what the command was asked, as part_words writes it */
    struct digest_name input; /* of all that the result depends on, but seed and part */
    uint64_t seed;
    uint64_t total; /* items of the whole run */
    struct part part;
    uint64_t done; /* items of its range that are in it: all of them, or it is incomplete */
};

/*
 * Words of a command line in one line of printable characters, and back.
 *
 * Result    blanks, '\\', and what is not ASCII or not printable are \\ and three octal digits; an
 *           empty word is \\000. Back: null, where `count` words are not what the text is
 */
struct text part_words(char *const *words, int count, struct arena *arena);
char **part_split(struct text line, int *count, struct arena *arena);

/* A part's file: its head in lines of text, an empty line, and what the command makes of it. */
struct part_file {
    const char *path;
    struct part_head head;
    struct text body;
};

/* What stands before the body in a part's file, in the arena. */
struct text part_lines(const struct part_head *head, struct text body, struct arena *arena);

/* Does a file that begins so want to be one? */
bool part_is(struct text first);

/*
 * Read one.
 *
 * Given     path     for messages; content  what it holds; the file points into it
 * Errors    ERROR_DATA with the line: no part, a line of the head is missing or wrong, a body of
 *           another length or digest than the head says
 */
bool part_read(const char *path, struct text content, struct part_file *file, struct error *error);

/*
 * Is a part of a run?
 *
 * Given     run    a head of it, whose part and `done` do not count; `which` says which run it is
 * Errors    ERROR_DATA naming the file, and what is different: another command, question, version,
 *           input, seed, number of parts or of items
 */
bool part_is_of_run(const struct part_file *file, const struct part_head *run, const char *which,
                    struct arena *arena, struct error *error);

/*
 * Put the parts of a run in order.
 *
 * Given     files   count of them, at least one, in any order; they are sorted
 *           whole   all parts must be there, and complete
 * Errors    as part_is_of_run; ERROR_DATA naming the files: a part twice; a part that is
 *           incomplete; the parts that are missing
 */
bool parts_order(struct part_file *files, size_t count, bool whole, struct arena *arena,
                 struct error *error);

#endif
