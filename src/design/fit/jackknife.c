/* design/fit/jackknife.c - standard errors by leaving out one group of residuals at a time. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/jackknife.h"

#include "base/linear.h"

#include <math.h>
#include <string.h>

/* What is left of 1 in a direction that only one group fixes: rounding. */
static const double nothing = 1e-9;

/* Sums over the rows of each group, in parameters that make J^T J = 1. */
struct jackknife_sums {
    size_t columns;
    double *squares; /* Qg^T Qg, columns x columns a group */
    double *slopes;  /* Qg^T rg, columns a group */
};

/* One row of Q, from that of J: q R = j. */
static void rotate(const struct linear_factors *factors, const double *row, double *q)
{
    size_t n = factors->columns;
    for (size_t k = 0; k < n; k++) {
        size_t from = factors->order[k];
        double sum = row[from] / factors->scale[from];
        for (size_t l = 0; l < k; l++) {
            sum -= q[l] * factors->a[l * n + k];
        }
        q[k] = sum / factors->a[k * n + k];
    }
}

static void jackknife_add_row(const double *q, double residual, size_t group,
                              struct jackknife_sums *sums)
{
    size_t n = sums->columns;
    double *squares = sums->squares + group * n * n, *slopes = sums->slopes + group * n;
    for (size_t i = 0; i < n; i++) {
        slopes[i] += q[i] * residual;
        for (size_t j = 0; j < n; j++) {
            squares[i * n + j] += q[i] * q[j];
        }
    }
}

/* x = (1 - squares)^-1 x by Cholesky's factors; false: that is no positive matrix. */
static bool jackknife_solve_rest(double *squares, size_t n, double *x)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j <= i; j++) {
            double sum = (i == j ? 1 : 0) - squares[i * n + j];
            for (size_t k = 0; k < j; k++) {
                sum -= squares[i * n + k] * squares[j * n + k];
            }
            if (i == j && !(sum > nothing)) {
                return false;
            }
            squares[i * n + j] = i == j ? sqrt(sum) : sum / squares[j * n + j];
        }
    }
    for (size_t i = 0; i < n; i++) {
        for (size_t k = 0; k < i; k++) {
            x[i] -= squares[i * n + k] * x[k];
        }
        x[i] /= squares[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++) {
            x[i] -= squares[k * n + i] * x[k];
        }
        x[i] /= squares[i * n + i];
    }
    return true;
}

static bool jackknife_has_rows(const struct jackknife_sums *sums, size_t group)
{
    size_t n = sums->columns;
    double trace = 0;
    for (size_t i = 0; i < n; i++) {
        trace += sums->squares[group * n * n + i * n + i];
    }
    return trace > 0;
}

/* What leaving out each group changes, squared and added up. Result: how many groups; 0 = none. */
static size_t add_changes(const struct linear_factors *factors, const struct jackknife_sums *sums,
                          size_t group_count, struct arena *arena, double *covariance)
{
    size_t n = sums->columns, count = 0;
    double *change = ARENA_ARRAY(arena, n, double);
    for (size_t g = 0; g < group_count; g++) {
        double *slopes = sums->slopes + g * n;
        if (!jackknife_has_rows(sums, g)) {
            continue;
        }
        if (!jackknife_solve_rest(sums->squares + g * n * n, n, slopes)) {
            return 0;
        }
        linear_substitute(factors, slopes, change);
        for (size_t i = 0; i < n * n; i++) {
            covariance[i] += change[i / n] * change[i % n];
        }
        count++;
    }
    return count;
}

bool jackknife_covariance(const struct jackknife_fit *fit, struct arena *arena, double *covariance)
{
    size_t n = fit->columns, rows = fit->rows, group_count = fit->group_count, count = 0;
    double *a = ARENA_ARRAY(arena, rows * n, double), *q = ARENA_ARRAY(arena, n, double);
    struct jackknife_sums sums = {n, ARENA_ARRAY(arena, group_count * n * n, double),
                                  ARENA_ARRAY(arena, group_count * n, double)};
    memcpy(a, fit->jacobian, rows * n * sizeof(double));
    memset(covariance, 0, n * n * sizeof(double));
    const struct linear_factors factors = linear_factor(a, rows, n, 1e-13, arena);
    if (factors.rank == n) {
        for (size_t i = 0; i < rows; i++) {
            rotate(&factors, fit->jacobian + i * n, q);
            jackknife_add_row(q, fit->residuals[i], fit->group[i], &sums);
        }
        count = add_changes(&factors, &sums, group_count, arena, covariance);
    }
    for (size_t i = 0; i < n * n; i++) {
        covariance[i] *= count > 1 ? (double)(count - 1) / (double)count : (double)NAN;
    }
    return count > 1;
}
