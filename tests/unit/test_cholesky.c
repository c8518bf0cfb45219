/* tests/unit/test_cholesky.c - factors that are whole numbers, and matrices that have none. */
/* SPDX-License-Identifier: MIT */
#include "base/cholesky.h"
#include "check.h"

enum { MOST = 13 };

/* L of whole numbers, so that L L^T and all on the way back are exact. */
static double element(size_t i, size_t j)
{
    return i == j ? (double)(1 + i % 4) : (double)((7 * i + 3 * j) % 5) - 2;
}

static void multiply(size_t n, double *a)
{
    for (size_t i = 0; i < n; i++) {
        for (size_t j = 0; j < n; j++) {
            a[i * n + j] = 0;
            for (size_t k = 0; k <= i && k <= j; k++) {
                a[i * n + j] += element(i, k) * element(j, k);
            }
        }
    }
}

/* Every size, as elements are taken four at a time. */
static void test_factors(void)
{
    for (size_t n = 1; n <= MOST; n++) {
        double a[MOST * MOST], b[MOST];
        multiply(n, a);
        for (size_t i = 0; i < n; i++) {
            b[i] = 0;
            for (size_t j = 0; j < n; j++) {
                b[i] += a[i * n + j] * (double)(j + 1);
            }
        }
        CHECK(cholesky_factor(a, n));
        for (size_t i = 0; i < n; i++) {
            for (size_t j = 0; j <= i; j++) {
                CHECK_NEAR(a[i * n + j], element(i, j), 0, "an element of L");
            }
        }
        cholesky_forward(a, n, b);
        cholesky_backward(a, n, b);
        for (size_t i = 0; i < n; i++) {
            CHECK_NEAR(b[i], (double)(i + 1), 1e-6, "a solution");
        }
    }
}

/* A last pivot of 0, below 0 and of no number. */
static void test_refusals(void)
{
    static const double less[] = {0, 1, INFINITY, NAN};
    for (size_t n = 1; n <= MOST; n++) {
        for (size_t i = 0; i < sizeof less / sizeof less[0]; i++) {
            double a[MOST * MOST];
            const double last = element(n - 1, n - 1);
            multiply(n, a);
            a[n * n - 1] -= last * last + less[i];
            CHECK(!cholesky_factor(a, n));
        }
    }
}

int main(void)
{
    test_factors();
    test_refusals();
    return check_report();
}
