/* design/solver/solver_normal.c - the normal equations of residuals and their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_normal.h"

#include "base/instruction_set.h"

double *solver_normal_room(size_t columns, struct arena *arena)
{
    return ARENA_ARRAY(arena, (columns + 1) * SOLVER_ROWS, double);
}

void solver_normal(const struct solver_rows *rows, double *normal, double *gradient)
{
    kernel_normal *kernel = KERNEL_FOR(SET_BEST, kernel_normal);
    kernel(rows, normal, gradient);
}
