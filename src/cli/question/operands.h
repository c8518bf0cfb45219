/* cli/question/operands.h - values that stand without their options: dof 50mm f/2.8 3m. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_OPERANDS_H
#define LENSCALC_CLI_QUESTION_OPERANDS_H

#include "cli/question/command.h"

/* The lengths of a telescope. */
#define TELESCOPE "telescope"
#define DIAMETER  "diameter"

/*
 * A value that shows by its notation what it is, as 50mm, f/2.8, 1/125 and iso400 do; of a command
 * with operands of its own a focal length alone.
 *
 * Given     words    those that are left, of which "50" "mm" are one value;  count  1 or more
 *           operand  receives the value, in the arena
 * Result    how many words it is; 0: it shows nothing
 */
size_t operands_read(const struct command *command, char *const *words, size_t count,
                     struct text *operand, struct arena *arena);

/*
 * The option of each: of two lengths the first is the focal length, the second the distance.
 *
 * Given     has_focal  the focal length, or the lens, is known: a single length is the distance
 *           options  receives count of them
 * Errors    ERROR_USAGE: no option is left for one
 */
bool operands_settle(const struct command *command, const struct text *operands, size_t count,
                     bool has_focal, const struct option **options, struct error *error);

/* "dof 50mm f/2.8 3m": a question with the first of them; null if it takes fewer than two. */
const char *operands_example(const struct command *command, struct arena *arena);

/* Does it take photographs? Those of photography do whose options they fill. */
bool command_takes_photographs(const struct command *command);

/* Does it, and is the word the name of one, by its ending? */
bool operand_is_photograph(const struct command *command, struct text word);

/* " [50mm] [f/2.8] [3m]", for the usage of a command; "" if it takes none. */
const char *operands_usage(const struct command *command, struct arena *arena);

#endif
