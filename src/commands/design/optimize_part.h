/* commands/design/optimize_part.h - parts and states of a search: what starts led to, in files. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_COMMANDS_DESIGN_OPTIMIZE_PART_H
#define LENSCALC_COMMANDS_DESIGN_OPTIMIZE_PART_H

#include "cli/question/division.h"
#include "commands/design/optimize_job.h"
#include "design/optimize_global.h"

#include <time.h>

/* A search as its files have it; internal but for its place. */
struct optimize_part {
    const struct run *run;
    struct optimize_global *global;
    struct part_head part, state; /* of --part, and of --state, which is asked less */
    const char *state_path;       /* null: nobody wants one */
    time_t saved;                 /* when the state was written last */
};

/*
 * Before a search.
 *
 * Given     global  its starts, of which none is done; receives which of them are searched, and
 *                   what files say of the others: parts that are merged, the state it goes on from
 * Errors    ERROR_USAGE: --part without a file; as division_head and division_found; ERROR_DATA: a
 *           file that does not hold what its head says
 */
bool optimize_part_begin(const struct optimize_job *job, struct optimize_global *global,
                         struct optimize_part *part, struct error *error);

/* Now and then during one: the state is written, if it is wanted and half a minute has passed. */
void optimize_part_pause(struct optimize_part *part);

/* Write the state where it is wanted, at once; what cannot be written is said at the end. */
void optimize_part_save(struct optimize_part *part);

/* The file of --part, and that of --state. */
void optimize_part_write(struct optimize_part *part, struct output *sink);
void optimize_state_write(struct optimize_part *part, struct output *sink);

#endif
