/* cli/question/operands.h - values that stand without their options: dof 50mm f/2.8 3m. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_OPERANDS_H
#define LENSCALC_CLI_QUESTION_OPERANDS_H

#include "cli/question/arguments.h"

/*
 * A value that shows by its notation what it is, as 50mm, f/2.8, 1/125 and iso400 do, of a command
 * without operands of its own.
 *
 * Given     words    those that are left, of which "50" "mm" are one value;  count  1 or more
 *           operand  receives the value, in the arena
 * Result    how many words it is; 0: it shows nothing
 */
size_t operands_read(const struct command *command, char *const *words, size_t count,
                     struct text *operand, struct arena *arena);

/*
 * Give each its option, once all words are read: of two lengths the first is the focal length, the
 * second the distance.
 *
 * Errors    ERROR_USAGE: no option is left for one, or its option is given as well
 */
bool operands_settle(const struct arguments *arguments, const struct text *operands, size_t count,
                     struct error *error);

/* " [50mm] [f/2.8] [3m]", for the usage of a command; "" if it takes none. */
const char *operands_usage(const struct command *command, struct arena *arena);

#endif
