/* cli/question/comma.h - commas that part a list where something else may be meant. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_QUESTION_COMMA_H
#define LENSCALC_CLI_QUESTION_COMMA_H

#include "cli/options/option.h"

/*
 * Refuse decimal commas where no number of a list can follow, and doubt a list of filters that are
 * written in different ways: they may be meant to stand together.
 *
 * Errors    ERROR_USAGE: 10x50 6,5deg, 40x/0,65
 */
bool comma_check(const struct reader *reader, const struct option *option, struct text text,
                 struct error *error);

#endif
