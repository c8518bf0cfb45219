/* design/fit/jackknife.c - standard errors by leaving out one group of residuals at a time. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/jackknife.h"

#include "base/cholesky.h"
#include "base/linear.h"

#include <math.h>
#include <string.h>

/* What is left of 1 in a direction that only one group fixes: rounding. */
static const double nothing = 1e-9;

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

bool jackknife_covariance(const struct jackknife_fit *fit, struct arena *arena, double *covariance)
{
    const size_t n = fit->columns, rows = fit->rows;
    size_t count = 0; /* of groups that were left out */
    double *a = ARENA_ARRAY(arena, rows * n, double), *q = ARENA_ARRAY(arena, n, double);
    double *change = ARENA_ARRAY(arena, n, double);
    /* of each group Qg^T Qg and Qg^T rg, in parameters that make J^T J = 1 */
    double *squares = ARENA_ARRAY(arena, fit->group_count * n * n, double);
    double *slopes = ARENA_ARRAY(arena, fit->group_count * n, double);
    memcpy(a, fit->jacobian, rows * n * sizeof(double));
    memset(covariance, 0, n * n * sizeof(double));
    const struct linear_factors factors = linear_factor(a, rows, n, 1e-13, arena);
    bool is_fixed = factors.rank == n;
    for (size_t r = 0; r < rows && is_fixed; r++) {
        const size_t g = fit->group[r];
        rotate(&factors, fit->jacobian + r * n, q);
        for (size_t i = 0; i < n; i++) {
            slopes[g * n + i] += q[i] * fit->residuals[r];
            for (size_t j = 0; j < n; j++) {
                squares[g * n * n + i * n + j] += q[i] * q[j];
            }
        }
    }
    for (size_t g = 0; g < fit->group_count && is_fixed; g++) {
        double *rest = squares + g * n * n, *solved = slopes + g * n, trace = 0;
        for (size_t i = 0; i < n * n; i += n + 1) {
            trace += rest[i];
        }
        if (!(trace > 0)) {
            continue; /* it has no rows */
        }
        /* (1 - Qg^T Qg)^-1 Qg^T rg, where that is a positive matrix */
        for (size_t i = 0; i < n * n; i++) {
            rest[i] = (i / n == i % n ? 1 : 0) - rest[i];
        }
        is_fixed = cholesky_factor(rest, n);
        for (size_t i = 0; i < n && is_fixed; i++) {
            is_fixed = rest[i * n + i] > sqrt(nothing);
        }
        if (is_fixed) {
            cholesky_forward(rest, n, solved);
            cholesky_backward(rest, n, solved);
            linear_substitute(&factors, solved, change);
        }
        /* what leaving out the group changes, squared and added up */
        for (size_t i = 0; i < n * n; i++) {
            covariance[i] += change[i / n] * change[i % n];
        }
        count++;
    }
    const bool is_known = is_fixed && count > 1;
    for (size_t i = 0; i < n * n; i++) {
        covariance[i] *= is_known ? (double)(count - 1) / (double)count : (double)NAN;
    }
    return is_known;
}
