/* base/linear.h - least squares of small dense systems, by orthogonal factors. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_LINEAR_H
#define LENSCALC_BASE_LINEAR_H

#include "base/arena.h"

#include <stddef.h>

/* A P = Q R: reflections and R where A was, and which column came when. */
struct linear_factors {
    size_t rows, columns, rank;
    double *a;         /* rows x columns, row by row */
    double *reflector; /* the first element of each reflection */
    double *scale;     /* of each column of A: it was divided by it */
    size_t *order;     /* column of A that is the k-th of A P; those from `rank` on depend on the
                          others */
    double *spare;     /* internal: a number a column */
};

/*
 * Factor a matrix by Householder reflections with pivoting of columns.
 *
 * Given     a          rows x columns, row by row; it is overwritten and stays in use
 *           tolerance  a column counts as dependent where what the others leave of it is below this
 *                      share of its length; 1e-12 is usual
 * Formula   columns are scaled to length 1 first, so that units do not matter
 * Source    [Golub13] 5.2, 5.4
 */
struct linear_factors linear_factor(double *a, size_t rows, size_t columns, double tolerance,
                                    struct arena *arena);

/*
 * The x that makes |A x - b| smallest.
 *
 * Given     b  `rows` numbers; overwritten
 *           x  receives `columns` numbers; those of dependent columns are 0
 */
void linear_solve(const struct linear_factors *factors, double *b, double *x);

/*
 * The same in two steps. The first makes Q^T b of b, of which the first `rank` numbers are what A
 * can reach; the second uses them up.
 */
void linear_reflect(const struct linear_factors *factors, double *b);
void linear_substitute(const struct linear_factors *factors, double *b, double *x);

/*
 * (A^T A)^-1.
 *
 * Given     inverse  receives columns x columns; NaN in the rows and columns of dependent ones
 */
void linear_normal_inverse(const struct linear_factors *factors, double *inverse,
                           struct arena *arena);

/*
 * Take more rows into the R of those before, so that none of them need be kept: R^T R grows by
 * A^T A, at the accuracy of orthogonal factors.
 *
 * Given     r  columns x columns, row by row, 0 below the diagonal; at first all 0
 *           a  the rows, column by column; overwritten
 * Limits    squares of the numbers must not overflow
 * Source    [Golub13] 6.5.4
 */
void linear_fold(double *r, size_t columns, double *a, size_t rows);

#endif
