/* analysis/model/ray_polynomial.h - sparse polynomials that map rays, fitted to exact ones. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_MODEL_RAY_POLYNOMIAL_H
#define LENSCALC_ANALYSIS_MODEL_RAY_POLYNOMIAL_H

#include "base/arena.h"
#include "base/error.h"
#include "trace/kernel/rays.h"

#include <stddef.h>

enum {
    RAY_POLYNOMIAL_DEGREE = 15,                       /* at most, of place and direction together */
    RAY_POLYNOMIAL_POWER = RAY_POLYNOMIAL_DEGREE / 2, /* of an invariant */
    RAY_POLYNOMIAL_TERMS = 240                        /* of that degree */
};

/* coefficient (w.w)^i (w.h)^j (h.h)^k times w, or times h. */
struct ray_term {
    double coefficient;
    unsigned char power[3]; /* i, j, k */
    unsigned char of_h;     /* 0: times w; 1: times h */
};

/* Two numbers behind the lens, as a vector that turns with the ray about the axis. */
struct ray_series {
    struct ray_term *terms;
    size_t count;
};

struct ray_polynomial {
    int degree;
    double pupil, length; /* the plane of w from the first vertex, and what w is divided by, mm */
    double index, index_last; /* before and behind the lens */
    struct ray_series place, direction;
    double rms; /* over the rays that were fitted, mm */
};

/* Rays to fit: where they start and where they meet the plane that is wanted, one lane each. */
struct ray_polynomial_task {
    const struct rays *before, *after; /* lost ones are left out */
    int degree;                        /* 1, 3 .. RAY_POLYNOMIAL_DEGREE */
    size_t terms;                      /* at most */
    double pupil; /* from the first vertex, mm: where rays are close together */
    double index, index_last;
};

/*
 * Polynomials for a lens that is round about its axis.
 *
 * Formula   h = (L, M)/(1 + N) of the direction, the tangent of half its angle, so that rays at 90
 *           degrees and beyond are like others; w = (x N - z L, y N - z M) about the axis in the
 *           plane of `pupil`. Place and direction cosines behind the lens turn with them: each is
 *           w A + h B, where A and B are polynomials of w.w, w.h and h.h. Terms of the place by
 *           orthogonal matching pursuit: each time that which leaves least, all chosen ones by
 *           least squares; the direction has the same terms
 * Source    [Schrade16]; the invariants, [Hullin12] has all four variables
 * Errors    ERROR_DOMAIN: a degree that there is not, no rays
 */
bool ray_polynomial_fit(const struct ray_polynomial_task *task, struct arena *arena,
                        struct ray_polynomial *polynomial, struct error *error);

/* Rays where they start become rays in the plane, in place; lost ones too. */
void ray_polynomial_trace(const struct ray_polynomial *polynomial, const struct rays *rays);

#endif
