/* optics/fifth_order.h - fifth-order aberrations (Buchdahl), surface by surface. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_FIFTH_ORDER_H
#define LENSCALC_OPTICS_FIFTH_ORDER_H

#include "base/arena.h"
#include "base/error.h"
#include "optics/seidel.h"

#include <stdbool.h>

/* The twelve coefficients in Cruickshank and Hills's names; Buchdahl's mu1 .. mu12 beside them. */
enum fifth_order_term {
    FIFTH_B5,  /* mu1: spherical */
    FIFTH_F1,  /* mu2: linear coma, of the meridional section */
    FIFTH_F2,  /* mu3: linear coma */
    FIFTH_M1,  /* mu4: oblique spherical, of the meridional section */
    FIFTH_M2,  /* mu5: oblique spherical, of the sagittal section */
    FIFTH_M3,  /* mu6: oblique spherical, with cos^2 */
    FIFTH_N1,  /* mu7: elliptical coma, of the meridional section */
    FIFTH_N2,  /* mu8: elliptical coma, of the meridional section, with cos 2 theta */
    FIFTH_N3,  /* mu9: elliptical coma, of the sagittal section */
    FIFTH_C5,  /* (mu10 - mu11)/4: astigmatism */
    FIFTH_PI5, /* (5 mu11 - mu10)/4: Petzval curvature */
    FIFTH_E5,  /* mu12: distortion */
    FIFTH_TERMS
};

/* What one surface adds, or the sums, mm; over slope of struct seidel a transverse aberration. */
struct fifth_order_part {
    double sum[FIFTH_TERMS];
    double intrinsic[FIFTH_TERMS]; /* of it, for light that no surface before has aberrated */
};

struct fifth_order {
    struct fifth_order_part *parts; /* one a surface of the system */
    struct fifth_order_part total;
};

/*
 * The fifth-order aberrations of rays in the paraxial image plane.
 *
 * Given     question  as seidel_compute has it
 * Result    parts and their sum, mm; of no field all but B5 are NaN. The rest of a sum, less its
 *           intrinsic part, is induced by the third-order aberrations of the surfaces before
 * Formula   the ray through relative pupil coordinates rho (sin theta, cos theta) in the paraxial
 *           entrance pupil, and the relative field h = 1, errs in the paraxial image by
 *           x = B5 rho^5 sin + F2 rho^4 h sin 2 + (M2 + M3 cos^2) rho^3 h^2 sin
 *             + N3 rho^2 h^3 sin 2 + (C5 + PI5) rho h^4 sin,
 *           y = B5 rho^5 cos + (F1 + F2 cos 2) rho^4 h + (M1 + M3 cos^2) rho^3 h^2 cos
 *             + (N1 + N2 cos 2) rho^2 h^3 + (5 C5 + PI5) rho h^4 cos + E5 h^5, all of theta;
 *           with Y, V the ray's height and slope (tangents) in the vertex plane and y, u those of
 *           the marginal ray, n (y V - u Y) is the same on both sides of a gap, and what refraction
 *           adds to it is the surface's contribution. Y, V as series in rho^2, rho h cos, h^2:
 *           the ray meets z = f(s), s = |Y + z V|^2; with p = 1 - 2 f' (Y + z V) V,
 *           G = 1 + 4 f'^2 s, W = 1 + V^2, k = n/n':
 *           m = (n' sqrt(W G (1 - k^2) + k^2 p^2) - n p)/G,
 *           V' = (n V - 2 m f' (Y + z V))/(n + m)
 * Source    [Buchdahl68] for the quasi-invariant, intrinsic and induced parts and the twelve;
 *           [Cruickshank60] for the names; the series is derived here from Snell's law, and exact
 *           rays differ from it by the seventh power
 * Errors    those of seidel_compute; ERROR_DOMAIN: A5 of an odd asphere
 * Limits    rounding of double: about 1e-14 of the largest contribution. A thick lens adds nothing
 */
bool fifth_order_compute(const struct seidel_question *question, struct arena *arena,
                         struct fifth_order *fifth, struct error *error);

#endif
