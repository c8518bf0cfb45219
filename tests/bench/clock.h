/* tests/bench/clock.h - how long something takes. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BENCH_CLOCK_H
#define LENSCALC_BENCH_CLOCK_H

#include <time.h>

/* Seconds from some moment on. */
static inline double time_of_clock(clockid_t clock)
{
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Those of the processor: other programs do not stretch them. */
static inline double processor_time(void)
{
    return time_of_clock(CLOCK_PROCESS_CPUTIME_ID);
}

/* Those that pass: threads shorten them. */
static inline double clock_time(void)
{
    return time_of_clock(CLOCK_MONOTONIC);
}

#endif
