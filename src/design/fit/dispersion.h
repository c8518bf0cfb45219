/* design/fit/dispersion.h - a dispersion formula from measured indices. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_FIT_DISPERSION_H
#define LENSCALC_DESIGN_FIT_DISPERSION_H

#include "base/arena.h"
#include "base/error.h"
#include "design/solver/solver.h"
#include "optics/glass.h"

#include <stddef.h>

/* Measured indices, by rising wavelength. */
struct dispersion_data {
    size_t count;
    const double *wavelength; /* um */
    const double *index;
    const double *deviation; /* standard deviation of each index; null = the same for all */
};

struct dispersion_fit {
    struct glass glass; /* its range is that of the data */
    size_t parameter_count;
    double *parameters;
    const char **names;
    double *residuals; /* fitted less measured index, one a row of the data */
    double rms, largest;
    struct solver_summary summary;
};

/*
 * Fit a dispersion formula.
 *
 * Given     formula  GLASS_SELLMEIER, GLASS_SCHOTT, GLASS_CAUCHY, GLASS_BUCHDAHL (about the d
 *                    line) or GLASS_CONRADY
 *           terms    0 for the usual number
 * Result    fit, in the arena; standard errors from the residuals
 * Formula   smallest sum of squared differences of the index, each over its deviation. All but
 *           Sellmeier are linear in n or n^2, and start from the solution of that. Sellmeier
 *           starts from resonances on a grid, each with its best strengths, and keeps the best
 *           end: of more than 300 indices by 300 of them, from which all are fitted then;
 *           resonances stay outside of the range of the data
 * Source    [Schott16] for the forms
 * Errors    ERROR_DOMAIN: fewer indices than coefficients, wavelengths that do not rise, an index
 *           not above 0, a deviation not above 0, a number of terms the formula cannot have
 * Limits    coefficients of several resonances trade against each other: the index is well
 *           determined where the coefficients are not
 */
bool dispersion_fit(const struct dispersion_data *data, enum glass_formula formula, size_t terms,
                    struct arena *arena, struct dispersion_fit *fit, struct error *error);

#endif
