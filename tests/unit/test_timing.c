/* tests/unit/test_timing.c - the fastest of interleaved turns, by a clock that is made up. */
/* SPDX-License-Identifier: MIT */
#include "base/timing.h"
#include "check.h"

static double now;

static double clock_made_up(void)
{
    return now;
}

/* Takes its time, and in every so manieth call more. */
struct sleeper {
    double takes, more;
    int each, calls;
};

static void sleeper_run(void *context)
{
    struct sleeper *sleeper = context;
    sleeper->calls++;
    now += sleeper->takes;
    if (sleeper->each > 0 && sleeper->calls % sleeper->each == 0) {
        now += sleeper->more;
    }
}

/* Each turn takes longer than the one before. */
static void slower_run(void *context)
{
    double *takes = context;
    now += *takes;
    *takes *= 1.1;
}

int main(void)
{
    struct timing_plan plan = timing_plan_default();
    plan.clock = clock_made_up;
    struct sleeper steady = {.takes = 1e-6}, spiky = {.takes = 2e-3, .more = 5e-2, .each = 3};
    double slower = 1;
    struct timed_work works[] = {{.run = sleeper_run, .context = &steady},
                                 {.run = sleeper_run, .context = &spiky},
                                 {.run = slower_run, .context = &slower}};
    timing_run(&plan, works, 3);
    CHECK_RELATIVE(works[0].seconds, 1e-6, 1e-6, "a steady one");
    CHECK(works[0].disagrees <= 0.05);
    CHECK_RELATIVE(works[1].seconds, 2e-3, 1e-6,
                   "what interrupts it now and then counts for nothing");
    CHECK(isnan(works[2].seconds));
    CHECK(works[2].disagrees > 0.05);
    /* the real clock goes on while work is done */
    double (*const real)(void) = timing_plan_default().clock;
    const double began = real();
    volatile double sum = 0;
    for (int i = 0; i < 1000000; i++) {
        sum = sum + i;
    }
    CHECK(real() > began);
    return check_report();
}
