/* trace/spans.h - the parts of lines through a beam that nothing blocks. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_SPANS_H
#define LENSCALC_TRACE_SPANS_H

#include "trace/probe.h"

#include <stddef.h>

enum { SPANS_MOST = 12 };

/* What is clear of one line, as shares of its way. */
struct spans {
    size_t count;
    double low[SPANS_MOST], high[SPANS_MOST]; /* ascending, 0 .. 1 */
    size_t part; /* a number of the edges that are crossed, in their order */
};

/* All that is clear, and nothing crossed. */
extern const struct spans spans_whole;

/*
 * The clear parts of lines from one point to many, in coordinates of the beam.
 *
 * Given     probe   probe->full is not null
 *           centre  where all begin
 *           ends    `count` of them; the lines must lie within the edge of the beam
 *           spans   receives one a line
 * Formula   how deep rays come within what blocks (probe_depth), at 128 points of each line, and at
 *           128 more about each point where the depth has an extremum that may reach beyond 0
 *           between points; changes of sign are bisected to 1e-15 of the line
 * Limits    what blocks less than 1e-4 of the line, or more than SPANS_MOST clear parts, may be
 *           missed
 */
void spans_find(const struct probe *probe, const double centre[2], const double (*ends)[2],
                size_t count, struct spans *spans);

#endif
