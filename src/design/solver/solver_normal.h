/* design/solver/solver_normal.h - the normal equations of residuals and their derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_NORMAL_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_NORMAL_H

#include "base/arena.h"
#include "base/instruction_set.h"

#include <stdbool.h>
#include <stddef.h>

/* Rows that are summed at once; columns at most. */
enum { SOLVER_ROWS = 128, SOLVER_COLUMNS = 1000 };

/* Derivatives row by row, residuals, and how much each counts (null: all alike). */
struct solver_rows {
    size_t rows, columns;
    const double *jacobian, *residuals, *weights;
    double *room; /* of solver_normal_room */
};

/* Where columns of a block of rows are put together. */
static inline double *solver_normal_room(size_t columns, struct arena *arena)
{
    return ARENA_ARRAY(arena, (columns + 1) * SOLVER_ROWS, double);
}

/* Internal: one variant an instruction set. */
typedef void kernel_normal(const struct solver_rows *rows, double *normal, double *gradient);
kernel_normal kernel_normal_sse2, kernel_normal_avx2, kernel_normal_avx512;

/*
 * J^T W J and J^T W r.
 *
 * Given     normal    receives columns x columns; null: it is not wanted
 *           gradient  receives `columns` numbers
 * Formula   sums in the same order, so the same bits, with every instruction set
 */
static inline void solver_normal(const struct solver_rows *rows, double *normal, double *gradient)
{
    KERNEL_FOR(SET_BEST, kernel_normal)(rows, normal, gradient);
}

#endif
