/* base/twofold.c - read decimal numbers with what a double leaves over. */
/* SPDX-License-Identifier: MIT */
#include "base/twofold.h"

#include "base/number.h"

#include <stddef.h>
#include <stdint.h>

enum { MOST_DIGITS = 18, MOST_POWER = 22, MOST_EXPONENT = 40 };

/* A decimal number as an integer times 10^exponent. */
struct decimal {
    int64_t mantissa;
    int exponent;
    bool fits;
};

static bool is_digit(const char *at, const char *end)
{
    return at < end && *at >= '0' && *at <= '9';
}

/* Digits with at most one point among them. */
static struct decimal read_digits(const char **at, const char *end)
{
    struct decimal decimal = {0, 0, true};
    bool point = false;
    for (; is_digit(*at, end) || (*at < end && **at == '.'); ++*at) {
        if (**at == '.') {
            point = true;
            continue;
        }
        if (decimal.mantissa > 99999999999999999) {
            decimal.fits = false;
            return decimal;
        }
        decimal.mantissa = 10 * decimal.mantissa + (**at - '0');
        decimal.exponent -= point;
    }
    return decimal;
}

/* Take apart what number_read has found to be a number. */
static struct decimal take_apart(const char *at, const char *end)
{
    bool negative = *at == '-';
    at += *at == '-' || *at == '+';
    if (at < end && *at == 'i') {
        return (struct decimal){0, 0, false};
    }
    struct decimal decimal = read_digits(&at, end);
    if (decimal.fits && at < end) {
        bool down = at + 1 < end && at[1] == '-';
        int exponent = 0;
        for (at += 1 + (at + 1 < end && (at[1] == '-' || at[1] == '+')); is_digit(at, end); at++) {
            exponent = exponent < 1000 ? 10 * exponent + (*at - '0') : exponent;
        }
        decimal.exponent += down ? -exponent : exponent;
    }
    decimal.mantissa = negative ? -decimal.mantissa : decimal.mantissa;
    return decimal;
}

/* 10^n for 0 <= n <= 40, exact up to 22, else to 2^-104. */
static struct twofold power_of_ten(int n)
{
    static const double exact[] = {1,    1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    return n <= MOST_POWER ? twofold_of(exact[n])
                           : twofold_exact_product(exact[MOST_POWER], exact[n - MOST_POWER]);
}

/* What the double `high` leaves over of the decimal. */
static double left_over(struct decimal decimal, double high)
{
    if (!decimal.fits || decimal.exponent > 0 || decimal.exponent < -MOST_EXPONENT) {
        return 0;
    }
    /* the mantissa as the sum of two doubles, each exact */
    const int64_t split = 1 << 30;
    struct twofold mantissa = twofold_exact_sum((double)(decimal.mantissa / split * split),
                                                (double)(decimal.mantissa % split));
    struct twofold power = power_of_ten(-decimal.exponent);
    struct twofold rest = twofold_subtract(mantissa, twofold_multiply(power, twofold_of(high)));
    return rest.high / power.high;
}

const char *twofold_read(const char *at, const char *end, struct twofold *value)
{
    double high;
    const char *after = number_read(at, end, (struct number_scale){1, 0}, &high);
    if (after != NULL) {
        *value = (struct twofold){high, left_over(take_apart(at, after), high)};
    }
    return after;
}
