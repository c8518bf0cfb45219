/* optics/fused.h - pairs for functions compiled twice: with fused multiply-add, and without. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_FUSED_H
#define LENSCALC_OPTICS_FUSED_H

#include "base/pair.h"
#include "base/processor.h"

#include <stdbool.h>

/*
 * Fused multiply-add gives the error of a product in one step where Dekker's split takes sixteen:
 * the same bits. A function that uses it is INLINE with a constant `fused`, and is called by one
 * that is FUSED and by one that is not; fused_here tells which of the two this machine can run.
 */
#define INLINE static inline __attribute__((always_inline))

#if defined(__x86_64__) && (defined(__GNUC__) || defined(__clang__))
#define HAS_FUSED 1
#define FUSED     __attribute__((target("avx2,fma")))
static inline bool fused_here(void)
{
    return processor_has_fma() && processor_has_avx2();
}
#endif

/* As pair_product. */
INLINE struct pair fused_product(double a, double b, bool fused)
{
    double p = a * b;
    return fused ? (struct pair){p, __builtin_fma(a, b, -p)} : pair_product(a, b);
}

/* As pair_multiply. */
INLINE struct pair fused_multiply(struct pair a, struct pair b, bool fused)
{
    struct pair p = fused_product(a.hi, b.hi, fused);
    return pair_fast_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* a - b to about 1e-31 of the larger one, quicker than pair_subtract. */
INLINE struct pair quick_difference(struct pair a, struct pair b)
{
    struct pair high = pair_sum(a.hi, -b.hi);
    return pair_sum(high.hi, high.lo + (a.lo - b.lo));
}

/* 1/a to about 1e-31; infinite (unsigned) for 0. */
INLINE struct pair fused_reciprocal(struct pair a, bool fused)
{
    if (a.hi == 0) {
        return pair_of((double)INFINITY);
    }
    double r = 1 / a.hi;
    struct pair p = fused_product(r, a.hi, fused);
    return pair_fast_sum(r, (((1 - p.hi) - p.lo) - r * a.lo) * r);
}

/* a b as a double to within an ulp, where b is a reciprocal; of 0 it is infinite (unsigned), and
 * NaN if a is 0 as well. */
INLINE double fused_quotient(struct pair a, struct pair b, bool fused)
{
    if (isinf(b.hi)) {
        return a.hi == 0 ? (double)NAN : (double)INFINITY;
    }
    struct pair p = fused_product(a.hi, b.hi, fused);
    return p.hi + (p.lo + (a.hi * b.lo + a.lo * b.hi));
}

#endif
