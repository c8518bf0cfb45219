/* commands/design/tolerance_method.h - trials to second order, and how far they are right. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_TOLERANCE_METHOD_H
#define LENSCALC_COMMANDS_DESIGN_TOLERANCE_METHOD_H

#include "commands/design/tolerance_job.h"

/*
 * Make trials ready that --method asks for.
 *
 * Errors    ERROR_USAGE: a compensator with a range, which has no derivatives; as second_order_open
 */
bool tolerance_method_open(struct tolerance_job *job, struct error *error);

/* By what the first trials differ from exact ones; of exact trials nothing is done. */
bool tolerance_method_check(struct tolerance_job *job, struct error *error);

/* "differential (exact trials differ by ..)"; null: they are exact */
const char *tolerance_method_in_words(const struct tolerance_job *job);

#endif
