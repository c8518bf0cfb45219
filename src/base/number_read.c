/* base/number_read.c - decimal text to the nearest double. */
/* SPDX-License-Identifier: MIT */
#include "base/number.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number_powers.h"
#include "base/number_short.h"

enum {
    WORD_DIGITS = 19,       /* any so many digits fit into 64 bits */
    MULTIPLIER_DIGITS = 10, /* places that a multiplier of 32 bits can add */
    KEPT_DIGITS = 780,      /* a tie between two doubles has 767 significant digits at most */
};

/* A number in the text: the digits from `first` to before `end` x 10^exponent. */
struct number_read_decimal {
    const char *first;
    const char *point; /* in or at the end of the digits */
    const char *end;
    ptrdiff_t count;    /* of digits */
    uint64_t mantissa;  /* the digits, if count <= WORD_DIGITS */
    ptrdiff_t exponent; /* of the last digit */
};

/* By exponent + 22: what to multiply and to divide by; one of the two is 1. */
static const double multipliers[] = {
    1,   1,   1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,
    1,   1,   1,    1,    1,    1,    1,    1,    1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
    1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
static const double divisors[] = {
    1e22, 1e21, 1e20, 1e19, 1e18, 1e17, 1e16, 1e15, 1e14, 1e13, 1e12, 1e11, 1e10, 1e9, 1e8,
    1e7,  1e6,  1e5,  1e4,  1e3,  1e2,  1e1,  1,    1,    1,    1,    1,    1,    1,   1,
    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,    1,   1};

/* Append digits to the mantissa, modulo 2^64. */
static inline const char *read_digits(const char *at, const char *end, uint64_t *mantissa)
{
    uint64_t all = *mantissa;
    for (; at < end && char_is_digit(*at); at++) {
        all = all * 10 + (uint64_t)(*at - '0');
    }
    *mantissa = all;
    return at;
}

/* `at` is the e; returns it again, with the exponent untouched, if no digit follows. */
static const char *read_exponent(const char *at, const char *end, ptrdiff_t *exponent)
{
    const ptrdiff_t enough = PTRDIFF_MAX / 100; /* outweighs the digits of any text in memory */
    const char *digit = at + 1;
    bool negative = digit < end && *digit == '-';
    if (digit < end && (*digit == '-' || *digit == '+')) {
        digit++;
    }
    if (digit == end || !char_is_digit(*digit)) {
        return at;
    }

    ptrdiff_t typed = 0;
    for (; digit < end && char_is_digit(*digit); digit++) {
        typed = typed < enough ? typed * 10 + (*digit - '0') : typed;
    }
    *exponent += negative ? -typed : typed;
    return digit;
}

/* `at` is behind the sign. */
static const char *number_read_infinity(const char *at, const char *end, bool negative,
                                        double *value)
{
    if (end - at < 3 || memcmp(at, "inf", 3) != 0) {
        return NULL;
    }
    *value = negative ? -INFINITY : INFINITY;
    return at + 3;
}

/*
 * Round factor x 10^power x 2^shift to a double, where the factor has its top bit set and is short
 * by less than `unknown` units, or known exactly if that is 0. False if that does not settle it.
 * Normal doubles keep 53 bits, subnormal ones those that are worth 2^-1074 or more; a carry out of
 * the bits kept runs into the exponent field by itself.
 */
static bool round_to_double(uint64_t factor, unsigned unknown, int power, int shift, double *value)
{
    const uint64_t high = number_multiply_high(factor, power);
    const int top_bit = 62 + (int)(high >> 63);
    int field = number_log2_of_power10(power) + 1 + shift + top_bit + 1023; /* biased exponent */
    int drop = top_bit - 52;
    if (field <= 0) {
        drop += 1 - field;
        field = 1;
    }
    if (drop > 63) {
        return false;
    }

    uint64_t bits;
    if (!number_round_high(high, unknown + 2, drop, &bits)) {
        struct number_product product = number_multiply(factor, power);
        if (unknown > 0) {
            product.slack = (uint128)(unknown + 1) << 64;
            product.exact = false;
        }
        if (!number_round(product, drop + 64, &bits)) {
            return false;
        }
    }
    if (field < 2047) {
        bits += (uint64_t)(field - 1) << 52;
    }
    if (field >= 2047 || bits >= (uint64_t)2047 << 52) {
        *value = INFINITY;
    } else {
        memcpy(value, &bits, sizeof bits);
    }
    return true;
}

/*
 * The 128-bit case: mantissa x multiplier x 10^power, where `more` says that digits behind the
 * mantissa (of WORD_DIGITS digits then) were left out. False if that does not settle the rounding.
 */
static bool read_wide(uint64_t mantissa, bool more, unsigned multiplier, int power, double *value)
{
    if (power < NUMBER_POWER_MIN || power > NUMBER_POWER_MAX) {
        return false;
    }

    /* the first 64 bits of mantissa x multiplier */
    const uint128 whole = (uint128)mantissa * multiplier;
    const uint64_t high = (uint64_t)(whole >> 64);
    unsigned unknown = more ? 32 : 0; /* one in 10^18 is 19 in 2^64, and one for the bits cut */
    if (high == 0) {
        const int shift = __builtin_clzll((uint64_t)whole);
        return round_to_double((uint64_t)whole << shift, unknown, power, -shift, value);
    }
    const int shift = 64 - __builtin_clzll(high);
    const uint64_t factor = (uint64_t)(whole >> shift);
    if (unknown == 0 && whole != (uint128)factor << shift) {
        unknown = 1;
    }
    return round_to_double(factor, unknown, power, shift, value);
}

/*
 * All digits x multiplier from the last to the first; of the result the leading KEPT_DIGITS or a
 * few more go to `kept`, and one more digit tells whether any of the others is not 0.
 * Returns the number of digits kept; the exponent becomes that of the last of them.
 */
static int multiply_digits(struct number_read_decimal *decimal, unsigned multiplier, char *kept)
{
    ptrdiff_t index = decimal->count + MULTIPLIER_DIGITS; /* where the multiplied digit goes */
    uint64_t carry = 0;
    bool others = false;
    for (const char *at = decimal->end; index > 0;) {
        if (at > decimal->first) {
            if (--at == decimal->point) {
                continue;
            }
            carry += (uint64_t)(*at - '0') * multiplier;
        }
        const char digit = (char)(carry % 10);
        carry /= 10;
        index--;
        if (index < KEPT_DIGITS) {
            kept[index] = (char)('0' + digit);
        } else {
            others = others || digit != 0;
        }
    }
    const ptrdiff_t count = decimal->count + MULTIPLIER_DIGITS;
    if (count <= KEPT_DIGITS) {
        return (int)count;
    }
    decimal->exponent += count - KEPT_DIGITS - 1;
    kept[KEPT_DIGITS] = others ? '1' : '0';
    return KEPT_DIGITS + 1;
}

/* All that is not small enough for one exact operation. */
static double read_hard(struct number_read_decimal decimal, unsigned multiplier)
{
    const bool counted = decimal.count <= WORD_DIGITS;
    /* zeros at the front say nothing, nor does a point behind them */
    const char *at = decimal.first;
    while (at < decimal.end && (*at == '0' || *at == '.')) {
        at++;
    }
    bool point_ahead = at <= decimal.point && decimal.point < decimal.end;
    decimal.first = at;
    decimal.count = decimal.end - at - point_ahead;
    if (decimal.count == 0) {
        return 0;
    }

    /* 10^(magnitude - 1) <= digits x 10^exponent < 10^magnitude */
    const ptrdiff_t magnitude = decimal.count + decimal.exponent;
    if (magnitude > 309) {
        return INFINITY;
    }
    if (magnitude < -324 - MULTIPLIER_DIGITS) {
        return 0;
    }

    ptrdiff_t left_out = 0;
    if (decimal.count > WORD_DIGITS) {
        left_out = decimal.count - WORD_DIGITS;
    }
    uint64_t mantissa = decimal.mantissa;
    if (!counted && left_out > 0) {
        /* the first WORD_DIGITS digits, of at least so many */
        mantissa = 0;
        at = decimal.first;
        for (int used = 0; used < WORD_DIGITS; at++) {
            if (at != decimal.point) {
                mantissa = mantissa * 10 + (uint64_t)(*at - '0');
                used++;
            }
        }
    }
    double value;
    if (read_wide(mantissa, left_out > 0, multiplier, (int)(decimal.exponent + left_out), &value)) {
        return value;
    }
    /* the case that is always right: multiply in decimal, then leave the rounding to strtod */
    char text[KEPT_DIGITS + 32];
    int count = multiply_digits(&decimal, multiplier, text);
    snprintf(text + count, sizeof text - (size_t)count, "e%td", decimal.exponent);
    return strtod(text, NULL);
}

/* An integer up to 2^53 and a power of ten up to 10^22 are doubles: one operation, one rounding. */
static inline bool read_exactly(uint64_t mantissa, unsigned multiplier, ptrdiff_t exponent,
                                double *value)
{
    const uint128 whole = (uint128)mantissa * multiplier;
    if (whole > (uint64_t)1 << 53 || exponent < -22 || exponent > 22) {
        return false;
    }
    *value = (double)(int64_t)whole * multipliers[exponent + 22] / divisors[exponent + 22];
    return true;
}

/* Any number; kept out of line so that short ones pay nothing for it. */
__attribute__((noinline)) static const char *read_any(const char *at, const char *end,
                                                      struct number_scale scale, double *value)
{
    const bool negative = at < end && *at == '-';
    if (at < end && (*at == '-' || *at == '+')) {
        at++;
    }

    struct number_read_decimal decimal = {.first = at};
    decimal.point = decimal.end = read_digits(at, end, &decimal.mantissa);
    decimal.count = decimal.end - at;
    if (decimal.point < end && *decimal.point == '.') {
        decimal.end = read_digits(decimal.point + 1, end, &decimal.mantissa);
        decimal.exponent = decimal.point + 1 - decimal.end;
        decimal.count -= decimal.exponent;
    }
    if (decimal.count == 0) {
        return number_read_infinity(at, end, negative, value);
    }

    const char *behind = decimal.end;
    if (behind < end && (*behind == 'e' || *behind == 'E')) {
        behind = read_exponent(behind, end, &decimal.exponent);
    }
    decimal.exponent += scale.power;

    double magnitude;
    if (decimal.count > WORD_DIGITS ||
        !read_exactly(decimal.mantissa, scale.multiplier, decimal.exponent, &magnitude)) {
        magnitude = read_hard(decimal, scale.multiplier);
    }
    *value = negative ? -magnitude : magnitude;
    return behind;
}

const char *number_read(const char *at, const char *end, struct number_scale scale, double *value)
{
    struct number_short number;
    const char *after = end - at >= 8 ? number_read_short(at, &number) : NULL;
    if (after == NULL || (*after | 0x20) == 'e') {
        return read_any(at, end, scale, value);
    }
    const uint64_t whole = (uint64_t)number.mantissa * scale.multiplier;
    const int power = scale.power - (int)number.decimals;
    if (whole > (uint64_t)1 << 53 || power < -22 || power > 22) {
        return read_any(at, end, scale, value);
    }
    *value = (double)(int64_t)whole * multipliers[power + 22] / divisors[power + 22];
    return after;
}

bool text_number(struct text text, struct number_scale scale, double *value)
{
    const char *end = text.start + text.length;
    return text.length > 0 && number_read(text.start, end, scale, value) == end;
}
