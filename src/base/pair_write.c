/* base/pair_write.c - a pair of doubles as decimal text. */
/* SPDX-License-Identifier: MIT */
#include "base/pair.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIGITS = 32 };

/* 0.d1 d2 d3 ... x 10^point */
struct pair_write_decimal {
    bool negative;
    int point, count;
    char digits[MOST_DIGITS + 1]; /* '0' .. '9' */
};

static struct pair pair_write_power_of_ten(int exponent)
{
    char text[8];
    struct pair power = {1, 0};
    int length = snprintf(text, sizeof text, "1e%d", exponent);
    pair_read(text, text + length, NUMBER_UNSCALED, &power);
    return power;
}

/* The first 32 digits; the last one is wrong by a few units. */
static struct pair_write_decimal pair_write_decimal_of(struct pair value, struct number_scale unit)
{
    struct pair_write_decimal decimal = {.negative = value.hi < 0, .count = MOST_DIGITS};
    struct pair x = decimal.negative ? pair_negate(value) : value;
    x = pair_divide(x, pair_of((double)unit.multiplier));
    decimal.point = (int)floor(log10(x.hi)) + 1;
    /* in two steps where one power would overflow, or lose its low part */
    const int exponent = 1 - decimal.point;
    const int first = abs(exponent) > 150 ? exponent / 2 : exponent;
    x = pair_multiply(x, pair_write_power_of_ten(first));
    x = first != exponent ? pair_multiply(x, pair_write_power_of_ten(exponent - first)) : x;
    decimal.point -= unit.power;
    if (x.hi < 1 || (x.hi == 1 && x.lo < 0)) { /* the logarithm was rounded up */
        x = pair_multiply(x, pair_of(10));
        decimal.point--;
    } else if (x.hi > 10 || (x.hi == 10 && x.lo >= 0)) {
        x = pair_divide(x, pair_of(10));
        decimal.point++;
    }
    for (int i = 0; i < MOST_DIGITS; i++) {
        double digit = floor(x.hi);
        digit -= digit == x.hi && x.lo < 0;
        digit = fmin(fmax(digit, 0), 9);
        decimal.digits[i] = (char)('0' + (int)digit);
        x = pair_multiply(pair_subtract(x, pair_of(digit)), pair_of(10));
    }
    return decimal;
}

/* Rounded to so many digits. */
static struct pair_write_decimal pair_write_rounded(const struct pair_write_decimal *all, int count)
{
    struct pair_write_decimal decimal = *all;
    decimal.count = count;
    bool up = all->digits[count] >= '5';
    for (int i = count - 1; i >= 0 && up; i--) {
        up = decimal.digits[i] == '9';
        decimal.digits[i] = (char)(up ? '0' : decimal.digits[i] + 1);
    }
    if (up) {
        memmove(decimal.digits + 1, decimal.digits, (size_t)count - 1);
        decimal.digits[0] = '1';
        decimal.point++;
    }
    return decimal;
}

static char *put_digits(char *to, const struct pair_write_decimal *decimal, int first, int end)
{
    for (int i = first; i < end; i++) {
        *to++ = (char)(i < decimal->count && i >= 0 ? decimal->digits[i] : '0');
    }
    return to;
}

static char *put_decimal(char *to, const struct pair_write_decimal *decimal)
{
    int point = decimal->point, count = decimal->count;
    if (decimal->negative) {
        *to++ = '-';
    }
    if (point < -3 || point > 17) {
        to = put_digits(to, decimal, 0, 1);
        if (count > 1) {
            *to++ = '.';
        }
        to = put_digits(to, decimal, 1, count);
        return to + snprintf(to, 6, "e%+03d", point - 1);
    }
    if (point <= 0) {
        *to++ = '0';
    } else {
        to = put_digits(to, decimal, 0, point);
    }
    if (count > point) {
        *to++ = '.';
        to = put_digits(to, decimal, point, count);
    }
    return to;
}

static char *put_zero(char *to)
{
    *to++ = '0';
    return to;
}

char *pair_write_digits(char *to, struct pair value, struct number_scale unit, int digits)
{
    if (!(fabs(value.hi) > 0 && fabs(value.hi) < INFINITY)) {
        return value.hi == 0 ? put_zero(to) : number_write_shortest(to, value.hi);
    }
    struct pair_write_decimal all = pair_write_decimal_of(value, unit),
                              decimal = pair_write_rounded(&all, digits);
    return put_decimal(to, &decimal);
}

char *pair_write_shortest(char *to, struct pair value, struct number_scale unit)
{
    const double tolerance = 1e-30; /* half a unit of the 31st digit, and the rounding of pairs */
    if (!(fabs(value.hi) > 0 && fabs(value.hi) < INFINITY)) {
        return value.hi == 0 ? put_zero(to) : number_write_shortest(to, value.hi);
    }
    struct pair_write_decimal all = pair_write_decimal_of(value, unit);
    for (int digits = 1; digits < MOST_DIGITS; digits++) {
        struct pair_write_decimal decimal = pair_write_rounded(&all, digits);
        struct pair again;
        char *end = put_decimal(to, &decimal);
        if (digits + 1 == MOST_DIGITS || pair_read(to, end, unit, &again) == NULL) {
            return end;
        }
        struct pair rest = pair_subtract(again, value);
        if (again.hi == value.hi && fabs(rest.hi) <= tolerance * fabs(value.hi)) {
            return end;
        }
    }
    return to;
}
