/* base/roots.c - root of a function of one variable between two points of opposite sign. */
/* SPDX-License-Identifier: MIT */
#include "base/roots.h"

#include <float.h>
#include <math.h>

enum { STEP_LIMIT = 200 };

/* The newest point a, the opposite end b of the bracket, the point c before a. */
struct roots_bracket {
    double a, b, c;
    double fa, fb, fc;
};

static bool roots_opposite(double x, double y)
{
    return (x < 0 && y > 0) || (x > 0 && y < 0);
}

/* Where to look next, as a fraction of the way from a to b. */
static double next_fraction(const struct roots_bracket *k)
{
    double xi = (k->a - k->b) / (k->c - k->b);
    double phi = (k->fa - k->fb) / (k->fc - k->fb);
    if (!(phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)) {
        return 0.5;
    }
    double t = k->fa / (k->fb - k->fa) * (k->fc / (k->fb - k->fc)) + (k->c - k->a) / (k->b - k->a) *
                                                                         (k->fa / (k->fc - k->fa)) *
                                                                         (k->fb / (k->fc - k->fb));
    return t > 0 && t < 1 ? t : 0.5;
}

bool root_find(root_function *function, const void *context, double low, double high, double *root,
               struct error *error)
{
    struct roots_bracket k = {.a = high, .b = low, .c = low};
    k.fa = function(high, context);
    k.fb = k.fc = function(low, context);
    *root = fabs(k.fa) <= fabs(k.fb) ? high : low;
    if (k.fa == 0 || k.fb == 0) {
        return true;
    }
    if (!roots_opposite(k.fa, k.fb)) {
        return fail(error, ERROR_DOMAIN, "no root between %.15g and %.15g: no change of sign", low,
                    high);
    }
    double fraction = 0.5;
    for (int step = 0; step < STEP_LIMIT; step++) {
        double x = k.a + fraction * (k.b - k.a), f = function(x, context);
        if (isnan(f)) {
            return fail(error, ERROR_DOMAIN, "root search met no number at %.15g", x);
        }
        /* take the value f at x into the bracket */
        if (roots_opposite(f, k.fa)) {
            k.c = k.b;
            k.fc = k.fb;
            k.b = k.a;
            k.fb = k.fa;
        } else {
            k.c = k.a;
            k.fc = k.fa;
        }
        k.a = x;
        k.fa = f;
        *root = fabs(k.fa) <= fabs(k.fb) ? k.a : k.b;
        double width = fabs(k.b - k.a), least = 2 * DBL_EPSILON * fabs(*root) + DBL_MIN;
        if (f == 0 || width <= 2 * least) {
            return true;
        }
        double margin = least / width; /* never land on an end of the bracket */
        fraction = fmin(1 - margin, fmax(margin, next_fraction(&k)));
    }
    return fail(error, ERROR_DOMAIN, "no root found between %.15g and %.15g in %d steps", low, high,
                STEP_LIMIT);
}
