/* design/solver/kernel_normal.c - the normal equations, compiled for each instruction set. */
/* SPDX-License-Identifier: MIT */
#include "design/solver/solver_normal.h"

#include <math.h>
#include <string.h>

#define JOINED(a, b) a##_##b
#define NAMED(a, b)  JOINED(a, b)

enum { LANES = SOLVER_ROWS / 4 };

/* One column of a block of rows, in one piece; rows that are missing are 0. */
static void take_column(const struct solver_rows *rows, size_t first, size_t column, double *to)
{
    const size_t left = rows->rows - first, here = left < SOLVER_ROWS ? left : SOLVER_ROWS;
    const bool is_residual = column == rows->columns;
    const size_t step = is_residual ? 1 : rows->columns;
    const double *from =
        is_residual ? rows->residuals + first : rows->jacobian + first * step + column;
    for (size_t r = 0; r < here; r++) {
        to[r] = from[r * step];
    }
    for (size_t r = 0; r < here && rows->weights != NULL; r++) {
        to[r] *= sqrt(rows->weights[first + r]);
    }
    memset(to + here, 0, (SOLVER_ROWS - here) * sizeof(double));
}

/* The sum of products lane by lane, then of the lanes: one order for every instruction set. */
static double kernel_normal_dot(const double *restrict a, const double *restrict b)
{
    double sums[LANES];
    for (size_t l = 0; l < LANES; l++) {
        sums[l] = (a[l] * b[l] + a[LANES + l] * b[LANES + l]) +
                  (a[2 * LANES + l] * b[2 * LANES + l] + a[3 * LANES + l] * b[3 * LANES + l]);
    }
    for (size_t l = 0; l < LANES / 2; l++) {
        sums[l] += sums[LANES / 2 + l];
    }
    for (size_t l = 0; l < LANES / 4; l++) {
        sums[l] += sums[LANES / 4 + l];
    }
    return ((sums[0] + sums[4]) + (sums[1] + sums[5])) +
           ((sums[2] + sums[6]) + (sums[3] + sums[7]));
}

void NAMED(kernel_normal, KERNEL)(const struct solver_rows *rows, double *normal, double *gradient)
{
    const size_t n = rows->columns;
    const double *residuals = rows->room + n * SOLVER_ROWS;
    memset(gradient, 0, n * sizeof(double));
    if (normal != NULL) {
        memset(normal, 0, n * n * sizeof(double));
    }
    for (size_t first = 0; first < rows->rows; first += SOLVER_ROWS) {
        for (size_t i = 0; i <= n; i++) {
            take_column(rows, first, i, rows->room + i * SOLVER_ROWS);
        }
        for (size_t i = 0; i < n; i++) {
            const double *column = rows->room + i * SOLVER_ROWS;
            gradient[i] += kernel_normal_dot(column, residuals);
            for (size_t j = 0; j <= i && normal != NULL; j++) {
                normal[i * n + j] += kernel_normal_dot(column, rows->room + j * SOLVER_ROWS);
            }
        }
    }
    for (size_t i = 0; i < n && normal != NULL; i++) {
        for (size_t j = 0; j < i; j++) {
            normal[j * n + i] = normal[i * n + j];
        }
    }
}
