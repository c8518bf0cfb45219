/* cli/batch/gaps.h - rows of a batch to which a question lacks something: said once. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_BATCH_GAPS_H
#define LENSCALC_CLI_BATCH_GAPS_H

#include "cli/batch/batch.h"

/* Rows that lack the same. */
struct gap {
    char message[sizeof((struct error *)0)->message];
    long first, last; /* lines */
    /* and files, where each row is one: the first and the last of them */
    char source[sizeof((struct error *)0)->source], last_source[sizeof((struct error *)0)->source];
    size_t more; /* rows beyond the first */
};

enum { GAPS_MOST = 8 };

/* All of a batch: those beyond the most are said row by row. */
struct gaps {
    struct gap all[GAPS_MOST];
    size_t count;
};

/* Does the failure say that the row gives too little, or too much, to answer? */
static inline bool gaps_has(const struct error *failure)
{
    return failure->code == ERROR_USAGE;
}

/* Count a row that fails so. True if it is the first: its failure is to be said. */
bool gaps_add(struct gaps *gaps, const struct error *failure);

/*
 * Add to a failure, still with its mentions, what the row knows, which of its cells are empty, and
 * that options fill those.
 *
 * Given     input  of the row
 */
void gaps_explain(struct error *failure, const struct batch *batch, const void *input);

/* No column of the file means anything to the command, which lacks what the failure says. */
void gaps_refuse(struct error *failure, const struct batch *batch);

/* The line of names of columns, `line`, has values: say so, and which names would be known. */
void gaps_refuse_values(struct error *error, const struct batch *batch, struct text line);

/* "46 more rows fail like line 2", or like a photograph: gap `i` of a file; false: no more do. */
bool gaps_rest(const struct gaps *gaps, size_t i, const char *source, struct error *rest);

#endif
