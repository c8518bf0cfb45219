/* base/roots.h - root of a function of one variable between two points of opposite sign. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_ROOTS_H
#define LENSCALC_BASE_ROOTS_H

#include <stdbool.h>

#include "base/error.h"

/* The function; `context` is what was given to root_find. It may return +-inf, never NaN. */
typedef double root_function(double x, const void *context);

/*
 * Root of a continuous function in a bracket.
 *
 * Given     function, context  the function and what it needs besides x
 *           low, high          finite; the function has opposite signs there, or is 0
 *           root               receives the answer
 * Result    x with the bracket around it no wider than 4 eps |x|, or where the function is 0
 * Formula   inverse quadratic interpolation while it is safe, else bisection
 * Source    Chandrupatla, Adv. Eng. Software 28 (1997) 145-149
 * Errors    no change of sign; more than 200 steps; a value that is not a number
 * Limits    one root; of several in the bracket any one
 */
bool root_find(root_function *function, const void *context, double low, double high, double *root,
               struct error *error);

#endif
