/* tests/unit/test_convergence.c - errors from halves, and sums of them. */
/* SPDX-License-Identifier: MIT */
#include "camera/convergence.h"
#include "check.h"

int main(void)
{
    /* means of two: 1 and 2, 5 and 2; of the other two: 3 and 2, 5 and 6: differences 2, 0, 0, 4 */
    const double first[] = {2, 4, 10, 4}, both[] = {8, 8, 20, 16};
    CHECK_NEAR(convergence_halves(first, both, 4, 2), sqrt((1 + 0 + 0 + 4) / 4.0), 1e-15,
               "by hand");
    uint64_t counts[CONVERGENCE_COUNTS] = {0};
    convergence_add(counts, 0.5, 16);
    convergence_add(counts, 1, 64);
    CHECK(counts[CONVERGENCE_MISSED] == 0 && counts[CONVERGENCE_RAYS] == 80);
    CHECK_NEAR(convergence_error(counts, true), 0, 0, "none missed");
    convergence_add(counts, 3, 128);
    convergence_add(counts, 4, 128);
    CHECK(counts[CONVERGENCE_TILES] == 4 && counts[CONVERGENCE_MISSED] == 2);
    CHECK_NEAR(convergence_error(counts, false), sqrt(26.25 / 4), 1e-12, "of all");
    CHECK_NEAR(convergence_error(counts, true), sqrt(12.5), 1e-6, "of those that missed");
    /* neither infinity nor a whole picture of the worst overflows */
    for (int i = 0; i < 600000; i++) {
        convergence_add(counts, INFINITY, 1);
    }
    CHECK_RELATIVE(convergence_error(counts, true), sqrt(1e10), 1e-5, "capped");
    return check_report();
}
