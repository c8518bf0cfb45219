/* cli/question/idle.h - options that would say nothing beside what else is asked. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_IDLE_H
#define LENSCALC_CLI_QUESTION_IDLE_H

#include "cli/question/arguments.h"
#include "cli/question/artifact.h"
#include "cli/question/sweep.h"

#include <stdbool.h>

/*
 * Refuse options that say nothing beside what else is asked.
 *
 * Given     asking  columns of a batch count as given, with any value
 *           input  with the values that are not swept
 * Errors    ERROR_USAGE: an option is given without the one, or the value, that it serves, or
 *           beside one that leaves it nothing to say
 */
bool idle_check(const struct sweep *sweep, const struct arguments *arguments,
                const struct option_query *asking, const void *input, struct error *error);

#endif
