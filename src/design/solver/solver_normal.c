/* design/solver/solver_normal.c - the normal equations of residuals and their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_normal.h"

#include "base/processor.h"

double *solver_normal_room(size_t columns, struct arena *arena)
{
    return ARENA_ARRAY(arena, (columns + 1) * SOLVER_ROWS, double);
}

void solver_normal(const struct solver_rows *rows, double *normal, double *gradient)
{
    kernel_normal *kernel = processor_has_avx512() ? kernel_normal_avx512
                            : processor_has_avx2() ? kernel_normal_avx2
                                                   : kernel_normal_sse2;
    kernel(rows, normal, gradient);
}
