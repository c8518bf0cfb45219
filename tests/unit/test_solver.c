/* tests/unit/test_solver.c - damped least squares against certified values and classic problems. */
/* SPDX-License-Identifier: MIT */
#include "base/processor.h"
#include "classics.h"
#include "design/solver/solver_normal.h"
#include "solver_cases.h"

static void test_classics(void)
{
    for (size_t i = 0; i < sizeof classics / sizeof classics[0]; i++) {
        CHECK_NEAR(classic_minimum(&classics[i], SOLVER_DLS), classics[i].minimum,
                   classics[i].within, classics[i].name);
    }
}

/* Sums of products by hand, and the same bits with every instruction set. */
static void test_normal(void)
{
    enum { COLUMNS = 11, MOST = 300 };
    static double jacobian[MOST * COLUMNS], residuals[MOST], weights[MOST];
    struct arena arena = {0};
    for (size_t i = 0; i < MOST * COLUMNS; i++) {
        jacobian[i] = sin((double)i);
        residuals[i / COLUMNS] = cos(3.0 * (double)(i / COLUMNS));
        weights[i / COLUMNS] = 1 + 0.5 * sin(7.0 * (double)(i / COLUMNS));
    }
    for (size_t count = 1; count <= MOST; count = 2 * count + 1) {
        for (int weighted = 0; weighted < 2; weighted++) {
            const struct solver_rows rows = {count,
                                             COLUMNS,
                                             jacobian,
                                             residuals,
                                             weighted == 1 ? weights : NULL,
                                             solver_normal_room(COLUMNS, &arena)};
            double normal[3][COLUMNS * COLUMNS], gradient[3][COLUMNS];
            kernel_normal_sse2(&rows, normal[0], gradient[0]);
            solver_normal(&rows, normal[1], gradient[1]);
            if (processor_has_avx2()) {
                kernel_normal_avx2(&rows, normal[2], gradient[2]);
                CHECK(memcmp(normal[0], normal[2], sizeof normal[0]) == 0);
                CHECK(memcmp(gradient[0], gradient[2], sizeof gradient[0]) == 0);
            }
            CHECK(memcmp(normal[0], normal[1], sizeof normal[0]) == 0);
            CHECK(memcmp(gradient[0], gradient[1], sizeof gradient[0]) == 0);
            double corner = 0, last = 0;
            for (size_t r = 0; r < count; r++) {
                const double w = weighted == 1 ? weights[r] : 1;
                corner += w * jacobian[r * COLUMNS] * jacobian[r * COLUMNS + 10];
                last += w * jacobian[r * COLUMNS + 10] * residuals[r];
            }
            CHECK_NEAR(normal[0][10], corner, 1e-12, "normal equations");
            CHECK_NEAR(normal[0][10 * COLUMNS], corner, 1e-12, "their other half");
            CHECK_NEAR(gradient[0][10], last, 1e-12, "gradient");
        }
    }
    arena_free(&arena);
}

int main(void)
{
    test_normal();
    test_solver(SOLVER_DLS);
    test_classics();
    return check_report();
}
