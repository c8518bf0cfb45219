/* base/cholesky.h - systems with a positive definite matrix. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_CHOLESKY_H
#define LENSCALC_BASE_CHOLESKY_H

#include <stdbool.h>
#include <stddef.h>

/*
 * A = L L^T.
 *
 * Given     a  n x n, row by row, of which the lower triangle is read; receives L there
 * Result    false: A is not positive definite, as far as rounding tells
 * Source    [Golub13] 4.2
 */
bool cholesky_factor(double *a, size_t n);

/* b becomes L^-1 b, and in the second L^-T b: one after the other A^-1 b. */
void cholesky_forward(const double *l, size_t n, double *b);
void cholesky_backward(const double *l, size_t n, double *b);

#endif
