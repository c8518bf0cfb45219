/* design/optimize_descend.h - down to where no step gains. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_OPTIMIZE_DESCEND_H
#define LENSCALC_DESIGN_OPTIMIZE_DESCEND_H

#include "design/merit/merit.h"
#include "design/solver/solver.h"

struct optimize_descent {
    struct merit *merit;
    const struct solver_problem *problem; /* of the merit */
    struct solver_options options;        /* of solver_run; `iterations` of all descents together */
    struct arena *arena;
};

/*
 * solver_run, and on from where it says that it has arrived while something gains.
 *
 * Given     numbers  the start; receives the best
 * Result    summary, of all descents; `limit` where it ends at rays that are lost, though the merit
 *           falls there; not known: it does not
 * Formula   where a solver ends, the damped step of all variables and that of each by itself, -g/h,
 *           are looked at: what promises more than a share of 1e-6 of the merit is tried, at
 *           lengths down to 1e-5 of it, and where one gains as much the descent goes on. With
 *           exact goals, which single variables cannot keep, nothing is tried
 * Errors    as solver_run
 */
bool optimize_descend(const struct optimize_descent *descent, double *numbers,
                      struct solver_summary *summary, struct merit_limit *limit,
                      struct error *error);

#endif
