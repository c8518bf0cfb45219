/* base/timing.c - how long work takes: the fastest of interleaved turns, if turns agree. */
/* SPDX-License-Identifier: MIT */
#include "base/timing.h"

#include <math.h>
#include <time.h>

enum { TIMING_MOST = 1024 }; /* works */

static double timing_processor(void)
{
    struct timespec time = {0};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

struct timing_plan timing_plan_default(void)
{
    return (struct timing_plan){
        .clock = timing_processor, .batch = 1e-3, .agreement = 0.05, .rounds = 3, .turns = 10};
}

/* So many calls, s. */
static double timing_calls(const struct timing_plan *plan, const struct timed_work *work,
                           size_t calls)
{
    const double began = plan->clock();
    for (size_t i = 0; i < calls; i++) {
        work->run(work->context);
    }
    return plan->clock() - began;
}

/* How many calls take a batch. */
static size_t timing_batch(const struct timing_plan *plan, const struct timed_work *work)
{
    size_t calls = 1;
    while (calls < (size_t)1 << 30 && !(timing_calls(plan, work, calls) >= plan->batch)) {
        calls *= 2;
    }
    return calls;
}

void timing_run(const struct timing_plan *plan, struct timed_work *works, size_t count)
{
    size_t calls[TIMING_MOST];
    double before[TIMING_MOST], here[TIMING_MOST];
    while (count > TIMING_MOST) {
        works[--count].seconds = NAN;
    }
    for (size_t i = 0; i < count; i++) {
        works[i].seconds = NAN;
        works[i].disagrees = INFINITY;
        calls[i] = timing_batch(plan, &works[i]);
        before[i] = INFINITY;
    }
    bool is_left = true;
    for (int turn = 0; turn < plan->turns && is_left; turn++) {
        for (size_t i = 0; i < count; i++) {
            here[i] = INFINITY;
        }
        for (int round = 0; round < plan->rounds; round++) {
            for (size_t i = 0; i < count; i++) {
                if (isnan(works[i].seconds)) {
                    const double each = timing_calls(plan, &works[i], calls[i]) / (double)calls[i];
                    here[i] = fmin(here[i], each);
                }
            }
        }
        is_left = false;
        for (size_t i = 0; i < count; i++) {
            if (!isnan(works[i].seconds)) {
                continue;
            }
            const double fast = fmin(here[i], before[i]);
            const double differs = fabs(here[i] - before[i]) / fast;
            works[i].disagrees = fmin(works[i].disagrees, differs);
            if (differs <= plan->agreement && fast > 0) {
                works[i].seconds = fast;
            } else {
                is_left = true;
            }
            before[i] = here[i];
        }
    }
}
