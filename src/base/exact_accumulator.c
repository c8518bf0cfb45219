/* base/exact_accumulator.c - sums without rounding: the same in whatever order they are made. */
/* SPDX-License-Identifier: MIT */
#include "base/exact_accumulator.h"

#include <math.h>
#include <string.h>

enum { DIGIT_BITS = 32, MANTISSA_BITS = 52, LOWEST = -1074 };

static const uint64_t digit_mask = 0xffffffffU;

void exact_accumulator_add(struct exact_accumulator *sum, double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t exponent = bits >> MANTISSA_BITS & 0x7ff;
    const uint64_t fraction = bits & ((UINT64_C(1) << MANTISSA_BITS) - 1);
    const uint64_t m = exponent > 0 ? fraction | UINT64_C(1) << MANTISSA_BITS : fraction;
    const uint64_t place = exponent > 0 ? exponent - 1 : 0;
    const uint64_t digit = place / DIGIT_BITS, shift = place % DIGIT_BITS;
    const uint64_t low = (m & digit_mask) << shift, high = (m >> DIGIT_BITS) << shift;
    const int64_t parts[3] = {(int64_t)(low & digit_mask),
                              (int64_t)((low >> DIGIT_BITS) + (high & digit_mask)),
                              (int64_t)(high >> DIGIT_BITS)};
    const int64_t sign = bits >> 63 != 0 ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        sum->digits[digit + (uint64_t)k] += sign * parts[k];
    }
}

void exact_accumulator_join(struct exact_accumulator *sum, const struct exact_accumulator *more)
{
    for (int i = 0; i < EXACT_ACCUMULATOR_DIGITS; i++) {
        sum->digits[i] += more->digits[i];
    }
}

/* Digits of 0 .. 2^32 - 1 by carrying; false: the sum is negative, and they are no number. */
static int carry(const struct exact_accumulator *sum, int64_t sign,
                 int64_t digits[EXACT_ACCUMULATOR_DIGITS])
{
    int64_t over = 0;
    for (int i = 0; i < EXACT_ACCUMULATOR_DIGITS; i++) {
        const int64_t all = sign * sum->digits[i] + over;
        digits[i] = (int64_t)((uint64_t)all & digit_mask);
        over = (all - digits[i]) / ((int64_t)1 << DIGIT_BITS);
    }
    return over == 0;
}

double exact_accumulator_value(const struct exact_accumulator *sum)
{
    int64_t digits[EXACT_ACCUMULATOR_DIGITS];
    double sign = 1, value = 0;
    if (!carry(sum, 1, digits)) {
        sign = -1;
        carry(sum, -1, digits);
    }
    int top = EXACT_ACCUMULATOR_DIGITS - 1;
    while (top > 0 && digits[top] == 0) {
        top--;
    }
    /* the leading four hold 97 bits at least */
    for (int i = top >= 3 ? top - 3 : 0; i <= top; i++) {
        value += ldexp((double)digits[i], DIGIT_BITS * i + LOWEST);
    }
    return sign * value;
}
