/* tests/unit/test_polynomial.c - roots of polynomials whose roots are known by construction. */
/* SPDX-License-Identifier: MIT */
#include "base/polynomial.h"
#include "check.h"

/* The product of (x - root). */
static struct polynomial with_roots(const double *roots, size_t count)
{
    struct polynomial all = {0, {pair_of(1)}};
    for (size_t i = 0; i < count; i++) {
        const struct polynomial factor = polynomial_linear(pair_of(-roots[i]), pair_of(1));
        all = polynomial_multiply(&all, &factor);
    }
    return all;
}

static void check_known(void)
{
    static const struct {
        double roots[12];
        size_t count;
        double low, high;
        double expected[12];
        size_t expected_count;
    } cases[] = {
        {{1, 2, 3}, 3, -INFINITY, INFINITY, {1, 2, 3}, 3},
        {{1, 2, 3}, 3, 1.5, 3, {2, 3}, 2},
        {{1, 2, 3}, 3, 3.5, INFINITY, {0}, 0},
        {{-1e6, 1e-6}, 2, -INFINITY, INFINITY, {-1e6, 1e-6}, 2},
        {{5, 5, -1}, 3, -INFINITY, INFINITY, {-1, 5}, 2}, /* a double root once */
        {{0, 0, 0, 4}, 4, -1, 10, {0, 4}, 2},
        {{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12},
         12,
         -INFINITY,
         INFINITY,
         {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12},
         12},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct pair roots[POLYNOMIAL_DEGREE];
        const struct polynomial a = with_roots(cases[i].roots, cases[i].count);
        size_t count = polynomial_roots(&a, cases[i].low, cases[i].high, 1, roots);
        CHECK(count == cases[i].expected_count);
        for (size_t k = 0; k < count && k < cases[i].expected_count; k++) {
            CHECK_NEAR(roots[k].hi, cases[i].expected[k], 1e-15 * (1 + fabs(roots[k].hi)), "root");
        }
    }
}

/* x^2 - 2 and x^2 + 1; a constant; the highest term only rounding. */
static void check_others(void)
{
    struct pair roots[POLYNOMIAL_DEGREE];
    const struct polynomial two = {2, {{-2, 0}, {0, 0}, {1, 0}}},
                            none = {2, {{1, 0}, {0, 0}, {1, 0}}};
    const struct polynomial constant = {1, {{3, 0}, {1e-30, 0}}};
    CHECK(polynomial_roots(&two, 0, INFINITY, 1, roots) == 1);
    CHECK_NEAR(roots[0].hi, 1.4142135623730951, 0, "the root of 2");
    CHECK_NEAR(roots[0].lo, -9.667293313452913e-17, 1e-30, "what the double leaves over");
    CHECK(polynomial_roots(&none, -INFINITY, INFINITY, 1, roots) == 0);
    CHECK(polynomial_roots(&constant, -INFINITY, INFINITY, 1, roots) == 0);
    CHECK(polynomial_is_constant(&constant, 1) && !polynomial_is_constant(&two, 1));
}

int main(void)
{
    check_known();
    check_others();
    return check_report();
}
