/* tests/ceres/test_solver.c - Ceres against certified values, bounds, losses, refusals. */
/* SPDX-License-Identifier: MIT */
#include "classics.h"
#include "solver_cases.h"

/* Both end in the same minimum of the classic problems whose only one it is. */
static void test_agreement(void)
{
    for (size_t i = 0; i < sizeof classics / sizeof classics[0]; i++) {
        if (classics[i].exact == 0 && !classics[i].dls_only) {
            const double dls = classic_minimum(&classics[i], SOLVER_DLS);
            CHECK_NEAR(classic_minimum(&classics[i], SOLVER_CERES), dls, 1e-8 * (dls + 1e-2),
                       classics[i].name);
        }
    }
}

int main(void)
{
    test_solver(SOLVER_CERES);
    test_agreement();
    return check_report();
}
