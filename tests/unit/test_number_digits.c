/* tests/unit/test_number_digits.c - how many digits a number needs. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"
#include "check.h"

/* By hand: 0.1 needs 1 digit, 1/3 needs 16 ("0.3333333333333333"), 2^53 + 2 needs 16. */
static void test_needs_more(void)
{
    static const struct {
        double x;
        int needs;
    } cases[] = {{0.1, 1},   {1.0 / 3, 16},  {9007199254740994.0, 16},
                 {1e300, 1}, {123456, 6},    {1200, 2},
                 {-2.5, 2},  {5e-324, 1},    {1e22, 1},
                 {0.3, 1},   {0.1 + 0.2, 17}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int digits = 1; digits <= 17; digits++) {
            CHECK(number_needs_more(cases[i].x, digits) == (digits < cases[i].needs));
        }
    }
    CHECK(!number_needs_more(0, 1) && !number_needs_more(INFINITY, 1) &&
          !number_needs_more(NAN, 1));
}

int main(void)
{
    test_needs_more();
    return check_report();
}
