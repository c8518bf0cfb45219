/* base/dual.h - numbers that carry their derivative with them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_DUAL_H
#define LENSCALC_BASE_DUAL_H

#include <math.h>

/*
 * A value, and its derivative along one change of what it is computed from: formulas written in
 * these have exact derivatives, to rounding.
 */
struct dual {
    double value, slope;
};

/* What does not change. */
static inline struct dual dual_of(double value)
{
    return (struct dual){value, 0};
}

static inline struct dual dual_add(struct dual a, struct dual b)
{
    return (struct dual){a.value + b.value, a.slope + b.slope};
}

static inline struct dual dual_subtract(struct dual a, struct dual b)
{
    return (struct dual){a.value - b.value, a.slope - b.slope};
}

static inline struct dual dual_multiply(struct dual a, struct dual b)
{
    return (struct dual){a.value * b.value, a.slope * b.value + a.value * b.slope};
}

static inline struct dual dual_scale(struct dual a, double factor)
{
    return (struct dual){a.value * factor, a.slope * factor};
}

static inline struct dual dual_divide(struct dual a, struct dual b)
{
    const double quotient = a.value / b.value;
    return (struct dual){quotient, (a.slope - quotient * b.slope) / b.value};
}

static inline struct dual dual_root(struct dual a)
{
    const double root = sqrt(a.value);
    return (struct dual){root, a.slope / (2 * root)};
}

static inline struct dual dual_arc_tangent(struct dual a)
{
    return (struct dual){atan(a.value), a.slope / (1 + a.value * a.value)};
}

/* |a|; at 0 the slope is that of a. */
static inline struct dual dual_absolute(struct dual a)
{
    return a.value < 0 ? dual_scale(a, -1) : a;
}

/* |a| with the sign of b. */
static inline struct dual dual_with_sign(struct dual a, struct dual b)
{
    const struct dual size = dual_absolute(a);
    return signbit(b.value) ? dual_scale(size, -1) : size;
}

#endif
