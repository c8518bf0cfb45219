/* base/polynomial.c - real polynomials of low degree, and all their roots in an interval. */
/* SPDX-License-Identifier: MIT */
#include "base/polynomial.h"

#include "base/roots.h"

#include <assert.h>
#include <math.h>

static const double NEGLIGIBLE = 1e-26;               /* of the largest term: rounding of pairs */
static const double TOUCHING = 8.271806125530277e-25; /* 2^-80: an extremum that is a root */

struct polynomial polynomial_linear(struct pair constant, struct pair slope)
{
    return (struct polynomial){1, {constant, slope}};
}

struct polynomial polynomial_add(const struct polynomial *a, const struct polynomial *b)
{
    const struct polynomial *longer = a->degree >= b->degree ? a : b;
    const struct polynomial *shorter = longer == a ? b : a;
    struct polynomial sum = *longer;
    for (size_t i = 0; i <= shorter->degree; i++) {
        sum.c[i] = pair_add(sum.c[i], shorter->c[i]);
    }
    return sum;
}

struct polynomial polynomial_multiply(const struct polynomial *a, const struct polynomial *b)
{
    struct polynomial product = {.degree = a->degree + b->degree};
    assert(product.degree <= POLYNOMIAL_DEGREE);
    for (size_t i = 0; i <= a->degree; i++) {
        for (size_t k = 0; k <= b->degree; k++) {
            product.c[i + k] = pair_add(product.c[i + k], pair_multiply(a->c[i], b->c[k]));
        }
    }
    return product;
}

struct polynomial polynomial_scale(const struct polynomial *a, struct pair factor)
{
    struct polynomial scaled = *a;
    for (size_t i = 0; i <= a->degree; i++) {
        scaled.c[i] = pair_multiply(a->c[i], factor);
    }
    return scaled;
}

static struct pair polynomial_at(const struct polynomial *a, struct pair x)
{
    struct pair sum = a->c[a->degree];
    for (size_t i = a->degree; i-- > 0;) {
        sum = pair_add(pair_multiply(sum, x), a->c[i]);
    }
    return sum;
}

static struct polynomial derivative_of(const struct polynomial *a)
{
    struct polynomial slope = {.degree = a->degree > 0 ? a->degree - 1 : 0};
    for (size_t i = 1; i <= a->degree; i++) {
        slope.c[i - 1] = pair_multiply(a->c[i], pair_of((double)i));
    }
    return slope;
}

/* Sum of the terms' sizes at x. */
static double size_at(const struct polynomial *a, double x)
{
    double sum = 0;
    for (size_t i = a->degree + 1; i-- > 0;) {
        sum = sum * fabs(x) + fabs(a->c[i].hi);
    }
    return sum;
}

static double value_at(double x, const void *context)
{
    return polynomial_at(context, pair_of(x)).hi;
}

/* Without the highest terms that are rounding. */
static struct polynomial without_rounding(const struct polynomial *a, double scale)
{
    struct polynomial clean = *a;
    double least = NEGLIGIBLE * size_at(a, scale);
    while (clean.degree > 0 &&
           !(fabs(clean.c[clean.degree].hi) * pow(scale, (double)clean.degree) > least)) {
        clean.degree--;
    }
    return clean;
}

/* Roots of `a` between the points, at which its slope is 0 or the interval ends. */
static size_t roots_between(const struct polynomial *a, const struct pair *points, size_t count,
                            struct pair *roots)
{
    const struct polynomial slope = derivative_of(a);
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        double x = points[i].hi, y = polynomial_at(a, points[i]).hi;
        if (fabs(y) <= TOUCHING * size_at(a, x)) {
            if (found == 0 || roots[found - 1].hi != x) {
                roots[found++] = points[i];
            }
            continue;
        }
        if (i + 1 == count) {
            break;
        }
        double next_x = points[i + 1].hi, next_y = polynomial_at(a, points[i + 1]).hi;
        bool crosses = (y < 0) != (next_y < 0);
        double root;
        struct error ignored;
        if (crosses && fabs(next_y) > TOUCHING * size_at(a, next_x) &&
            root_find(value_at, a, x, next_x, &root, &ignored)) {
            /* one Newton step in pairs from the double that is nearest */
            struct pair step =
                pair_divide(polynomial_at(a, pair_of(root)), polynomial_at(&slope, pair_of(root)));
            bool sound = fabs(step.hi) <= 1e-9 * (fabs(root) + 1e-300);
            roots[found++] = sound ? pair_subtract(pair_of(root), step) : pair_of(root);
        }
    }
    return found;
}

bool polynomial_is_constant(const struct polynomial *a, double scale)
{
    return without_rounding(a, scale).degree == 0;
}

size_t polynomial_roots(const struct polynomial *a, double low, double high, double scale,
                        struct pair *roots)
{
    struct polynomial all[POLYNOMIAL_DEGREE + 1];
    struct pair points[POLYNOMIAL_DEGREE + 2];
    size_t count = 0;
    all[0] = without_rounding(a, scale);
    if (all[0].degree == 0) {
        return 0;
    }
    /* no root lies farther out than Cauchy's bound */
    double most = 0;
    for (size_t i = 0; i < all[0].degree; i++) {
        double ratio = all[0].c[i].hi / all[0].c[all[0].degree].hi;
        most = fmax(most, fabs(ratio) / pow(scale, (double)(all[0].degree - i)));
    }
    double bound = scale * (1 + most);
    low = fmax(low, -bound);
    high = fmin(high, bound);
    if (!(low <= high)) {
        return 0;
    }
    for (size_t i = 1; i <= all[0].degree; i++) {
        all[i] = derivative_of(&all[i - 1]);
    }
    for (size_t i = all[0].degree; i-- > 0;) {
        points[0] = pair_of(low);
        for (size_t k = 0; k < count; k++) {
            points[k + 1] = roots[k];
        }
        points[count + 1] = pair_of(high);
        count = roots_between(&all[i], points, count + 2, roots);
    }
    return count;
}
