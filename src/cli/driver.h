/* cli/driver.h - run a command: from its words to its printed rows. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_DRIVER_H
#define LENSCALC_CLI_DRIVER_H

#include "cli/command.h"

/*
 * Run a command.
 *
 * Given     count, words  what follows the command's name
 *           database      LENSCALC_DB, or null
 * Result    the exit status; anything wrong has been said on standard error
 */
int command_execute(const struct command *command, int count, char **words, const char *database);

#endif
