/* base/instruction_set.h - which compilation of a kernel runs: SSE2, AVX2 or AVX-512. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_INSTRUCTION_SET_H
#define LENSCALC_BASE_INSTRUCTION_SET_H

#include <stdbool.h>
#include <stddef.h>

/*
 * Kernels are compiled once for each set, and every set gives the same bits. Which one runs is
 * chosen by the processor; a caller names a set for tests and benchmarks only. To see the whole
 * program with a lesser one, tell the C library what the processor shall not have:
 * GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX512F,-AVX2
 */
enum instruction_set { SET_BEST, SET_SSE2, SET_AVX2, SET_AVX512 };

/* Does the processor have it? */
bool instruction_set_works(enum instruction_set set);

/* SET_BEST as one of the others; those stay what they are. */
enum instruction_set instruction_set_best(enum instruction_set set);

/* "best", "sse2", "avx2", "avx512" */
const char *instruction_set_name(enum instruction_set set);

/* The function for a set, of a kernel declared as `typedef ... kernel(...)` and, of that type,
   kernel_sse2, kernel_avx2 and kernel_avx512. */
#define KERNEL_FOR(set, kernel)                                                                    \
    (((kernel *const[]){NULL, kernel##_sse2, kernel##_avx2,                                        \
                        kernel##_avx512})[instruction_set_best(set)])

#endif
