/* base/pair.c - decimal text to a pair of doubles. */
/* SPDX-License-Identifier: MIT */
#include "base/pair.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* -------- short numbers, as most are: an integer over a power of ten -------- */

enum { MOST_POWER = 22, MOST_DECIMALS = 40 };

/* mantissa x 10^exponent, of at most 18 digits. */
struct pair_decimal {
    int64_t mantissa;
    int exponent;
};

/* Take apart what number_read has found to be a finite number without its sign. */
static bool pair_take_apart(const char *at, const char *end, struct pair_decimal *decimal)
{
    const int64_t full = 99999999999999999;
    int64_t mantissa = 0;
    int exponent = 0;
    bool point = false;
    for (; at < end && *at != 'e' && *at != 'E'; at++) {
        if (*at == '.') {
            point = true;
            continue;
        }
        if (mantissa > full) {
            return false;
        }
        mantissa = 10 * mantissa + (*at - '0');
        exponent -= point;
    }
    if (at < end) {
        bool down = at[1] == '-';
        int typed = 0;
        for (at += 1 + (down || at[1] == '+'); at < end; at++) {
            typed = typed < 1000 ? 10 * typed + (*at - '0') : typed;
        }
        exponent += down ? -typed : typed;
    }
    *decimal = (struct pair_decimal){mantissa, exponent};
    return true;
}

/* -------- all others -------- */

enum { CHUNK_DIGITS = 15, CHUNKS = 3, MOST_EXPONENT = 250 };

/* The leading digits of a decimal number: chunks of 15 digits, which are exact doubles. */
struct digits {
    double chunks[CHUNKS];
    int count;       /* digits kept */
    double exponent; /* of the last digit kept */
};

/* Digits, point and exponent of a number that number_read has accepted. */
static struct digits pair_scan(const char *at, const char *end)
{
    struct digits digits = {.count = 0};
    bool behind_point = false;
    for (; at < end && *at != 'e' && *at != 'E'; at++) {
        if (*at == '.') {
            behind_point = true;
            continue;
        }
        bool leading_zero = digits.count == 0 && *at == '0';
        if (!leading_zero && digits.count < CHUNK_DIGITS * CHUNKS) {
            double *chunk = &digits.chunks[digits.count++ / CHUNK_DIGITS];
            *chunk = *chunk * 10 + (*at - '0');
        } else if (!leading_zero) {
            digits.exponent += 1;
        }
        digits.exponent -= behind_point;
    }
    if (at < end) {
        double typed;
        at++;
        at += *at == '+';
        if (number_read(at, end, NUMBER_UNSCALED, &typed) != NULL) {
            digits.exponent += typed;
        }
    }
    return digits;
}

static struct pair pair_power_of_ten(int exponent)
{
    struct pair power = {1, 0}, base = {10, 0};
    for (int left = abs(exponent); left > 0; left /= 2) {
        if (left % 2 != 0) {
            power = pair_multiply(power, base);
        }
        base = left > 1 ? pair_multiply(base, base) : base;
    }
    return power;
}

static double long_left_over(const char *at, const char *end, struct number_scale scale, double hi)
{
    struct digits digits = pair_scan(at, end);
    if (!(hi < 1e200) || !(hi > 1e-200) || !(fabs(digits.exponent) <= MOST_EXPONENT)) {
        return 0;
    }
    /* the digits' value, to about 1e-32 */
    struct pair value = {0, 0};
    for (int first = 0; first < digits.count; first += CHUNK_DIGITS) {
        int length = digits.count - first < CHUNK_DIGITS ? digits.count - first : CHUNK_DIGITS;
        value = pair_add(pair_multiply(value, pair_power_of_ten(length)),
                         pair_of(digits.chunks[first / CHUNK_DIGITS]));
    }
    int exponent = (int)digits.exponent + scale.power;
    value = pair_multiply(value, pair_of((double)scale.multiplier));
    struct pair power = pair_power_of_ten(exponent);
    struct pair exact = exponent < 0 ? pair_divide(value, power) : pair_multiply(value, power);
    return (exact.hi - hi) + exact.lo;
}

const char *pair_read(const char *at, const char *end, struct number_scale scale,
                      struct pair *value)
{
    const char *behind = number_read(at, end, scale, &value->hi);
    if (behind == NULL) {
        return NULL;
    }
    bool negative = *at == '-';
    at += *at == '-' || *at == '+';
    double hi = fabs(value->hi), lo = 0;
    struct pair_decimal decimal;
    if (scale.multiplier == 1 && *at != 'i' && pair_take_apart(at, behind, &decimal) &&
        decimal.exponent + scale.power <= 0 && decimal.exponent + scale.power >= -MOST_DECIMALS) {
        decimal.exponent += scale.power;
        /* what the double `hi` leaves over of the decimal: (mantissa - hi 10^n) / 10^n */
        const int64_t split = 1 << 30; /* the mantissa as the sum of two doubles, each exact */
        struct pair mantissa = pair_sum((double)(decimal.mantissa / split * split),
                                        (double)(decimal.mantissa % split));
        /* 10^n for 0 <= n <= 40, exact up to 22, else to 2^-104 */
        const int n = -decimal.exponent;
        static const double exact[] = {1,    1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                       1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
        struct pair power = n <= MOST_POWER
                                ? pair_of(exact[n])
                                : pair_product(exact[MOST_POWER], exact[n - MOST_POWER]);
        struct pair rest = pair_subtract(mantissa, pair_multiply(power, pair_of(hi)));
        lo = rest.hi / power.hi;
    } else if (hi > 0 && hi < INFINITY) {
        lo = long_left_over(at, behind, scale, hi);
    }
    value->lo = negative ? -lo : lo;
    return behind;
}

bool text_pair(struct text text, struct number_scale scale, struct pair *value)
{
    const char *end = text.start + text.length;
    return text.length > 0 && pair_read(text.start, end, scale, value) == end;
}
