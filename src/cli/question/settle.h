/* cli/question/settle.h - values that name no option, or another one than they belong to. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_SETTLE_H
#define LENSCALC_CLI_QUESTION_SETTLE_H

#include "cli/question/arguments.h"

/*
 * Values without their options get them, in place of what the configuration says.
 *
 * Errors    ERROR_USAGE: no option is left for one, or its option is given as well
 */
bool arguments_settle(struct arguments *arguments, struct arena *arena, struct error *error);

#endif
