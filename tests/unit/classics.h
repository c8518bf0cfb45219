/* tests/unit/classics.h - classic least-squares problems: unbounded, bounded, with conditions. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_CLASSICS_H
#define LENSCALC_TESTS_UNIT_CLASSICS_H

#include "base/constants.h"
#include "check.h"
#include "design/solver/solver.h"

#include <stdint.h>

enum { CLASSIC_MOST = 20 };

/*
 * Sources: MGH, J. More, B. Garbow, K. Hillstrom, "Testing unconstrained optimization software",
 * ACM Trans. Math. Software 7 (1981), problem number; HS, W. Hock, K. Schittkowski, "Test examples
 * for nonlinear programming codes", Springer 1981, problem number. Minima as printed there; where
 * they are rational, as such.
 */
struct classic {
    const char *name;
    size_t n, squares, exact;
    void (*residuals)(const double *x, double *r); /* squares, then the exact ones */
    double start[CLASSIC_MOST], low[CLASSIC_MOST], high[CLASSIC_MOST];
    bool has_bounds;
    double minimum; /* of the sum of squares */
    double within;  /* of what is printed: its last digit */
    bool dls_only;  /* there are other minima, or Ceres needs over 1000 iterations */
};

static inline void mgh_2(const double *x, double *r)
{
    r[0] = -13 + x[0] + ((5 - x[1]) * x[1] - 2) * x[1];
    r[1] = -29 + x[0] + ((x[1] + 1) * x[1] - 14) * x[1];
}

static inline void mgh_3(const double *x, double *r)
{
    r[0] = 1e4 * x[0] * x[1] - 1;
    r[1] = exp(-x[0]) + exp(-x[1]) - 1.0001;
}

static inline void mgh_4(const double *x, double *r)
{
    r[0] = x[0] - 1e6;
    r[1] = x[1] - 2e-6;
    r[2] = x[0] * x[1] - 2;
}

static inline void mgh_5(const double *x, double *r)
{
    static const double y[3] = {1.5, 2.25, 2.625};
    double power = 1;
    for (int i = 0; i < 3; i++) {
        power *= x[1];
        r[i] = y[i] - x[0] * (1 - power);
    }
}

static inline void mgh_6(const double *x, double *r)
{
    for (int i = 1; i <= 10; i++) {
        r[i - 1] = 2 + 2 * i - (exp(i * x[0]) + exp(i * x[1]));
    }
}

static inline void mgh_7(const double *x, double *r)
{
    const double turn = atan(x[1] / x[0]) / (2 * PI) + (x[0] < 0 ? 0.5 : 0);
    r[0] = 10 * (x[2] - 10 * turn);
    r[1] = 10 * (hypot(x[0], x[1]) - 1);
    r[2] = x[2];
}

static inline void mgh_8(const double *x, double *r)
{
    static const double y[15] = {0.14, 0.18, 0.22, 0.25, 0.29, 0.32, 0.35, 0.39,
                                 0.37, 0.58, 0.73, 0.96, 1.34, 2.10, 4.39};
    for (int i = 1; i <= 15; i++) {
        const double u = i, v = 16 - i, w = fmin(u, v);
        r[i - 1] = y[i - 1] - (x[0] + u / (v * x[1] + w * x[2]));
    }
}

static inline void mgh_13(const double *x, double *r)
{
    r[0] = x[0] + 10 * x[1];
    r[1] = sqrt(5) * (x[2] - x[3]);
    r[2] = (x[1] - 2 * x[2]) * (x[1] - 2 * x[2]);
    r[3] = sqrt(10) * (x[0] - x[3]) * (x[0] - x[3]);
}

static inline void mgh_14(const double *x, double *r)
{
    r[0] = 10 * (x[1] - x[0] * x[0]);
    r[1] = 1 - x[0];
    r[2] = sqrt(90) * (x[3] - x[2] * x[2]);
    r[3] = 1 - x[2];
    r[4] = sqrt(10) * (x[1] + x[3] - 2);
    r[5] = (x[1] - x[3]) / sqrt(10);
}

static inline void mgh_15(const double *x, double *r)
{
    static const double y[11] = {0.1957, 0.1947, 0.1735, 0.1600, 0.0844, 0.0627,
                                 0.0456, 0.0342, 0.0323, 0.0235, 0.0246};
    static const double u[11] = {4, 2, 1, 0.5, 0.25, 0.167, 0.125, 0.1, 0.0833, 0.0714, 0.0625};
    for (int i = 0; i < 11; i++) {
        r[i] = y[i] - x[0] * u[i] * (u[i] + x[1]) / (u[i] * (u[i] + x[2]) + x[3]);
    }
}

static inline void mgh_16(const double *x, double *r)
{
    for (int i = 1; i <= 20; i++) {
        const double t = i / 5.0, a = x[0] + t * x[1] - exp(t), b = x[2] + x[3] * sin(t) - cos(t);
        r[i - 1] = a * a + b * b;
    }
}

static inline void hs_1(const double *x, double *r)
{
    r[0] = 10 * (x[1] - x[0] * x[0]);
    r[1] = 1 - x[0];
}

