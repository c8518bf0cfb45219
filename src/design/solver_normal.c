/* design/solver_normal.c - the normal equations of residuals and their derivatives. */
/* SPDX-License-Identifier: MIT */
#include "design/solver_normal.h"

#include <string.h>

static double weight_of(const struct solver_rows *rows, size_t r)
{
    return rows->weights != NULL ? rows->weights[r] : 1;
}

/* Four rows at a time, so that sums are fetched and stored a quarter as often. */
static void add_four(const struct solver_rows *rows, size_t r, double *normal)
{
    const size_t n = rows->columns;
    const double *a = rows->jacobian + r * n, *b = a + n, *c = b + n, *d = c + n;
    const double wa = weight_of(rows, r), wb = weight_of(rows, r + 1);
    const double wc = weight_of(rows, r + 2), wd = weight_of(rows, r + 3);
    for (size_t i = 0; i < n; i++) {
        const double ai = wa * a[i], bi = wb * b[i], ci = wc * c[i], di = wd * d[i];
        double *restrict sums = normal + i * n;
        for (size_t j = 0; j <= i; j++) {
            sums[j] += (ai * a[j] + bi * b[j]) + (ci * c[j] + di * d[j]);
        }
    }
}

static void add_one(const struct solver_rows *rows, size_t r, double *normal)
{
    const size_t n = rows->columns;
    const double *a = rows->jacobian + r * n, w = weight_of(rows, r);
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            normal[i * n + j] += w * a[i] * a[j];
        }
    }
}

void solver_gradient(const struct solver_rows *rows, double *gradient)
{
    const size_t n = rows->columns;
    memset(gradient, 0, n * sizeof(double));
    for (size_t r = 0; r < rows->rows; r++) {
        const double *a = rows->jacobian + r * n, w = weight_of(rows, r) * rows->residuals[r];
        for (size_t i = 0; i < n; i++) {
            gradient[i] += w * a[i];
        }
    }
}

void solver_normal(const struct solver_rows *rows, double *normal, double *gradient)
{
    const size_t n = rows->columns;
    size_t r = 0;
    memset(normal, 0, n * n * sizeof(double));
    for (; r + 4 <= rows->rows; r += 4) {
        add_four(rows, r, normal);
    }
    for (; r < rows->rows; r++) {
        add_one(rows, r, normal);
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < i; j++) {
            normal[j * n + i] = normal[i * n + j];
        }
    }
    solver_gradient(rows, gradient);
}
