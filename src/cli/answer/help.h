/* cli/answer/help.h - help from the tables that parse. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_HELP_H
#define LENSCALC_CLI_ANSWER_HELP_H

#include "cli/question/command.h"

/* Examples, then options with units, defaults and ranges, on standard output. The exit status. */
int help_command(const struct command *command, struct arena *arena);

/* The same into an output. */
void help_write(const struct command *command, struct output *output, struct arena *arena);

/* Columns of help: 80, or those of a narrower terminal. */
size_t help_width(const struct output *output);

#endif
