/* base/polynomial.h - real polynomials of low degree, and all their roots in an interval. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_POLYNOMIAL_H
#define LENSCALC_BASE_POLYNOMIAL_H

#include "base/pair.h"

#include <stdbool.h>
#include <stddef.h>

enum { POLYNOMIAL_DEGREE = 24 };

/* c[0] + c[1] x + ... + c[degree] x^degree */
struct polynomial {
    size_t degree;
    struct pair c[POLYNOMIAL_DEGREE + 1];
};

struct polynomial polynomial_linear(struct pair constant, struct pair slope);

struct polynomial polynomial_add(const struct polynomial *a, const struct polynomial *b);

/* The degrees together at most POLYNOMIAL_DEGREE. */
struct polynomial polynomial_multiply(const struct polynomial *a, const struct polynomial *b);

struct polynomial polynomial_scale(const struct polynomial *a, struct pair factor);

/* Does it not depend on x: all terms but the first are rounding, as below? */
bool polynomial_is_constant(const struct polynomial *a, double scale);

/*
 * All real roots in an interval, a multiple one once.
 *
 * Given     low, high  low <= high; either may be infinite
 *           scale      a length of the problem: terms that are below 1e-26 of the largest one at
 *                      x = scale are rounding and count as 0; above 0
 *           roots      receives them by rising value, room for POLYNOMIAL_DEGREE
 * Result    how many; 0 for a polynomial that is 0 everywhere
 * Formula   between neighbouring roots of its derivative a polynomial is monotone, so that a change
 *           of sign brackets its only root there: from the highest derivative down, each root by
 *           root_find and a Newton step in pairs. Without an end: Cauchy's bound
 *           1 + max |c_i/c_n|
 * Source    Derived here from Rolle's theorem; Cauchy, Exercices de mathematiques 4 (1829) 65
 * Limits    a double root counts where the extremum is below 2^-80 of the terms' sum
 */
size_t polynomial_roots(const struct polynomial *a, double low, double high, double scale,
                        struct pair *roots);

#endif
