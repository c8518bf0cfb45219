/* cli/drawings.h - drawings that commands make themselves. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_DRAWINGS_H
#define LENSCALC_CLI_DRAWINGS_H

#include "cli/command.h"
#include "cli/sweep.h"

/* Options that draw one answer into a file: refuse them where there are several. */
bool drawings_check(const struct command *command, const void *input, bool many,
                    struct error *error);

/* The drawings that options of this command ask for. */
bool drawings_write(const struct command *command, const void *input, struct arena *arena,
                    struct error *error);

/*
 * --plot of a command that draws it itself: one picture of all inputs of a sweep.
 *
 * Given     input  the driver's own; afterwards it holds the last input
 * Errors    ERROR_USAGE: more than 100 inputs; as the command and output_file
 */
bool picture_write(const struct command *command, const struct sweep *sweep, void *input,
                   const char *path, struct arena *arena, struct error *error);

#endif
