/* tests/stress/quad.h - numbers of 113 bits: read, written, roots and angles. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_STRESS_QUAD_H
#define LENSCALC_TESTS_STRESS_QUAD_H

#include <stdbool.h>
#include <stddef.h>

/* Nothing of this is the program's own; where the compiler has no such type 64 bits must do. */
#if defined(__SIZEOF_FLOAT128__) || defined(__FLOAT128__)
__extension__ typedef __float128 quad;
#else
typedef long double quad;
#endif

static inline quad quad_size(quad x)
{
    return x < 0 ? -x : x;
}

static inline bool quad_is_finite(quad x)
{
    return x - x == 0;
}

/* NaN of what is negative. */
quad quad_root(quad x);
/* Of angles within some turns. */
quad quad_sine(quad x), quad_cosine(quad x);
quad quad_pi(void);

/* Decimals as they are typed, and back with so many digits. */
quad quad_read(const char *text);
void quad_write(char *text, size_t room, quad x, int digits);

#endif
