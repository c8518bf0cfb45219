/* base/exact_accumulator.h - sums without rounding: the same in whatever order they are made. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_EXACT_ACCUMULATOR_H
#define LENSCALC_BASE_EXACT_ACCUMULATOR_H

#include <stdint.h>

/* Digits of 32 bits from 2^-1074 on: all doubles, 2^30 of them, and a sign. */
enum { EXACT_ACCUMULATOR_DIGITS = 68 };

/*
 * A sum of doubles as a long fixed-point number. Start with all zero; two of them are added digit
 * by digit.
 *
 * Formula   a double is m 2^(e - 1074) with a whole m below 2^53: three digits at most. Digits may
 *           be of either sign and as long as 62 bits, which 2^30 summands do not exceed
 * Source    [Kulisch86], the long accumulator
 */
struct exact_accumulator {
    int64_t digits[EXACT_ACCUMULATOR_DIGITS];
};

/* Given     x  finite */
void exact_accumulator_add(struct exact_accumulator *sum, double x);

void exact_accumulator_join(struct exact_accumulator *sum, const struct exact_accumulator *more);

/* Result    the sum, within 2 ulp, the same for the same summands in any order */
double exact_accumulator_value(const struct exact_accumulator *sum);

#endif
