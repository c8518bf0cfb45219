/* tests/unit/test_linear.c - least squares against exact fractions. */
/* SPDX-License-Identifier: MIT */
#include "base/linear.h"

#include "check.h"

enum { MOST = 15 };

/* Solved with fractions: x = (A^T A)^-1 A^T b. Pivots out of order, heads of both signs. */
static const struct {
    const char *name;
    size_t rows, columns;
    double a[MOST], b[5], x[3], inverse[9];
} cases[] = {
    {"a square", 2, 2, {2, 1, 1, 3}, {5, 10}, {1, 3}, {2.0 / 5, -1.0 / 5, -1.0 / 5, 1.0 / 5}},
    {"a pivot that is not first",
     4,
     3,
     {1, 100, 3, 0, 100, -4, 2, 100, 1, -1, 50, 2},
     {1, 2, 3, 4},
     {-440.0 / 503, 387.0 / 12575, 93.0 / 503},
     {386.0 / 1509, -24.0 / 12575, -29.0 / 1509, -24.0 / 12575, 57.0 / 1257500, 1.0 / 25150,
      -29.0 / 1509, 1.0 / 25150, 53.0 / 1509}},
    {"negative heads",
     5,
     3,
     {-3, 1, 2, -1, -4, 1, -2, 2, -5, 1, 1, 1, 4, -2, 3},
     {1, -2, 3, -4, 5},
     {7871.0 / 18065, 668.0 / 18065, -4671.0 / 18065},
     {751.0 / 18065, 128.0 / 18065, -246.0 / 18065, 128.0 / 18065, 984.0 / 18065, 367.0 / 18065,
      -246.0 / 18065, 367.0 / 18065, 706.0 / 18065}},
    {"one column", 3, 1, {3, 4, 12}, {1, 1, 1}, {19.0 / 169}, {1.0 / 169}},
};

/* Columns times 10^power and the answers back: units do not matter, nor squares that overflow. */
static void check_case(size_t i, int power)
{
    struct arena arena = {0};
    double a[MOST], b[5], x[3] = {NAN, NAN, NAN}, inverse[9];
    const double scale = pow(10, power);
    size_t n = cases[i].columns;
    memcpy(b, cases[i].b, sizeof b);
    for (size_t k = 0; k < cases[i].rows * n; k++) {
        a[k] = cases[i].a[k] * scale;
    }
    struct linear_factors factors = linear_factor(a, cases[i].rows, n, 1e-12, &arena);
    CHECK(factors.rank == n);
    linear_solve(&factors, b, x);
    linear_normal_inverse(&factors, inverse, &arena);
    for (size_t k = 0; k < n; k++) {
        CHECK_NEAR(x[k] * scale, cases[i].x[k], 1e-14, cases[i].name);
    }
    for (size_t k = 0; k < n * n && power > -100 && power < 100; k++) {
        CHECK_NEAR(inverse[k] * scale * scale, cases[i].inverse[k], 1e-14, cases[i].name);
    }
    arena_free(&arena);
}

/* The third column is twice the first less the second; what depends gets 0, and NaN. */
static void test_dependent(void)
{
    struct arena arena = {0};
    double a[] = {1, 0, 2, 0, 3, -3, 0, 4, -4, 2, 0, 4}, b[] = {3, 3, 4, 6}, x[3], inverse[9];
    const double whole[] = {1, 0, 2, 0, 3, -3, 0, 4, -4, 2, 0, 4};
    struct linear_factors factors = linear_factor(a, 4, 3, 1e-12, &arena);
    CHECK(factors.rank == 2);
    linear_solve(&factors, b, x);
    linear_normal_inverse(&factors, inverse, &arena);
    const double reached[] = {3, 3, 4, 6};
    for (size_t i = 0; i < 4; i++) {
        double sum = 0;
        for (size_t j = 0; j < 3; j++) {
            sum += whole[i * 3 + j] * x[j];
        }
        CHECK_NEAR(sum, reached[i], 1e-14, "b lies in the plane of the columns");
    }
    size_t out = factors.order[2];
    CHECK_NEAR(x[out], 0, 0, "the dependent one");
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) {
            CHECK(isnan(inverse[i * 3 + j]) == (i == out || j == out));
        }
    }
    arena_free(&arena);
}

/* Less rows than columns, a column of zeros, nothing but zeros. */
static void test_edges(void)
{
    struct arena arena = {0};
    double wide[] = {3, 4}, one[] = {10}, x[2];
    struct linear_factors factors = linear_factor(wide, 1, 2, 1e-12, &arena);
    CHECK(factors.rank == 1);
    linear_solve(&factors, one, x);
    CHECK_NEAR(3 * x[0] + 4 * x[1], 10, 1e-14, "one of the two columns");
    double gap[] = {2, 0, 0, 0}, two[] = {4, 7};
    factors = linear_factor(gap, 2, 2, 1e-12, &arena);
    CHECK(factors.rank == 1);
    linear_solve(&factors, two, x);
    CHECK_NEAR(x[0], 2, 1e-15, "the other column");
    CHECK_NEAR(x[1], 0, 0, "a column of zeros");
    double nothing[] = {0, 0, 0, 0};
    CHECK(linear_factor(nothing, 2, 2, 1e-12, &arena).rank == 0);
    /* a column that the first leaves 1e-6 of is used or not, as the tolerance says */
    double near[] = {1, 1, 0, 1e-6}, again[] = {1, 1, 0, 1e-6};
    CHECK(linear_factor(near, 2, 2, 1e-5, &arena).rank == 1);
    CHECK(linear_factor(again, 2, 2, 1e-7, &arena).rank == 2);
    arena_free(&arena);
}

/* Rows that come one, two or all at once have the same R^T R = A^T A, in whole numbers. */
static void test_fold(void)
{
    enum { ROWS = 5, COLUMNS = 3 };
    static const double rows[ROWS][COLUMNS] = {
        {-3, 1, 2}, {-1, -4, 1}, {-2, 2, -5}, {1, 1, 1}, {4, -2, 3}};
    for (size_t step = 1; step <= ROWS; step++) {
        double r[COLUMNS * COLUMNS] = {0}, a[COLUMNS * ROWS];
        for (size_t first = 0; first < ROWS; first += step) {
            size_t count = ROWS - first < step ? ROWS - first : step;
            for (size_t k = 0; k < count * COLUMNS; k++) {
                a[k] = rows[first + k % count][k / count];
            }
            linear_fold(r, COLUMNS, a, count);
        }
        for (size_t i = 0; i < COLUMNS; i++) {
            for (size_t j = 0; j < COLUMNS; j++) {
                double sum = 0, expected = 0;
                for (size_t k = 0; k < COLUMNS; k++) {
                    sum += r[k * COLUMNS + i] * r[k * COLUMNS + j];
                }
                for (size_t k = 0; k < ROWS; k++) {
                    expected += rows[k][i] * rows[k][j];
                }
                CHECK_NEAR(sum, expected, 1e-13, "R^T R");
                CHECK(i <= j || !(fabs(r[i * COLUMNS + j]) > 0));
            }
        }
    }
}

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        check_case(i, 0);
        check_case(i, 3);
        check_case(i, -120);
        check_case(i, 160);
        check_case(i, -170);
    }
    test_dependent();
    test_edges();
    test_fold();
    return check_report();
}
