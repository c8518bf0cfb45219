/* design/merit/merit.h - operands of a lens with variables, as residuals and their derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_H
#define LENSCALC_DESIGN_MERIT_MERIT_H

#include "design/merit/merit_state.h"
#include "design/solver/solver.h"

/*
 * Make ready.
 *
 * Errors    ERROR_DOMAIN: no operands; a kind that cannot be had of this lens; as setup_open
 */
bool merit_open(const struct merit_question *question, struct arena *arena, struct merit *merit,
                struct error *error);

/*
 * Measure: context is the merit, parameters those of variables_get.
 *
 * Result    false: there is no value, merit->why says it
 * Formula   each residual (value - target)/deviation, whichever side counts; those of rays as
 *           design/merit/merit_rays.h has them. A focal length that is off by more than a factor
 *           of 2 goes on along its tangent in the power, where it has no pole: a lens may pass
 *           through no power on its way
 */
solver_function merit_measure;

/* The same with what counts only: of '<' and '>' 0 where it is met. */
solver_function merit_evaluate;

/* What makes one of the other; the derivatives may be null, and so stay as they are. */
void merit_drop_met(const struct merit *merit, double *residuals, double *jacobian);

#endif
