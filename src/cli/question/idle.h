/* cli/question/idle.h - options that would say nothing beside what else is asked. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_IDLE_H
#define LENSCALC_CLI_QUESTION_IDLE_H

#include "cli/question/arguments.h"
#include "cli/question/artifact.h"
#include "cli/question/sweep.h"

#include <stdbool.h>

/*
 * Refuse options that say nothing beside what else is asked; those of the configuration are
 * withdrawn in their place.
 *
 * Given     asking  columns of a batch count as given, with any value
 *           input  with the values that are not swept
 *           withdrawn  receives whether any was: the input is to be made anew
 * Errors    ERROR_USAGE: an option is given without the one, or the value, that it serves, or
 *           beside one that leaves it nothing to say
 */
bool idle_check(const struct sweep *sweep, struct arguments *arguments,
                const struct option_query *asking, const void *input, bool *withdrawn,
                struct error *error);

/*
 * Withdraw options of the configuration that exclude what is asked for with more weight, as a lens
 * does beside a focal length that is typed. What depends on values is left to idle_check.
 */
void idle_yield(struct arguments *arguments, const struct option_query *asking);

#endif
