/* photo/dof_solve.h - the settings that give a wanted depth of field. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_DOF_SOLVE_H
#define LENSCALC_PHOTO_DOF_SOLVE_H

#include <stdbool.h>

#include "base/error.h"
#include "photo/dof.h"

/* What the photograph shall have; NaN = not asked for. Distances from the front principal plane. */
struct dof_targets {
    double near;          /* mm, > 0 */
    double far;           /* mm; may be inf */
    double total;         /* depth of field, mm, > 0; may be inf */
    double hyperfocal;    /* mm, > 0, finite */
    double magnification; /* >= 0; 0 puts the subject at infinity */
};

/*
 * The members of a setting that are not known, from what the photograph shall have.
 *
 * Given     setting  P given; of f, N, s, c those that are NaN are unknown and filled in
 *           targets  as many as there are unknowns
 * Result    setting  complete and legal; dof_compute gives the targets for it. Where infinity shall
 *           be sharp the last bits are chosen so that far is inf and not merely huge.
 * Formula   q = f(1 - 1/P), a = near - q, b = far - q, e = N c/f, eps = e/m
 *           magnification: s = f(1 + 1/m) or f = s m/(1 + m)
 *           hyperfocal: N c = f^2/(H - f) or f = 2 H Nc/(Nc + sqrt(Nc^2 + 4 H Nc))
 *           near and far: m = (f/2)(1/a + 1/b)/(1 - (f/(2P))(1/a + 1/b)),
 *           e = (f/2)(1 + m/P)(far - near)/(a b); near or far with the depth are the same
 *           near for s: m = (f - a e)/(near - f); far for s: m = (f + b e)/(far - f), e for inf
 *           near for N, c: e = m(s - near)/a, f/a for s = inf; far: e = m(far - s)/b, m for inf
 *           total for N, c: eps = T/(X + sqrt(X^2 + T^2))
 *           total for s: m = (f e/P + sqrt((f e/P)^2 + T(T e^2 + 2 f e)))/T, e for T = inf
 *           f from near, far or total: a bracketed root, the other unknowns following from f; where
 *           two focal lengths do (possible with m or H given), the longer one
 * Source    Derived here: near = q + f(1 + m/P)/(m + e), far likewise with m - e, solved for what
 *           is unknown; pinned by the round trips in tests/unit/test_dof_solve.c
 * Errors    ERROR_USAGE: more or fewer targets than unknowns, or targets that do not fix them (N
 *           and c enter as a product only); ERROR_DOMAIN: a value outside its range, near >= far,
 *           near <= f, near >= s, far <= s, no real image, no solution
 * Limits    Exact formulas only (DOF_EXACT). A target above infinity's threshold (far = inf, total
 *           = inf) is met at that threshold, s = H. A distance within the focal length that a blur
 *           disc of the order of the pupil could still cover (e >= P) is refused.
 */
bool dof_solve(struct dof_setting *setting, const struct dof_targets *targets, struct error *error);

#endif
