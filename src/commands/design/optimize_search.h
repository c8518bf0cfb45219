/* commands/design/optimize_search.h - optimize --global: the best of many starts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_OPTIMIZE_SEARCH_H
#define LENSCALC_COMMANDS_DESIGN_OPTIMIZE_SEARCH_H

#include "commands/design/optimize_job.h"
#include "design/optimize_global.h"

/* Is --global asked for? */
static inline bool optimize_is_global(const struct optimize_input *input)
{
    return input->global > 0;
}

/* How many lenses it keeps at most. */
size_t optimize_keep_count(const void *input);

/*
 * Read, optimise from the lens or search, look at what was found: job->answer, or job->kept.
 *
 * Errors    ERROR_USAGE: options that do not go together; ERROR_DOMAIN: nothing that can be judged
 *           was found, with what is wrong with the lens itself
 */
bool optimize_job_run(struct optimize_job *job, struct error *error);

#endif
