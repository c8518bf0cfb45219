/* tests/unit/test_solver.c - damped least squares against certified values and classic problems. */
/* SPDX-License-Identifier: MIT */
#include "classics.h"
#include "solver_cases.h"

static void test_classics(void)
{
    for (size_t i = 0; i < sizeof classics / sizeof classics[0]; i++) {
        CHECK_NEAR(classic_minimum(&classics[i], SOLVER_DLS), classics[i].minimum,
                   classics[i].within, classics[i].name);
    }
}

int main(void)
{
    test_solver(SOLVER_DLS);
    test_classics();
    return check_report();
}
