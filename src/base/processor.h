/* base/processor.h - which instructions this processor has. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_PROCESSOR_H
#define LENSCALC_BASE_PROCESSOR_H

#include <stdbool.h>

/*
 * glibc has asked the processor before main, and says what it was told. The compiler's
 * __builtin_cpu_supports asks anew in every program that it is linked into, before main and whether
 * or not anybody wants to know: on a virtual machine, where each such question is an exit to the
 * host, that is a tenth of the start.
 */
#if defined(__x86_64__) && defined(__has_include)
#if __has_include(<sys/platform/x86.h>)
#include <sys/platform/x86.h>
#endif
#endif

#ifdef CPU_FEATURE_ACTIVE
/* CPU_FEATURE_ACTIVE shifts a signed 1 to bit 31, which C leaves undefined: AVX512VL has it. */
static inline bool processor_has(unsigned feature)
{
    const struct cpuid_feature *leaf = __x86_get_cpuid_feature_leaf(feature / 128);
    return (leaf->active_array[feature % 128 / 32] >> feature % 32 & 1) != 0;
}
#define PROCESSOR_HAS(feature, name) processor_has(x86_cpu_##feature)
#elif defined(__x86_64__)
#define PROCESSOR_HAS(feature, name) __builtin_cpu_supports(name)
#else
#define PROCESSOR_HAS(feature, name) false
#endif

/* 256-bit vectors, which the system saves too. */
static inline bool processor_has_avx2(void)
{
    return PROCESSOR_HAS(AVX2, "avx2");
}

/* Fused multiply-add. */
static inline bool processor_has_fma(void)
{
    return PROCESSOR_HAS(FMA, "fma");
}

/* 512-bit vectors with what the lane loops are compiled for: F, VL and DQ. */
static inline bool processor_has_avx512(void)
{
    return PROCESSOR_HAS(AVX512F, "avx512f") && PROCESSOR_HAS(AVX512VL, "avx512vl") &&
           PROCESSOR_HAS(AVX512DQ, "avx512dq");
}

#endif
