/* tests/unit/test_number_digits.c - how many digits a number needs, and as people read it. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"
#include "check.h"

#include <stdlib.h>

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

/* The same by printf: rounded by %e, then laid out by %f. */
static void expect_plain(char *to, double x, int digits, bool padded)
{
    char rounded[40];
    snprintf(rounded, sizeof rounded, "%.*e", digits - 1, x);
    int exponent = atoi(strchr(rounded, 'e') + 1);
    if (exponent < -6 || exponent > 8) {
        snprintf(to, 64, "%.*g", digits, x);
        return;
    }
    int decimals = digits - 1 - exponent;
    snprintf(to, 64, "%.*f", decimals > 0 ? decimals : 0, strtod(rounded, NULL));
    size_t length = strlen(to);
    while (!padded && decimals > 0 && to[length - 1] == '0') {
        length--;
    }
    to[length - (!padded && decimals > 0 && to[length - 1] == '.' ? 1 : 0)] = '\0';
}

static void check_plain(double x, int digits, bool padded)
{
    char expected[64], text[NUMBER_LENGTH + 1];
    expect_plain(expected, x, digits, padded);
    *number_write_plain(text, x, digits, padded) = '\0';
    CHECK_TEXT(text, expected);
}

static void test_plain(void)
{
    static const double chosen[] = {1,        -1,
                                    9.9996,   99.95,
                                    0.0625,   1234565,
                                    123456,   2.5e-6,
                                    9.99e-7,  1e-6,
                                    999999.5, 99999999,
                                    1e9,      999999999.9,
                                    0.1,      2.675,
                                    1000,     1e-300,
                                    1.7e308,  -0.3,
                                    5e-324,   4503599627370497.5,
                                    0.000125, 123456789,
                                    8.5};
    static const struct {
        double x;
        int digits;
        bool padded;
        const char *text;
    } known[] = {{10, 4, true, "10.00"},
                 {10, 4, false, "10"},
                 {123456, 3, true, "123000"},
                 {9.9996, 4, true, "10.00"},
                 {0.0000125, 3, true, "0.0000125"},
                 {-0.5, 3, false, "-0.5"},
                 {INFINITY, 4, true, "inf"},
                 {0, 4, true, "0"}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        char text[NUMBER_LENGTH + 1];
        *number_write_plain(text, known[i].x, known[i].digits, known[i].padded) = '\0';
        CHECK_TEXT(text, known[i].text);
    }
    for (int digits = 1; digits <= 17; digits++) {
        for (size_t i = 0; i < sizeof chosen / sizeof chosen[0]; i++) {
            check_plain(chosen[i], digits, true);
            check_plain(chosen[i], digits, false);
        }
    }
    unsigned long long state = 1;
    for (int i = 0; i < 20000; i++) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        double fraction = (double)(state >> 11) * 0x1p-53, x = pow(10, 18 * fraction - 8);
        check_plain(i % 2 ? x : -x, 1 + i % 17, i % 3 == 0);
        /* few digits: ties and zeros at the end */
        check_plain((1 + floor(x * 8)) / 8, 1 + i % 12, i % 3 == 0);
    }
}

int main(void)
{
    test_needs_more();
    test_plain();
    return check_report();
}
