/* tests/bench/divider.h - how fast this processor draws roots and divides. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BENCH_DIVIDER_H
#define LENSCALC_BENCH_DIVIDER_H

#include "clock.h"
#include "trace/dispatch.h"

#include <math.h>

#ifdef __x86_64__
/* Two roots and a quotient that wait for nothing, 8 times: seconds for one lane of one. */
#define DIVIDER(NAME, LANES, REGISTER)                                                             \
    static double NAME(void)                                                                       \
    {                                                                                              \
        double best = 1e9;                                                                         \
        for (int turn = 0; turn < 2000; turn++) {                                                  \
            double began = clock_time();                                                           \
            for (int i = 0; i < 200; i++) {                                                        \
                __asm__ volatile(".rept 8\n vsqrtpd %%" REGISTER "0, %%" REGISTER "1\n"            \
                                 "vsqrtpd %%" REGISTER "0, %%" REGISTER "2\n"                      \
                                 "vdivpd %%" REGISTER "0, %%" REGISTER "0, %%" REGISTER "3\n"      \
                                 ".endr" ::                                                        \
                                     : "xmm1", "xmm2", "xmm3");                                    \
            }                                                                                      \
            best = fmin(best, (clock_time() - began) / (200. * 8 * LANES));                        \
        }                                                                                          \
        return best;                                                                               \
    }
DIVIDER(divider_128, 2, "xmm")
DIVIDER(divider_256, 4, "ymm")
DIVIDER(divider_512, 8, "zmm")
#endif

/* Million spheres a second that its divider allows, two roots and a quotient each; 0 = unknown. */
static double divider_spheres(enum instruction_set set)
{
#ifdef __x86_64__
    if (instruction_set_works(SET_AVX2)) {
        double (*const measure[])(void) = {NULL, divider_128, divider_256, divider_512};
        return 1e-6 / measure[set]();
    }
#endif
    (void)set;
    return 0;
}

#endif
