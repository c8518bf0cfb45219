/* cli/driver.h - run a command: from its words to its printed rows. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_DRIVER_H
#define LENSCALC_CLI_DRIVER_H

#include "cli/command.h"

/*
 * Run a command.
 *
 * Given     argc, argv  of the program; argv[1] is the command's name
 *           database    LENSCALC_DB, or null
 * Result    the exit status; anything wrong has been said on standard error
 */
int command_execute(const struct command *command, int argc, char **argv, const char *database);

#endif
