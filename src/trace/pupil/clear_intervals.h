/* trace/pupil/clear_intervals.h - the parts of lines through a beam that nothing blocks. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_PUPIL_CLEAR_INTERVALS_H
#define LENSCALC_TRACE_PUPIL_CLEAR_INTERVALS_H

#include "trace/pupil/clearances.h"

#include <stddef.h>

enum { CLEAR_INTERVALS_MOST = 12 };

/* What is clear of one line, as shares of its way. */
struct clear_intervals {
    size_t count;
    double low[CLEAR_INTERVALS_MOST], high[CLEAR_INTERVALS_MOST]; /* ascending, 0 .. 1 */
    size_t part; /* a number of the edges that are crossed, in their order */
};

/* All that is clear, and nothing crossed. */
extern const struct clear_intervals clear_intervals_whole;

/*
 * The clear parts of lines from one point to many, in coordinates of the beam.
 *
 * Given     margins  margins->full is not null
 *           centre  where all begin
 *           ends    `count` of them; the lines must lie within the edge of the beam
 *           intervals   receives one a line
 * Formula   how deep rays come within what blocks (clearances_depth), at 128 points of each line,
 *           and at 128 more about each point where the depth has an extremum that may reach beyond
 *           0 between points; changes of sign are bisected to 1e-15 of the line
 * Limits    what blocks less than 1e-4 of the line, or more than CLEAR_INTERVALS_MOST clear parts,
 *           may be missed
 */
void clear_intervals_find(const struct clearances *margins, const double centre[2],
                          const double (*ends)[2], size_t count, struct clear_intervals *intervals);

#endif
