/* cli/question/echo.h - columns that repeat the options which vary, where a command has none for them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_ECHO_H
#define LENSCALC_CLI_QUESTION_ECHO_H

#include "cli/question/command.h"
#include "report/report.h"

/* An option and the member of the longer rows that repeats it. */
struct echo_item {
    const struct option *option;
    size_t offset;
    bool has_value;     /* false: neither given nor assumed, the column is empty */
    bool is_equivalent; /* it says the equivalent focal length that was given */
};

/* The columns of a command, behind those that it lacks to tell its rows apart. */
struct echo {
    const struct sheet *own; /* the command's */
    struct sheet sheet;      /* these columns, over rows that are longer by their values */
    struct echo_item *items; /* one a column that was added, in their order */
    size_t count;
    char *row;
};

/* What decides which columns are added. */
struct echo_question {
    const struct command *command;
    const struct sheet *sheet; /* of the rows that it makes */
    bool all; /* --columns may name any: all options that have no column get one, not only those
                 that vary */
    bool is_for_people; /* else a column that tells an option in another form will do: a batch
                           could not read both */
    bool (*given)(const void *asked, const char *option);
    bool (*varied)(const void *asked, const char *option);
    const void *asked;
    const void
        *input; /* as options set it, to tell what is given as an equivalent focal length; null:
                          there is no question */
};

/*
 * Add a column for each option that varies from row to row and that no column of the command
 * repeats: by the name that the option has for its column, else by its own. A column of that name
 * that comes on request only comes unasked. An equivalent focal length, of which the command knows
 * the real one only, becomes an assumption.
 */
void echo_open(struct echo *echo, const struct echo_question *question, struct arena *arena);

/* Columns of a report that are shown: without any that was added rows stay as they are. */
void echo_settle(struct echo *echo, struct report *report);

/*
 * A row with the values that were added.
 *
 * Given     input  that the row answers
 *           arena  for texts
 * Result    lasts until the next call
 */
const void *echo_row(struct echo *echo, const void *row, const void *input, struct arena *arena);

#endif
