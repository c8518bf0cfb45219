/* commands/tables.h - short words for tables of options and columns. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_TABLES_H
#define LENSCALC_COMMANDS_TABLES_H

#include "cli/options/option.h"
#include "report/table.h"

#include <math.h>

/*
 * A file says once which struct its options fill, and of which its rows are; the words below, and
 * those that share entries among commands, go by it:
 *
 *     #define INPUT struct dof_question
 *     #define ROW   struct dof_row
 */

/* -------- options -------- */

#define ASKED(member) OPTION(INPUT, member)

/* Of `dimension_of`: length, angle; a bare number is in the unit `in`, null for its own. */
#define MEASURE(member, of, in, words)                                                             \
    ASKED(member), .dimension = &dimension_##of, .unit = (in), .value = (words)

/* By the name of the column that repeats it. */
#define REPEATED(word) .name = (word), .column = (word)

/* Ranges; further flags follow with '|'. */
#define ABOVE_0_OR_INFINITE OPTION_POSITIVE, .flags = OPTION_ABOVE_LOWEST
#define ABOVE_0             ABOVE_0_OR_INFINITE | OPTION_NO_INFINITY
#define FROM_0              OPTION_POSITIVE, .flags = OPTION_NO_INFINITY

/* -------- columns -------- */

#define SHOWN(member)            COLUMN(ROW, member)
#define MEASURED(member, of, in) SHOWN(member), .dimension = &dimension_##of, .unit = (in)
#define LENGTH(member, in)       MEASURED(member, length, in)
#define ANGLE(member)            MEASURED(member, angle, "deg")
#define TIME(member)             MEASURED(member, time, "s")
#define STOPS(member)            MEASURED(member, stops, "stops")

/* When it is there; further flags follow with '|'. */
#define BRIEF                        .flags = COLUMN_BRIEF
#define WITH(options)                .with = (options), .flags = COLUMN_EXTRA
#define BRIEF_WITH(options)          WITH(options) | COLUMN_BRIEF
#define ECHO_WITH(options)           WITH(options) | COLUMN_ECHO
#define ASSUMED_BY(options)          .depends = (options), .flags = COLUMN_ASSUMED | COLUMN_EXTRA
#define ASSUMED_WITH(given, options) .with = (given), ASSUMED_BY(options) | COLUMN_TIED

/* -------- commands -------- */

/* What a command of INPUT and ROW has by the usual names. */
#define COMMAND_OF(group_of, words)                                                                \
    .group = (group_of), .summary = (words), COMMAND_ASKS(INPUT), COMMAND_ANSWERS(ROW)

/* -------- what is asked -------- */

/* An option, and whether it says anything. */
struct said {
    bool is;
    const char *option;
};

/* The first that does; null: none. */
static inline const char *said_first(const struct said *list, size_t count)
{
    const char *found = NULL;
    for (size_t i = 0; i < count && found == NULL; i++) {
        found = list[i].is ? list[i].option : NULL;
    }
    return found;
}

#define SAID_FIRST(...)                                                                            \
    said_first((const struct said[]){__VA_ARGS__},                                                 \
               sizeof((const struct said[]){__VA_ARGS__}) / sizeof(struct said))

/* Of an option for a refractive index, which words are no value of. */
#define INDEX_WORDS                                                                                \
    "an index is a number: of air 1, water 1.33, glass about 1.5; lenscalc glass NAME has others"

#endif
