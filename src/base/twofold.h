/* base/twofold.h - numbers of twice the precision: a double and what it left over. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_TWOFOLD_H
#define LENSCALC_BASE_TWOFOLD_H

#include <math.h>
#include <stdbool.h>

/* The unevaluated sum high + low, |low| at most half an ulp of high. */
struct twofold {
    double high, low;
};

/*
 * Read the decimal number at `at` as number_read does, with what a double cannot hold of it.
 *
 * Result    the first character behind; null if there is no number. `high` is the correctly
 *           rounded double, `low` the rest, to 1e-16 of itself for up to 18 digits and exponents
 *           down to 10^-40; 0 for what is longer, larger or smaller
 */
const char *twofold_read(const char *at, const char *end, struct twofold *value);

static inline struct twofold twofold_of(double value)
{
    return (struct twofold){value, 0};
}

static inline double twofold_double(struct twofold a)
{
    return a.high + a.low;
}

/* Sum of two doubles, exact. Source: Knuth, The Art of Computer Programming 2, 4.2.2. */
static inline struct twofold twofold_exact_sum(double a, double b)
{
    double sum = a + b, part = sum - a;
    return (struct twofold){sum, (a - (sum - part)) + (b - part)};
}

/* The same for |a| >= |b|. Source: Dekker, Numer. Math. 18 (1971) 224-242. */
static inline struct twofold twofold_quick_sum(double a, double b)
{
    double sum = a + b;
    return (struct twofold){sum, b - (sum - a)};
}

/*
 * Product of two doubles, exact while nothing is below 1e-290 or above 1e290. By Dekker's split:
 * fma() is a slow library call where the machine may lack the instruction. Source: as above.
 */
static inline struct twofold twofold_exact_product(double a, double b)
{
    const double splitter = 134217729; /* 2^27 + 1 */
    double p = a * b, c = splitter * a, d = splitter * b;
    double a1 = c - (c - a), b1 = d - (d - b), a2 = a - a1, b2 = b - b1;
    return (struct twofold){p, ((a1 * b1 - p) + a1 * b2 + a2 * b1) + a2 * b2};
}

/* The four operations and the root, relative error below 2^-98; sums also where the terms
 * cancel. Source: Joldes, Muller, Popescu, ACM Trans. Math. Softw. 44 (2017) 15. */
static inline struct twofold twofold_add(struct twofold a, struct twofold b)
{
    struct twofold s = twofold_exact_sum(a.high, b.high), t = twofold_exact_sum(a.low, b.low);
    s = twofold_quick_sum(s.high, s.low + t.high);
    return twofold_quick_sum(s.high, s.low + t.low);
}

static inline struct twofold twofold_negative(struct twofold a)
{
    return (struct twofold){-a.high, -a.low};
}

static inline struct twofold twofold_subtract(struct twofold a, struct twofold b)
{
    return twofold_add(a, twofold_negative(b));
}

static inline struct twofold twofold_multiply(struct twofold a, struct twofold b)
{
    struct twofold p = twofold_exact_product(a.high, b.high);
    return twofold_quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

static inline struct twofold twofold_divide(struct twofold a, struct twofold b)
{
    double first = a.high / b.high;
    struct twofold rest = twofold_subtract(a, twofold_multiply(b, twofold_of(first)));
    return twofold_quick_sum(first, rest.high / b.high);
}

/* Square root; NaN for what is negative. */
static inline struct twofold twofold_root(struct twofold a)
{
    double root = sqrt(a.high);
    if (!(root > 0)) {
        return twofold_of(root);
    }
    struct twofold rest = twofold_subtract(a, twofold_exact_product(root, root));
    return twofold_quick_sum(root, rest.high / (2 * root));
}

#endif
