/* tests/unit/test_jackknife.c - standard errors against fits made anew without each group. */
/* SPDX-License-Identifier: MIT */
#include "design/fit/jackknife.h"

#include "check.h"
#include "stream.h"

enum { ROWS = 14, COLUMNS = 3, GROUPS = 6 };

static struct stream stream = {.seed = 5};
/* rows of no group 3: it does not count; the last group is that of one row */
static const size_t group[ROWS] = {0, 0, 0, 1, 1, 2, 2, 2, 2, 4, 4, 4, 4, 5};

static double determinant(double a[COLUMNS][COLUMNS])
{
    double sum = 0;
    for (int i = 0; i < 3; i++) {
        sum += a[0][i] *
               (a[1][(i + 1) % 3] * a[2][(i + 2) % 3] - a[1][(i + 2) % 3] * a[2][(i + 1) % 3]);
    }
    return sum;
}

/* Least squares of all rows but those of a group, by Cramer's rule of their normal equations. */
static void fit_without(const double *jacobian, const double *residuals, size_t without,
                        double change[COLUMNS])
{
    double normal[COLUMNS][COLUMNS] = {{0}}, right[COLUMNS] = {0};
    for (int r = 0; r < ROWS; r++) {
        for (int i = 0; i < COLUMNS && group[r] != without; i++) {
            right[i] -= jacobian[r * COLUMNS + i] * residuals[r];
            for (int j = 0; j < COLUMNS; j++) {
                normal[i][j] += jacobian[r * COLUMNS + i] * jacobian[r * COLUMNS + j];
            }
        }
    }
    const double whole = determinant(normal);
    for (int k = 0; k < COLUMNS; k++) {
        double other[COLUMNS][COLUMNS];
        memcpy(other, normal, sizeof normal);
        for (int i = 0; i < COLUMNS; i++) {
            other[i][k] = right[i];
        }
        change[k] = determinant(other) / whole;
    }
}

/* Residuals at the minimum of all, where they are across all columns; the last group knows nothing
   of one of them. */
static void make_fit(int without, double *jacobian, double *residuals)
{
    double change[COLUMNS];
    for (int r = 0; r < ROWS; r++) {
        residuals[r] = between(&stream, -1, 1);
        for (int i = 0; i < COLUMNS; i++) {
            jacobian[r * COLUMNS + i] = between(&stream, -1, 2) * (i == 1 ? 100 : 1);
        }
    }
    jacobian[(ROWS - 1) * COLUMNS + without] = 0;
    fit_without(jacobian, residuals, GROUPS, change);
    for (int r = 0; r < ROWS; r++) {
        for (int i = 0; i < COLUMNS; i++) {
            residuals[r] += jacobian[r * COLUMNS + i] * change[i];
        }
    }
}

/* Five groups have rows: 4/5 of the sum of the squares of what leaving one out changes. */
static void test_refits(void)
{
    for (int trial = 0; trial < 20; trial++) {
        struct arena arena = {0};
        double jacobian[ROWS * COLUMNS], residuals[ROWS];
        double covariance[COLUMNS * COLUMNS], expected[COLUMNS * COLUMNS] = {0};
        make_fit(trial % COLUMNS, jacobian, residuals);
        for (size_t g = 0; g < GROUPS; g++) {
            double change[COLUMNS];
            fit_without(jacobian, residuals, g, change);
            for (int i = 0; i < COLUMNS * COLUMNS && g != 3; i++) {
                expected[i] += 0.8 * change[i / COLUMNS] * change[i % COLUMNS];
            }
        }
        CHECK(jackknife_covariance(
            &(struct jackknife_fit){residuals, jacobian, ROWS, COLUMNS, group, GROUPS}, &arena,
            covariance));
        for (int i = 0; i < COLUMNS * COLUMNS; i++) {
            const double size =
                sqrt(expected[i / COLUMNS * (COLUMNS + 1)] * expected[i % COLUMNS * (COLUMNS + 1)]);
            CHECK_NEAR(covariance[i], expected[i], 1e-10 * size, "covariance");
        }
        arena_free(&arena);
    }
}

/* A column that only one group has: without it, it is open; and two that are alike always are. */
static void test_open(void)
{
    struct arena arena = {0};
    double jacobian[ROWS * COLUMNS], residuals[ROWS], covariance[COLUMNS * COLUMNS];
    make_fit(0, jacobian, residuals);
    const struct jackknife_fit fit = {residuals, jacobian, ROWS, COLUMNS, group, GROUPS};
    for (int r = 0; r < ROWS; r++) {
        jacobian[r * COLUMNS + 2] = group[r] == 1 ? 1 : 0;
    }
    CHECK(!jackknife_covariance(&fit, &arena, covariance));
    for (int i = 0; i < COLUMNS * COLUMNS; i++) {
        CHECK(isnan(covariance[i]));
    }
    for (int r = 0; r < ROWS; r++) {
        jacobian[r * COLUMNS + 2] = 2 * jacobian[r * COLUMNS];
    }
    CHECK(!jackknife_covariance(&fit, &arena, covariance));
    arena_free(&arena);
}

int main(void)
{
    test_refits();
    test_open();
    return check_report();
}