static inline void hs_6(const double *x, double *r)
{
    r[0] = 1 - x[0];
    r[1] = 10 * (x[1] - x[0] * x[0]);
}

static inline void hs_27(const double *x, double *r)
{
    r[0] = 0.1 * (x[0] - 1);
    r[1] = x[1] - x[0] * x[0];
    r[2] = x[0] + x[2] * x[2] + 1;
}

static inline void hs_28(const double *x, double *r)
{
    r[0] = x[0] + x[1];
    r[1] = x[1] + x[2];
    r[2] = x[0] + 2 * x[1] + 3 * x[2] - 1;
}

static inline void hs_42(const double *x, double *r)
{
    for (int i = 0; i < 4; i++) {
        r[i] = x[i] - (i + 1);
    }
    r[4] = x[0] - 2;
    r[5] = x[2] * x[2] + x[3] * x[3] - 2;
}

static inline void hs_52(const double *x, double *r)
{
    r[0] = 4 * x[0] - x[1];
    r[1] = x[1] + x[2] - 2;
    r[2] = x[3] - 1;
    r[3] = x[4] - 1;
    r[4] = x[0] + 3 * x[1];
    r[5] = x[2] + x[3] - 2 * x[4];
    r[6] = x[1] - x[4];
}

/* The last condition said twice. */
static inline void hs_52_twice(const double *x, double *r)
{
    hs_52(x, r);
    r[7] = r[6];
}

static inline void hs_53(const double *x, double *r)
{
    hs_52(x, r);
    r[0] = x[0] - x[1];
}

static inline void hs_60(const double *x, double *r)
{
    r[0] = x[0] - 1;
    r[1] = x[0] - x[1];
    r[2] = (x[1] - x[2]) * (x[1] - x[2]);
    r[3] = x[0] * (1 + x[1] * x[1]) + x[2] * x[2] * x[2] * x[2] - 4 - 3 * sqrt(2);
}

static inline void hs_77(const double *x, double *r)
{
    const double c = x[2] * x[2], d = x[4] - 1;
    r[0] = x[0] - 1;
    r[1] = x[0] - x[1];
    r[2] = x[2] - 1;
    r[3] = (x[3] - 1) * (x[3] - 1);
    r[4] = d * d * d;
    r[5] = x[0] * x[0] * x[3] + sin(x[3] - x[4]) - 2 * sqrt(2);
    r[6] = x[1] + c * c * x[3] * x[3] - 8 - sqrt(2);
}

static inline void hs_79(const double *x, double *r)
{
    r[0] = x[0] - 1;
    r[1] = x[0] - x[1];
    r[2] = x[1] - x[2];
    r[3] = (x[2] - x[3]) * (x[2] - x[3]);
    r[4] = (x[3] - x[4]) * (x[3] - x[4]);
    r[5] = x[0] + x[1] * x[1] + x[2] * x[2] * x[2] - 2 - 3 * sqrt(2);
    r[6] = x[1] - x[2] * x[2] + x[3] + 2 - 2 * sqrt(2);
    r[7] = x[0] * x[4] - 2;
}

/* Residuals that are linear, twenty parameters in bounds: each is where its bound is nearest. */
static inline void box_20(const double *x, double *r)
{
    for (int i = 0; i < 20; i++) {
        r[i] = x[i] - 0.1 * i;
    }
}

