/* optics/lensmaker.h - one lens: the lens-maker's formula, thin or thick, in any media. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_LENSMAKER_H
#define LENSCALC_OPTICS_LENSMAKER_H

#include <stdbool.h>

#include "base/error.h"

/* A lens of two spherical surfaces. NaN = to be found. */
struct lensmaker {
    double n0, n, n1; /* indices before, of the lens, after; > 0 */
    double R1, R2;    /* radii, mm, not 0; + with the centre to the right; inf = plane */
    double d;         /* thickness, mm, >= 0 */
    double f;         /* 1/power, mm, not 0; inf = afocal */
    double q;         /* shape factor (R2 + R1)/(R2 - R1); inf where R1 = R2 */
};

/* Where two lenses answer the question: how many, and which was taken. */
struct lensmaker_choice {
    bool second; /* asked for; else that which the thin lens has too */
    int count;   /* 1 or 2 */
};

/*
 * Complete a lens.
 *
 * Given     lens    n0, n1 and as many of the others as make it one lens:
 *                     R1, R2, n                       -> f
 *                     f, n and one radius             -> the other radius
 *                     f, n and q                      -> both radii (quadratic)
 *                     f, R1, R2                       -> n (quadratic), if d is given or thin
 *                     f, R1, R2, n                    -> d
 *                     q and one radius                -> the other radius, then as above
 *                   d is 0 where it is NaN and not what is asked for
 *           choice  second; receives count
 * Formula   with P1 = (n - n0)/R1, P2 = (n1 - n)/R2: P = P1 + P2 - (d/n) P1 P2, f = 1/P.
 *           R2 = (n1 - n)(n R1 - d(n - n0))/(n (P R1 - (n - n0))); R1 from the reversed lens.
 *           d = n (P1 + P2 - P)/(P1 P2).
 *           n: a n^2 + b n + e = 0, a = 1/R1 - 1/R2 + d/(R1 R2), e = d n0 n1/(R1 R2),
 *           b = n1/R2 - n0/R1 - P - d (n0 + n1)/(R1 R2).
 *           q: 1/R1 = (q + 1) x, 1/R2 = (q - 1) x; -(d/n)(n - n0)(n1 - n)(q^2 - 1) x^2
 *           + ((n - n0)(q + 1) + (n1 - n)(q - 1)) x = P; for |q| > 1 in x q and 1/q.
 *           First solution: the one that stays finite, and does not vanish, as d goes to 0.
 *           Quadratics by the larger root and Vieta's product.
 * Source    [Welford86] ch. 3; [Jenkins76] for the shape factor
 * Errors    ERROR_USAGE: too little or too much is given; ERROR_DOMAIN: values out of range, no
 *           such lens (with the range of powers where there is one), a solved index below 1, a
 *           solved thickness below 0, a second solution where there is one
 */
bool lensmaker_solve(struct lensmaker *lens, struct lensmaker_choice *choice, struct error *error);

/*
 * The same for a ball: R1 = d/2, R2 = -d/2.
 *
 * Given     lens  n0, n1; two of d, n and f; R1, R2, q NaN
 * Formula   as above; d = 2 f (2n - n0 - n1 - 2 (n - n0)(n - n1)/n), in air f = n d/(4 (n - 1))
 */
bool lensmaker_solve_ball(struct lensmaker *lens, struct lensmaker_choice *choice,
                          struct error *error);

/* First-order data. Places mm, + to the right; `front_` ones from the first vertex. */
struct lensmaker_facts {
    double P1, P2;      /* power of the surfaces, 1/mm */
    double power, efl;  /* P, 1/P */
    double front_focal; /* from H to F, -n0/P */
    double rear_focal;  /* from H' to F', n1/P */
    double ffl, bfl;    /* F from the first, F' from the last vertex */
    double H, H_rear;   /* principal planes, from the first and the last vertex */
    double N, N_rear;   /* nodal points, likewise */
    double condition;   /* of P: sum of its terms' sizes over its size; >= 1 */
};

/*
 * Cardinal points of a complete lens.
 *
 * Result    facts; infinite for an afocal lens, NaN where a plate or a thin afocal lens has none
 * Formula   with M = n R1 R2 P = n (n - n0) R2 + n (n1 - n) R1 - d (n - n0)(n1 - n), in twice the
 *           digits of a double:
 *           bfl = n1 R2 (n R1 - d (n - n0))/M      H' = -n1 d (n - n0) R2/M
 *           ffl = -n0 R1 (n R2 - d (n1 - n))/M     H  =  n0 d (n1 - n) R1/M
 *           N = H + (n1 - n0)/P, N' = H' + (n1 - n0)/P; a plane takes the place of R by a limit
 * Source    [Welford86] ch. 3 for P, H, H'; the products by R1 R2 derived here, pinned by
 *           tests/truth/thick_lens.tsv
 * Limits    Paraxial. P is right to its last bits for the radii, indices and thickness as doubles;
 *           what their rounding does to it is `condition` times larger
 */
void lensmaker_facts(const struct lensmaker *lens, struct lensmaker_facts *facts);

#endif
