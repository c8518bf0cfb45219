/* cli/question/inputs.h - files that the words of a command name to be read. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_INPUTS_H
#define LENSCALC_CLI_QUESTION_INPUTS_H

#include "cli/question/arguments.h"

/*
 * Refuse to write over what is read. Files that other files name are not known here:
 * artifact_spares.
 *
 * Given     db     by which lenses are found: the file of a name, or none
 *           force  it is meant so: nothing is refused
 *           path   of what will be written; null, "-" and what is open: nothing is replaced
 * Errors    ERROR_IO: an option or operand names the same file, or standard input is it
 */
bool inputs_spare(const struct arguments *arguments, struct lensdb *db, bool force,
                  const char *path, struct arena *arena, struct error *error);

#endif
