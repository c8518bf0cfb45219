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
    struct digest_name input; /* of all that the result depends on, but seed and part */
    uint64_t seed;
    uint64_t total; /* items of the whole run */
    struct part part;
};

/* A part's file: its head in lines of text, an empty line, and what the command makes of it. */
struct part_file {
    const char *path;
    struct part_head head;
    struct text body;
};

/* The bytes of a part's file, in the arena. */
struct text part_write(const struct part_head *head, struct text body, struct arena *arena);

/*
 * Read one.
 *
 * Given     path     for messages; content  what it holds; the file points into it
 * Errors    ERROR_DATA with the line: no part, a line of the head is missing or wrong, a body of
 *           another length or digest than the head says
 */
bool part_read(const char *path, struct text content, struct part_file *file, struct error *error);

/*
 * Put the parts of a run in order.
 *
 * Given     files   count of them, in any order; they are sorted
 * Errors    ERROR_DATA naming the files: another command, version, input, seed or division than the
 *           first one's; a part twice; the parts that are missing
 */
bool parts_order(struct part_file *files, size_t count, struct arena *arena, struct error *error);

#endif
