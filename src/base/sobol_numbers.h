/* base/sobol_numbers.h - primitive polynomials and initial numbers of Sobol' sequences. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_SOBOL_NUMBERS_H
#define LENSCALC_BASE_SOBOL_NUMBERS_H

#include <stdint.h>

enum { SOBOL_DIMENSIONS = 256, SOBOL_DEGREE = 11 };

/*
 * What generates one dimension.
 *
 * Formula   v_k = m_k 2^(32 - k); for k > s, with the polynomial x^s + a_1 x^(s-1) + ... + 1,
 *           v_k = a_1 v_(k-1) xor ... xor a_(s-1) v_(k-s+1) xor v_(k-s) xor v_(k-s) / 2^s
 * Source    [JoeKuo08] the first of their "new-joe-kuo-6.21201"
 */
struct sobol_numbers {
    uint16_t polynomial;      /* its bits, the highest that of x^s */
    uint16_t m[SOBOL_DEGREE]; /* m_1 .. m_s */
};

/* Of the second dimension and those behind it; the first needs none. */
extern const struct sobol_numbers sobol_numbers[SOBOL_DIMENSIONS - 1];

#endif
