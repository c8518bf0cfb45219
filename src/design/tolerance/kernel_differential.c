/* design/tolerance/kernel_differential.c - quadratic forms, for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "design/tolerance/second_order.h"

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

enum { LANES = SECOND_ORDER_LANES };

/* Row i: slope i, then what p0 .. pi are multiplied with. */
void NAMED(kernel_differential, KERNEL)(const double *rows, size_t count, const double *errors,
                                        double *sums)
{
    double total[LANES];
    for (size_t l = 0; l < LANES; l++) {
        total[l] = sums[l];
    }
    for (size_t i = 0; i < count; i++) {
        double along[LANES];
        for (size_t l = 0; l < LANES; l++) {
            along[l] = rows[0];
        }
        for (size_t j = 0; j <= i; j++) {
            const double *restrict p = errors + j * LANES;
            const double by = rows[1 + j];
            for (size_t l = 0; l < LANES; l++) {
                along[l] += by * p[l];
            }
        }
        const double *restrict p = errors + i * LANES;
        for (size_t l = 0; l < LANES; l++) {
            total[l] += along[l] * p[l];
        }
        rows += i + 2;
    }
    for (size_t l = 0; l < LANES; l++) {
        sums[l] = total[l];
    }
}
