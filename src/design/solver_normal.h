/* design/solver_normal.h - the normal equations of residuals and their derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_NORMAL_H
#define LENSCALC_DESIGN_SOLVER_NORMAL_H

#include <stddef.h>

/* Derivatives row by row, residuals, and how much each counts (null: all alike). */
struct solver_rows {
    size_t rows, columns;
    const double *jacobian, *residuals, *weights;
};

/*
 * J^T W J and J^T W r.
 *
 * Given     normal    receives columns x columns
 *           gradient  receives `columns` numbers
 */
void solver_normal(const struct solver_rows *rows, double *normal, double *gradient);

/* J^T W r alone. */
void solver_gradient(const struct solver_rows *rows, double *gradient);

#endif
