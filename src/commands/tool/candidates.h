/* commands/tool/candidates.h - what may stand at the end of a command line that is being typed. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_TOOL_CANDIDATES_H
#define LENSCALC_COMMANDS_TOOL_CANDIDATES_H

#include "cli/question/command.h"

/* What stands for the names of files, which the shell knows better. */
#define CANDIDATES_FILES ":files"

/*
 * Write what the last word may become, one candidate a line, those with a meaning followed by a
 * tab and that; where files may stand too, a last line CANDIDATES_FILES.
 *
 * Given     words   those behind "lenscalc", separated by OPTION_MANY_SEPARATOR; the last one is
 *                   being typed, perhaps still empty
 *           run     arena and database
 */
void candidates_write(const char *words, struct run *run, struct output *output);

#endif
