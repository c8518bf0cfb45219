/* cli/answer/driver.h - run a command: from its words to its printed rows. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_DRIVER_H
#define LENSCALC_CLI_ANSWER_DRIVER_H

#include "cli/question/command.h"

/* A command inside another, with the words that follow its name. */
struct embedded_command {
    const struct command *command;
    char **words;
    size_t count;
    const struct lens_value *lenses; /* known by their names: they are not read again */
    size_t lens_count;
};

/*
 * Answer a question inside a command: the drawing that its words ask for ("--plot", "-"), else its
 * rows, as people read them. Several threads may ask, each with its own `outer`.
 *
 * Given     outer     of the command that asks, whose choice of data it shares
 *           answered  receives the text, in outer->arena
 * Errors    all that the command may have, with nothing said on standard error
 */
bool command_embed(const struct embedded_command *embedding, struct run *outer,
                   struct text *answered, struct error *error);

/*
 * Run a command.
 *
 * Given     commands    all there are; ends with null
 *           argc, argv  of the program; argv[1] is the command's name
 *           database    LENSCALC_DB, or null
 * Result    the exit status; anything wrong has been said on standard error
 */
int command_execute(const struct command *command, const struct command *const *commands, int argc,
                    char **argv, const char *database);

#endif
