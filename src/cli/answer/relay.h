/* cli/answer/relay.h - hand a command over to lenscalc-ceres, the program with the solver. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_RELAY_H
#define LENSCALC_CLI_ANSWER_RELAY_H

#include "base/arena.h"
#include "base/error.h"

#include <stdbool.h>

struct command;
struct arguments;

/*
 * Become lenscalc-ceres, with the same arguments. It is looked for beside this program, then in
 * ../libexec/lenscalc from there. Nothing may have been read or written before. Whether it starts
 * is tried first: where a library is missing, the dynamic linker says which one.
 *
 * Given     argv  of this program, ends with null
 * Result    true: this program has the solver. Else it only comes back with an error
 * Errors    ERROR_DOMAIN: there is none, what goes by that name is without Ceres; of that program:
 *           it was started by one of another version. ERROR_IO: it does not start
 */
bool relay_to_ceres(char **argv, struct arena *arena, struct error *error);

/* Does a question need the solver, as far as its words tell before anything is read? */
bool relay_is_wanted(const struct command *command, const struct arguments *arguments);

#endif
