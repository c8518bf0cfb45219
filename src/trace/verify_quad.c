/* trace/verify_quad.c - the trace in 113-bit numbers, where the compiler has them. */
/* SPDX-License-Identifier: MIT */
#if defined(__SIZEOF_FLOAT128__) || defined(__FLOAT128__)
typedef __float128 quad;
#define REAL quad
#else
#define REAL long double
#endif
#include "trace/precise.h"

struct precise_end ray_of_113_bits(const struct system *system, const double point[3],
                                   const double direction[3])
{
    return precise_end_of(system, point, direction);
}
