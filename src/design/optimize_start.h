/* design/optimize_start.h - from a lens that cannot be judged to one that can. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_OPTIMIZE_START_H
#define LENSCALC_DESIGN_OPTIMIZE_START_H

#include "design/optimize.h"

/* A merit as the solver takes it. */
struct solver_problem optimize_problem(struct merit *merit);

/*
 * Numbers of the variables with which the merit has a value: that of plates have no image, that of
 * a rough layout loses rays.
 *
 * Given     numbers  where it has none; receives those where it has one
 * Result    in words what was done, to be said
 * Formula   a merit that has a value is made smaller until the real one has a value too: first of
 *           the goals that there are, then of all with less of the aperture and of the fields, as
 *           much of them as goes, which grows as the lens gets better
 * Errors    ERROR_DOMAIN: no goal has a value, nothing helps, or task->goes_on says no before it
 *           does; with the reason
 */
bool optimize_begin(const struct optimize_task *task, double *numbers, struct arena *arena,
                    const char **words, struct error *error);

#endif
