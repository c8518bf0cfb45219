/* tests/unit/test_dof_turn.c - places of distances on a disc against the limits of sharpness. */
/* SPDX-License-Identifier: MIT */
#include "check.h"
#include "photo/dof_turn.h"

#include <math.h>

/*
 * The limits by similar triangles, each number a fraction: with X = s - f(1 - 1/P) and
 * eps = N c (s - f)/f^2, near = s - X eps/(1 + eps), far = s + X eps/(1 - eps).
 */
static const struct {
    double f, N, c, P, s, near, far;
} cases[] = {
    /* eps = 8 * 0.03 * 2950/2500 = 0.2832 */
    {50, 8, 0.03, 1, 3000, 3000 / 1.2832, 3000 / 0.7168},
    /* eps = 0.5, X = 1010 - 20 (1 - 2) = 1030 */
    {20, 4, 0.05, 0.5, 1010, 1010 - 1030 * 0.495 / 1.495, 1010 + 1030 * 0.495 / 0.505},
    /* a macro lens at 1:1, P = 2: X = 200 - 50 = 150, eps = 11 * 0.02 * 100/10^4 = 0.0022 */
    {100, 11, 0.02, 2, 200, 200 - 150 * 0.0022 / 1.0022, 200 + 150 * 0.0022 / 0.9978},
};

int main(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const double f = cases[i].f, P = cases[i].P, s = dof_turn_place(f, P, cases[i].s);
        double near, far;
        dof_turn_limits(f, cases[i].N, cases[i].c, P, &near, &far);
        CHECK_NEAR(dof_turn_place(f, P, cases[i].near) - s, near, 1e-14, "near limit");
        CHECK_NEAR(s - dof_turn_place(f, P, cases[i].far), far, 1e-14, "far limit");
    }
    /* the hyperfocal distance f^2/(N c) + f has infinity as its far limit, whatever P is */
    double near, far;
    dof_turn_limits(50, 8, 0.03, 1.5, &near, &far);
    CHECK_NEAR(dof_turn_place(50, 1.5, 2500 / 0.24 + 50), far, 1e-14, "hyperfocal distance");
    CHECK(dof_turn_place(50, 1, INFINITY) == 0);
    dof_turn_limits(1, 100, 0.01, 1, &near, &far);
    CHECK(isinf(near));
    CHECK_NEAR(far, 0.69314718055994531, 1e-15, "ln 2");
    return check_report();
}
