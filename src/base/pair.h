/* base/pair.h - numbers as the sum of two doubles: about 32 digits. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_PAIR_H
#define LENSCALC_BASE_PAIR_H

#include "base/number.h"

#include <math.h>

/* hi + lo, with hi the nearest double to the sum. */
struct pair {
    double hi, lo;
};

/* a + b exactly. [Knuth97] 4.2.2, theorem B */
static inline struct pair pair_sum(double a, double b)
{
    double s = a + b, b_part = s - a;
    return (struct pair){s, (a - (s - b_part)) + (b - b_part)};
}

/* The same where |a| >= |b| or a = 0. */
static inline struct pair pair_fast_sum(double a, double b)
{
    double s = a + b;
    return (struct pair){s, b - (s - a)};
}

/*
 * a b exactly, for |a|, |b| below 1e150 and products above 1e-290. By Dekker's split: fma() is a
 * slow library call where the machine may lack the instruction. [Dekker71]
 */
static inline struct pair pair_product(double a, double b)
{
    const double half = 134217729; /* 2^27 + 1: splits 53 bits in two halves */
    double p = a * b, a_big = half * a, b_big = half * b;
    double a_high = a_big - (a_big - a), b_high = b_big - (b_big - b);
    double a_low = a - a_high, b_low = b - b_high;
    double rest = ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low;
    return (struct pair){p, rest};
}

static inline struct pair pair_of(double value)
{
    return (struct pair){value, 0};
}

static inline double pair_double(struct pair a)
{
    return a.hi + a.lo;
}

static inline struct pair pair_negate(struct pair a)
{
    return (struct pair){-a.hi, -a.lo};
}

/* The four operations and the root: relative error below 2^-102, of sums also where the terms
 * cancel. Source: Joldes, Muller, Popescu, ACM Trans. Math. Softw. 44 (2017) 15. */
static inline struct pair pair_add(struct pair a, struct pair b)
{
    struct pair high = pair_sum(a.hi, b.hi), low = pair_sum(a.lo, b.lo);
    high = pair_fast_sum(high.hi, high.lo + low.hi);
    return pair_fast_sum(high.hi, high.lo + low.lo);
}

static inline struct pair pair_subtract(struct pair a, struct pair b)
{
    return pair_add(a, pair_negate(b));
}

static inline struct pair pair_multiply(struct pair a, struct pair b)
{
    struct pair p = pair_product(a.hi, b.hi);
    return pair_fast_sum(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* a / b; infinite or NaN as the doubles would be for b = 0. */
static inline struct pair pair_divide(struct pair a, struct pair b)
{
    double q = a.hi / b.hi;
    if (!(q - q == 0)) {
        return pair_of(q);
    }
    struct pair rest = pair_subtract(a, pair_multiply(b, pair_of(q)));
    return pair_fast_sum(q, rest.hi / b.hi);
}

/* Square root; NaN for what is negative. */
static inline struct pair pair_root(struct pair a)
{
    double root = sqrt(a.hi);
    if (!(root > 0)) {
        return pair_of(root);
    }
    struct pair rest = pair_subtract(a, pair_product(root, root));
    return pair_fast_sum(root, rest.hi / (2 * root));
}

/*
 * Read a decimal number as number_read does, with what the decimal has beyond its double.
 *
 * Given     as number_read
 * Result    hi is what number_read gives; lo the rest, to about 1e-32 of the value, 0 where the
 *           value is 0 or infinite or its exponent is beyond 1e+-250
 */
const char *pair_read(const char *at, const char *end, struct number_scale scale,
                      struct pair *value);

/* The same of a whole text. Result: false where it is none, or more than a number. */
bool text_pair(struct text text, struct number_scale scale, struct pair *value);

/* The longest text that pair_write writes (no NUL is written). */
#define PAIR_LENGTH 48

/*
 * Write a pair with the fewest digits, at most 31, that pair_read gives the same pair for.
 *
 * Given     to      room for PAIR_LENGTH characters
 *           unit    the number is divided by it: the text is in the file's unit
 * Result    the end of what was written, laid out as number_write_shortest does; "0" for 0
 * Limits    the text reads back to within 1e-30 of the value, and to the same hi unless hi + lo
 *           lies that near to the middle between two doubles; |value| below 1e290
 */
char *pair_write_shortest(char *to, struct pair value, struct number_scale unit);

/* The same rounded to `digits` significant digits, 1 .. 31; zeros at the end are kept. */
char *pair_write_digits(char *to, struct pair value, struct number_scale unit, int digits);

#endif
