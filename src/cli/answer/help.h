/* cli/answer/help.h - help from the tables that parse. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_HELP_H
#define LENSCALC_CLI_ANSWER_HELP_H

#include "cli/question/command.h"

/*
 * Examples, then options with units, defaults and ranges, on standard output, a terminal's by its
 * pager.
 *
 * Given     is_brief  examples and the command's own options, a line each
 * Result    the exit status
 */
int help_command(const struct command *command, bool is_brief, struct arena *arena);

/* The options that commands have in common, of all commands. */
void help_write_common(struct output *output);

/* The same into an output. */
void help_write(const struct command *command, struct output *output, struct arena *arena);

/* Columns of help: 80, or those of a narrower terminal. */
size_t help_width(const struct output *output);

#endif
