/* cli/answer/columns.h - the columns a command prints, for whoever looks for one. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_COLUMNS_H
#define LENSCALC_CLI_ANSWER_COLUMNS_H

#include "cli/question/command.h"

/* A column of a command in words. */
struct column_row {
    const char *command, *column, *letter, *unit, *label, *help, *shown;
};

/* Columns of rows of struct column_row: about columns too. */
enum { COLUMNS_OF_COLUMNS = 7 };
extern const struct column columns_of_columns[COLUMNS_OF_COLUMNS];

/* The columns of a command in words, of all its kinds of rows, each once; in the arena. */
const struct column_row *columns_describe(const struct command *command, size_t *count,
                                          struct arena *arena);

/* Is that what --columns asks for: which columns there are? */
bool columns_are_asked(const struct common *common);

/*
 * Print the columns of a command in the format and to the output that are asked for.
 *
 * Result    the exit status
 */
int columns_print(const struct command *command, const struct common *common, struct arena *arena);

/*
 * Names of columns as they were typed, with options by letter or name turned into the columns that
 * repeat them: "N,s,near" into "fnumber,distance,near". Names of columns come first.
 *
 * Given     sheet       of the rows
 *           names       or null; separators  characters between them
 * Result    in the arena; null for null
 */
const char *columns_from_options(const struct command *command, const struct sheet *sheet,
                                 const char *names, const char *separators, struct arena *arena);

#endif
