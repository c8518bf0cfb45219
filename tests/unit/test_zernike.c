/* tests/unit/test_zernike.c - Zernike's polynomials: tables, closed forms, orthogonality. */
/* SPDX-License-Identifier: MIT */
#include "analysis/waves/zernike.h"

#include "base/arena.h"
#include "base/constants.h"
#include "check.h"
#include "trace/aim/sample.h"

#include <math.h>

static void check_term(enum zernike_kind kind, size_t i, int index, int n, int m)
{
    const struct zernike_term term = zernike_term(kind, i);
    CHECK(term.index == index && term.n == n && term.m == m);
}

/* Noll's table I, the fringe set, figure 1 of ISO 24157. */
static void test_orders(void)
{
    static const int noll[][2] = {{0, 0},  {1, 1}, {1, -1}, {2, 0}, {2, -2}, {2, 2},
                                  {3, -1}, {3, 1}, {3, -3}, {3, 3}, {4, 0},  {4, 2},
                                  {4, -2}, {4, 4}, {4, -4}, {5, 1}, {5, -1}, {5, 3},
                                  {5, -3}, {5, 5}, {5, -5}, {6, 0}};
    static const int fringe[][2] = {{0, 0},  {1, 1},  {1, -1}, {2, 0}, {2, 2},  {2, -2},
                                    {3, 1},  {3, -1}, {4, 0},  {3, 3}, {3, -3}, {4, 2},
                                    {4, -2}, {5, 1},  {5, -1}, {6, 0}};
    static const int ansi[][2] = {{0, 0},  {1, -1}, {1, 1}, {2, -2}, {2, 0},  {2, 2},
                                  {3, -3}, {3, -1}, {3, 1}, {3, 3},  {4, -4}, {4, -2}};
    for (size_t i = 0; i < sizeof noll / sizeof noll[0]; i++) {
        check_term(ZERNIKE_NOLL, i, (int)i + 1, noll[i][0], noll[i][1]);
    }
    for (size_t i = 0; i < sizeof fringe / sizeof fringe[0]; i++) {
        check_term(ZERNIKE_FRINGE, i, (int)i + 1, fringe[i][0], fringe[i][1]);
    }
    for (size_t i = 0; i < sizeof ansi / sizeof ansi[0]; i++) {
        check_term(ZERNIKE_ANSI, i, (int)i, ansi[i][0], ansi[i][1]);
    }
    /* the 36 terms up to n + |m| = 10, and the spherical one of the next order: the set of 37 */
    check_term(ZERNIKE_FRINGE, 35, 36, 10, 0);
    check_term(ZERNIKE_FRINGE, 36, 37, 12, 0);
    check_term(ZERNIKE_FRINGE, 37, 38, 6, -6);
    check_term(ZERNIKE_FRINGE, 47, 48, 11, -1);
    check_term(ZERNIKE_FRINGE, 48, 49, 6, 6);
    check_term(ZERNIKE_FRINGE, 49, 50, 7, 7);
}

/* Beside the axis of y: 3 x y^2 - x^3 and 2 x y (3 - 4 r^2) of so small x lose no digit. */
static void test_beside_axis(void)
{
    const double x = 2.7977389686314596e-05, y = -0.75, r2 = x * x + y * y;
    double values[24];
    zernike_fill(ZERNIKE_FRINGE, 24, x, y, values);
    CHECK_RELATIVE(values[9], x * (x * x - 3 * y * y), 4e-16, "trefoil");
    CHECK_RELATIVE(values[12], 2 * x * y * (4 * r2 - 3), 2e-15, "secondary astigmatism");
}

/* By hand: 6 r^4 - 6 r^2 + 1, (3 r^3 - 2 r) sin, r^2 sin(2 angle). */
static void test_closed(void)
{
    const double x = 0.36, y = 0.48, r2 = x * x + y * y;
    double values[24];
    zernike_fill(ZERNIKE_NOLL, 11, x, y, values);
    CHECK_NEAR(values[10], sqrt(5) * (6 * r2 * r2 - 6 * r2 + 1), 1e-15, "spherical");
    CHECK_NEAR(values[6], sqrt(8) * (3 * r2 - 2) * y, 1e-15, "coma");
    CHECK_NEAR(values[4], sqrt(6) * 2 * x * y, 1e-15, "astigmatism");
    zernike_fill(ZERNIKE_FRINGE, 9, x, y, values);
    CHECK_NEAR(values[8], 6 * r2 * r2 - 6 * r2 + 1, 1e-15, "spherical");
    CHECK_NEAR(values[1], x, 1e-16, "tilt");
    zernike_fill(ZERNIKE_NOLL, 4, 0, 0, values);
    CHECK_NEAR(values[3], -sqrt(3), 1e-15, "defocus in the middle");
}

/* At the edge R = 1 for every order, which sums of powers miss by far from order 40 on. */
static void test_edge(void)
{
    static double values[ZERNIKE_MOST];
    zernike_fill(ZERNIKE_FRINGE, ZERNIKE_MOST, 1, 0, values);
    for (size_t i = 0; i < ZERNIKE_MOST; i++) {
        const struct zernike_term term = zernike_term(ZERNIKE_FRINGE, i);
        CHECK_NEAR(values[i], term.m < 0 ? 0 : 1, 1e-12, "at the edge");
    }
}

/* Mean products over the disc, by a quadrature that is exact for their degree. */
static void test_orthonormal(void)
{
    enum { TERMS = 66 };
    struct arena arena = {0};
    struct error error;
    struct sample sample;
    static double sums[TERMS][TERMS];
    double values[TERMS], worst = 0;
    CHECK(sample_make(PATTERN_GAUSS, 500, 0, &arena, &sample, &error));
    for (size_t i = 0; i < sample.count; i++) {
        const struct pupil_point *point = &sample.points[i];
        zernike_fill(ZERNIKE_ANSI, TERMS, point->x, point->y, values);
        for (size_t j = 0; j < TERMS; j++) {
            for (size_t k = 0; k < TERMS; k++) {
                sums[j][k] += point->weight * values[j] * values[k];
            }
        }
    }
    for (size_t j = 0; j < TERMS; j++) {
        for (size_t k = 0; k < TERMS; k++) {
            worst = fmax(worst, fabs(sums[j][k] - (j == k)));
        }
    }
    CHECK_NEAR(worst, 0, 1e-13, "mean products");
    arena_free(&arena);
}

int main(void)
{
    test_orders();
    test_beside_axis();
    test_closed();
    test_edge();
    test_orthonormal();
    return check_report();
}
