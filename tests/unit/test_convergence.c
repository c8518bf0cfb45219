/* tests/unit/test_convergence.c - errors from halves, and sums of them. */
/* SPDX-License-Identifier: MIT */
#include "camera/photograph/convergence.h"
#include "check.h"

/* Of light without a white of its own: a share of each number, or a grey level of 8 bits. */
static void test_relative(void)
{
    /* means of 408 and 392, and of 400 alike, white 1000: y = 0.392 of the darker half, where a
       level of sRGB is 0.392^0.5625/(0.4396 255) = 0.005268 of white, 5.268 */
    const double first[] = {816, 800}, both[] = {1600, 1600};
    const double level = 1000 * pow(0.392, 0.5625) * 2.4 / 1.055 / 255;
    const struct convergence_goal fine = {0.001, 1000}, coarse = {0.1, 1000};
    CHECK_RELATIVE(convergence_relative(&fine, first, both, 2, 2), 8 / level / sqrt(2), 1e-12,
                   "by a level");
    CHECK_RELATIVE(convergence_relative(&coarse, first, both, 2, 2), 8 / 39.2 / sqrt(2), 1e-12,
                   "by a share of the light");
    /* near black the level is that of the straight part, 1000/(12.92 255) */
    const double dark[] = {2.4e-9}, none[] = {2.4e-9};
    CHECK_RELATIVE(convergence_relative(&fine, dark, none, 1, 2), 0.6e-9 * 12.92 * 255 / 1000, 1e-9,
                   "of black");
    /* negative light, as of sRGB's red in cyan, is as exact as positive one */
    const double cold[] = {-816, -800}, colder[] = {-1600, -1600};
    CHECK_RELATIVE(convergence_relative(&coarse, cold, colder, 2, 2), 8 / 39.2 / sqrt(2), 1e-12,
                   "below 0");
}

int main(void)
{
    test_relative();
    /* means of two: 1 and 2, 5 and 2; of the other two: 3 and 2, 5 and 6: differences 2, 0, 0, 4 */
    const double first[] = {2, 4, 10, 4}, both[] = {8, 8, 20, 16};
    CHECK_NEAR(convergence_halves(first, both, 4, 2), sqrt((1 + 0 + 0 + 4) / 4.0), 1e-15,
               "by hand");
    /* 1 and 3 of one ray each, by half of the smaller; its grey level is far below that */
    const double one[] = {1}, two[] = {4};
    const struct convergence_goal goal = {.error = 0.5, .white = 1e-12};
    CHECK_NEAR(convergence_relative(&goal, one, two, 1, 1), 2, 1e-12, "by the smaller half");
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
