/* cli/answer/question.h - options, defaults and the columns of a batch into the input of a command. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CLI_ANSWER_QUESTION_H
#define LENSCALC_CLI_ANSWER_QUESTION_H

#include "cli/answer/rows.h"

/*
 * Defaults and kits of the user's, for options that are not typed. Who asks for help has it
 * whatever is wrong with them.
 *
 * Errors    as configuration_open, configuration_check and configuration_apply; ERROR_USAGE: a kit
 *           where there is no file
 */
bool question_configure(struct driver *driver, struct error *error);

/* The rows that the options as read so far ask for, the constants of all rows. */
const struct sheet *question_sheet(const struct driver *driver);

/*
 * The options into the input, and the columns of the batch. Where defaults turn out to say nothing,
 * or to stand in the way, they are left out, and the input is made anew.
 *
 * Errors    as sweep_build, batch_open and idle_check
 */
bool question_settle(struct driver *driver, struct error *error);

#endif
