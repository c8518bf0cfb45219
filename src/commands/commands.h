/* commands/commands.h - the table of commands. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_COMMANDS_H
#define LENSCALC_COMMANDS_COMMANDS_H

#include "cli/question/command.h"

/* All commands in the order of the manual; ends with null. */
extern const struct command *const commands[];

/* The one of this name; null if there is none. */
const struct command *command_find(struct text name);

#endif
