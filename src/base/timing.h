/* base/timing.h - how long work takes: the fastest of interleaved turns, if turns agree. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_TIMING_H
#define LENSCALC_BASE_TIMING_H

#include <stdbool.h>
#include <stddef.h>

/* What is timed, and how long it took. */
struct timed_work {
    void (*run)(void *context);
    void *context;
    double seconds;   /* of one call, the fastest; NaN: no two turns agreed */
    double disagrees; /* by how much the best two turns in a row differ, as a share */
};

/* How long to go on. */
struct timing_plan {
    double (*clock)(void); /* s; the time that the processor gave this thread, but for tests */
    double batch;          /* s: so long a call is repeated for one figure */
    double agreement;      /* share by which two turns in a row may differ */
    int rounds;            /* of a turn: each work once in each */
    int turns;             /* at most */
};

/* Two turns within 5 %, of three rounds each; at most ten turns. */
struct timing_plan timing_plan_default(void);

/*
 * Time several works against each other.
 *
 * Given     works  `run` and `context`, which may be run as often as it takes; receive the rest
 * Formula   calls are doubled until they take a batch. A turn has all works one after the other,
 *           several times, so that what slows the machine for a while slows all; of each the
 *           fastest counts. Where two turns in a row agree the faster of them is the answer, and
 *           the work has no more turns; processor time, since other programs then count less
 * Limits    a processor that changes its speed, or shares a core, makes turns differ: the work then
 *           has no time, nor have works beyond the first 1024
 */
void timing_run(const struct timing_plan *plan, struct timed_work *works, size_t count);

#endif
