/* tests/unit/test_spot.c - the two directions that spots of angles lie along. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/spot.h"
#include "check.h"

static double product(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Across the direction and each other, of length 1; upright, whichever way the light goes. */
static void test_axes(void)
{
    static const double directions[][3] = {{0, 0, 1},
                                           {0, 0.6, 0.8},
                                           {0, -0.6, -0.8},
                                           {2. / 7, 3. / 7, 6. / 7},
                                           {-6. / 7, 2. / 7, -3. / 7},
                                           {1, 0, 0}};
    for (size_t i = 0; i < sizeof directions / sizeof directions[0]; i++) {
        const double *d = directions[i];
        double across[2][3];
        spot_axes(d, across);
        for (int k = 0; k < 2; k++) {
            CHECK_NEAR(product(across[k], d), 0, 1e-15, "across the direction");
            CHECK_NEAR(product(across[k], across[k]), 1, 1e-15, "its length");
        }
        CHECK_NEAR(product(across[0], across[1]), 0, 1e-15, "across each other");
        CHECK(across[1][0] == 0 && across[1][1] > 0);
        CHECK(d[2] == 0 || across[0][0] > 0);
    }
}

int main(void)
{
    test_axes();
    return check_report();
}
