/* base/pair.c - decimal text to a pair of doubles. */
/* SPDX-License-Identifier: MIT */
#include "base/pair.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum { CHUNK_DIGITS = 15, CHUNKS = 3, MOST_EXPONENT = 250 };

/* The leading digits of a decimal number: chunks of 15 digits, which are exact doubles. */
struct digits {
    double chunks[CHUNKS];
    int count;       /* digits kept */
    double exponent; /* of the last digit kept */
};

/* Digits, point and exponent of a number that number_read has accepted. */
static struct digits scan(const char *at, const char *end)
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
        if (number_read(at, end, (struct number_scale){1, 0}, &typed) != NULL) {
            digits.exponent += typed;
        }
    }
    return digits;
}

static struct pair power_of_ten(int exponent)
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

/* The digits' value, to about 1e-32. */
static struct pair value_of(const struct digits *digits, struct number_scale scale)
{
    struct pair value = {0, 0};
    for (int first = 0; first < digits->count; first += CHUNK_DIGITS) {
        int length = digits->count - first < CHUNK_DIGITS ? digits->count - first : CHUNK_DIGITS;
        value = pair_add(pair_multiply(value, power_of_ten(length)),
                         pair_of(digits->chunks[first / CHUNK_DIGITS]));
    }
    int exponent = (int)digits->exponent + scale.power;
    value = pair_multiply(value, pair_of((double)scale.multiplier));
    struct pair power = power_of_ten(exponent);
    return exponent < 0 ? pair_divide(value, power) : pair_multiply(value, power);
}

const char *pair_read(const char *at, const char *end, struct number_scale scale,
                      struct pair *value)
{
    double hi;
    const char *behind = number_read(at, end, scale, &hi);
    if (behind == NULL) {
        return NULL;
    }
    *value = pair_of(hi);
    bool negative = *at == '-';
    at += *at == '-' || *at == '+';
    if (hi == 0 || !(fabs(hi) < 1e200) || !(fabs(hi) > 1e-200)) {
        return behind;
    }
    struct digits digits = scan(at, behind);
    if (!(fabs(digits.exponent) <= MOST_EXPONENT)) {
        return behind;
    }
    struct pair exact = value_of(&digits, scale);
    exact = negative ? pair_negate(exact) : exact;
    value->lo = (exact.hi - hi) + exact.lo;
    return behind;
}
