/* commands/design/optimize_goals.h - goals of --goals, of the lens, or usual ones. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_OPTIMIZE_GOALS_H
#define LENSCALC_COMMANDS_DESIGN_OPTIMIZE_GOALS_H

#include "cli/options/goals.h"
#include "commands/design/optimize_job.h"

/*
 * The goals of a job, whose variables are open; job->goals receives them in words that --goals
 * takes.
 *
 * Given     question  for its merit, but for the goals
 * Result    without any: `poly`, the focal length that is stated or else the lens's own in each
 *           position, and centres, edges and gaps not below 2 %, 1 % and 0.1 % of the shortest of
 *           them, or below the thinnest that the lens has
 * Errors    as goals_read
 */
bool optimize_goals(struct optimize_job *job, const struct merit_question *question,
                    struct goals *goals, struct error *error);

/*
 * What may be wrong with the lens, for goals of how it is made: job->errors.
 *
 * Errors    as tolerances_of; ERROR_USAGE: it is told, and no goal asks for it
 */
bool optimize_errors(struct optimize_job *job, const struct goals *goals, struct error *error);

#endif