static const struct classic classics[] = {
    {"MGH 2, Freudenstein and Roth", 2, 2, 0, mgh_2, {6, 6}, .minimum = 0, .within = 1e-12},
    {"MGH 3, Powell badly scaled", 2, 2, 0, mgh_3, {0, 1}, .minimum = 0, .within = 1e-12},
    {"MGH 4, Brown badly scaled", 2, 3, 0, mgh_4, {1, 1}, .minimum = 0, .within = 1e-12},
    {"MGH 5, Beale", 2, 3, 0, mgh_5, {1, 1}, .minimum = 0, .within = 1e-12},
    {"MGH 6, Jennrich and Sampson",
     2,
     10,
     0,
     mgh_6,
     {0.3, 0.4},
     .minimum = 124.362,
     .within = 5e-4},
    {"MGH 7, helical valley", 3, 3, 0, mgh_7, {-1, 0, 0}, .minimum = 0, .within = 1e-12},
    {"MGH 8, Bard", 3, 15, 0, mgh_8, {1, 1, 1}, .minimum = 8.21487e-3, .within = 1e-8},
    {"MGH 13, Powell singular", 4, 4, 0, mgh_13, {3, -1, 0, 1}, .minimum = 0, .within = 1e-12},
    {"MGH 14, Wood", 4, 6, 0, mgh_14, {-3, -1, -3, -1}, .minimum = 0, .within = 1e-12},
    {"MGH 15, Kowalik and Osborne",
     4,
     11,
     0,
     mgh_15,
     {0.25, 0.39, 0.415, 0.39},
     .minimum = 3.07505e-4,
     .within = 1e-9},
    {"MGH 16, Brown and Dennis",
     4,
     20,
     0,
     mgh_16,
     {25, 5, -5, -1},
     .minimum = 85822.2,
     .within = 0.05,
     .dls_only = true},
    {"HS 1",
     2,
     2,
     0,
     hs_1,
     {-2, 1},
     {-INFINITY, -1.5},
     {INFINITY, INFINITY},
     true,
     .minimum = 0,
     .within = 1e-12},
    {"HS 2",
     2,
     2,
     0,
     hs_1,
     {2, 2},
     {-INFINITY, 1.5},
     {INFINITY, INFINITY},
     true,
     .minimum = 0.0504261879,
     .within = 1e-9,
     .dls_only = true},
    {"HS 38",
     4,
     6,
     0,
     mgh_14,
     {-3, -1, -3, -1},
     {-10, -10, -10, -10},
     {10, 10, 10, 10},
     true,
     .minimum = 0,
     .within = 1e-12},
    {"HS 6", 2, 1, 1, hs_6, {-1.2, 1}, .minimum = 0, .within = 1e-12},
    {"HS 27", 3, 2, 1, hs_27, {2, 2, 2}, .minimum = 0.04, .within = 1e-9},
    {"HS 28", 3, 2, 1, hs_28, {-4, 1, 1}, .minimum = 0, .within = 1e-12},
    {"HS 42", 4, 4, 2, hs_42, {1, 1, 1, 1}, .minimum = 13.857864376269049, .within = 1e-9},
    {"HS 52", 5, 4, 3, hs_52, {2, 2, 2, 2, 2}, .minimum = 1859.0 / 349, .within = 1e-10},
    {"HS 52, one condition twice",
     5,
     4,
     4,
     hs_52_twice,
     {2, 2, 2, 2, 2},
     .minimum = 1859.0 / 349,
     .within = 1e-10},
    {"HS 53",
     5,
     4,
     3,
     hs_53,
     {2, 2, 2, 2, 2},
     {-10, -10, -10, -10, -10},
     {10, 10, 10, 10, 10},
     true,
     .minimum = 176.0 / 43,
     .within = 1e-10},
    {"HS 60",
     3,
     3,
     1,
     hs_60,
     {2, 2, 2},
     {-10, -10, -10},
     {10, 10, 10},
     true,
     .minimum = 0.03256820025,
     .within = 1e-10},
    {"HS 77", 5, 5, 2, hs_77, {2, 2, 2, 2, 2}, .minimum = 0.24150512879, .within = 1e-10},
    {"HS 79", 5, 5, 3, hs_79, {2, 2, 2, 2, 2}, .minimum = 0.0787768209, .within = 1e-10},
    /* 0.8 for 0 .. 0.7, 1 for 1.1 .. 1.9: 0.64+0.49+..+0.01 = 2.04, 0.01+..+0.81 = 2.85 */
    {"twenty bounds",
     20,
     20,
     0,
     box_20,
     {0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9,
      0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9, 0.9},
     {0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8,
      0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8},
     {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1},
     true,
     .minimum = 4.89,
     .within = 1e-12},
};

/* Derivatives by central differences: good to 1e-9 of them. */
static inline bool classic_evaluate(void *context, const double *x, double *r, double *jacobian)
{
    const struct classic *classic = context;
    const size_t n = classic->n, m = classic->squares + classic->exact;
    double moved[CLASSIC_MOST], high[CLASSIC_MOST + 8], low[CLASSIC_MOST + 8];
    classic->residuals(x, r);
    for (size_t j = 0; j < n && jacobian != NULL; j++) {
        const double h = 6e-6 * fmax(fabs(x[j]), 1e-2);
        memcpy(moved, x, n * sizeof *x);
        moved[j] = x[j] + h;
        classic->residuals(moved, high);
        moved[j] = x[j] - h;
        classic->residuals(moved, low);
        for (size_t i = 0; i < m; i++) {
            jacobian[i * n + j] = (high[i] - low[i]) / (2 * h);
        }
    }
    return true;
}

/* The sum of squares that it ends with; NaN where the conditions are not met to 1e-10. */
static inline double classic_minimum(const struct classic *classic, enum solver_engine engine)
{
    const struct solver_problem problem = {.parameter_count = classic->n,
                                           .residual_count = classic->squares + classic->exact,
                                           .exact_count = classic->exact,
                                           .evaluate = classic_evaluate,
                                           .context = (void *)(uintptr_t)classic,
                                           .low = classic->has_bounds ? classic->low : NULL,
                                           .high = classic->has_bounds ? classic->high : NULL};
    const struct solver_options options = {
        .engine = engine, .iterations = 1000, .gradient = 1e-15, .lean = true};
    struct arena arena = {0};
    struct solver_summary summary;
    struct error error;
    double x[CLASSIC_MOST];
    memcpy(x, classic->start, sizeof x);
    const bool done = solver_run(&problem, &options, x, &arena, &summary, &error);
    CHECK(done && summary.status == SOLVER_CONVERGED);
    const double minimum = done && summary.excess <= 1e-10 ? 2 * summary.final_cost : NAN;
    arena_free(&arena);
    return minimum;
}

#endif
