/* base/cholesky.c - systems with a positive definite matrix. */
/* SPDX-License-Identifier: MIT */
#include "base/cholesky.h"

#include <math.h>

enum { TOGETHER = 4 };

/* What is left of some elements of a row, from `first` on, after the columns before `first`: side
   by side, as each sum waits for its last term. */
static void take_columns(const double *row, const double *others, size_t n, size_t first,
                         double sums[TOGETHER])
{
    const double *o0 = others, *o1 = others + n, *o2 = others + 2 * n, *o3 = others + 3 * n;
    double s0 = row[first], s1 = row[first + 1], s2 = row[first + 2], s3 = row[first + 3];
    for (size_t k = 0; k < first; k++) {
        const double here = row[k];
        s0 -= here * o0[k];
        s1 -= here * o1[k];
        s2 -= here * o2[k];
        s3 -= here * o3[k];
    }
    sums[0] = s0, sums[1] = s1, sums[2] = s2, sums[3] = s3;
}

/* An element of row i and column j, of which the columns before `first` are taken already. */
static bool finish_element(double *a, size_t n, size_t i, size_t j, size_t first, double sum)
{
    double *row = a + i * n;
    const double *other = a + j * n;
    for (size_t k = first; k < j; k++) {
        sum -= row[k] * other[k];
    }
    if (j < i) {
        row[j] = sum / other[j];
        return true;
    }
    row[i] = sqrt(sum);
    return sum > 0 && isfinite(sum);
}

bool cholesky_factor(double *a, size_t n)
{
    for (size_t i = 0; i < n; i++) {
        const double *row = a + i * n;
        size_t j = 0;
        for (; j + TOGETHER <= i; j += TOGETHER) {
            double sums[TOGETHER];
            take_columns(row, a + j * n, n, j, sums);
            for (size_t k = 0; k < TOGETHER; k++) {
                finish_element(a, n, i, j + k, j, sums[k]);
            }
        }
        for (; j <= i; j++) {
            if (!finish_element(a, n, i, j, 0, row[j])) {
                return false;
            }
        }
    }
    return true;
}

void cholesky_forward(const double *l, size_t n, double *b)
{
    for (size_t i = 0; i < n; i++) {
        double sum = b[i];
        for (size_t k = 0; k < i; k++) {
            sum -= l[i * n + k] * b[k];
        }
        b[i] = sum / l[i * n + i];
    }
}

void cholesky_backward(const double *l, size_t n, double *b)
{
    for (size_t i = n; i-- > 0;) {
        double sum = b[i];
        for (size_t k = i + 1; k < n; k++) {
            sum -= l[k * n + i] * b[k];
        }
        b[i] = sum / l[i * n + i];
    }
}
