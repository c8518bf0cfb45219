/* design/fit/jackknife.h - standard errors by leaving out one group of residuals at a time. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_FIT_JACKKNIFE_H
#define LENSCALC_DESIGN_FIT_JACKKNIFE_H

#include "base/arena.h"

#include <stdbool.h>
#include <stddef.h>

/* A least-squares fit at its minimum. */
struct jackknife_fit {
    const double *residuals; /* with their weights */
    const double *jacobian;  /* their derivatives, rows x columns, row by row */
    size_t rows, columns;
    const size_t
        *group; /* of each row, below group_count; one without derivatives does not count */
    size_t group_count;
};

/*
 * Covariance of what a least-squares fit found, where residuals of one group belong together:
 * residuals of a ray, of a field. Nothing is taken for granted of how they are distributed, nor of
 * how those of one group depend on each other; groups are taken to be drawn independently.
 *
 * Given     covariance  receives columns x columns
 * Result    false, and NaN in all of it: fewer than two groups, or one without which the others
 *           leave a parameter open
 * Formula   with J = Q R, and g the rows of a group, the others alone would find parameters that
 *           differ by R^-1 (1 - Qg^T Qg)^-1 Qg^T rg; (G - 1)/G times the sum of the squares of
 *           these, G groups. Exact where residuals are linear; well conditioned however unlike the
 *           parameters are
 * Source    [Efron82] 3 (the jackknife), for groups as [MacKinnon85] have it for single residuals
 *           (HC3)
 * Limits    with few groups it is rather too large than too small: 1.2 times the spread with nine
 *           fields and six parameters
 */
bool jackknife_covariance(const struct jackknife_fit *fit, struct arena *arena, double *covariance);

#endif
