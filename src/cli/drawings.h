/* cli/drawings.h - the drawings that options of a command ask for with a file name. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_DRAWINGS_H
#define LENSCALC_CLI_DRAWINGS_H

#include "cli/command.h"

/* Refuse them where there is more than one answer. */
bool drawings_check(const struct command *command, const void *input, bool many,
                    struct error *error);

bool drawings_write(const struct command *command, const void *input, struct arena *arena,
                    struct error *error);

#endif
