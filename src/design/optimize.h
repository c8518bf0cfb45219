/* design/optimize.h - a lens made better, from where it is. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_OPTIMIZE_H
#define LENSCALC_DESIGN_OPTIMIZE_H

#include "design/merit/merit.h"
#include "design/solver/solver.h"

/* What is made better, and how. */
struct optimize_task {
    struct merit *merit;
    enum solver_engine engine;
    int iterations;                 /* at most so many; 0: as solver_run has it */
    const double *start;            /* where it begins; null: the lens's own numbers */
    bool (*goes_on)(void *context); /* asked once an iteration; false: the best so far. Or null */
    void *context;
};

/* Where it stands: residuals and figures as the merit has them. */
struct optimize_state {
    double *numbers; /* of the variables */
    double *residuals, *values;
    double merit; /* sum of the squares, constraints apart */
};

/* Arrays lie in the arena. */
struct optimize_answer {
    struct solver_summary summary;
    struct optimize_state before, after; /* NaN before: the lens has no merit as it is */
    struct merit_limit limit; /* where it ended though the merit falls beyond; or not known */
    const char *begun;        /* what was done where the lens itself has no merit; null: nothing */
    bool is_detour;  /* it went by points of the entrance pupil where rays could not be aimed */
    bool *is_idle;   /* a variable that nothing depends on, neither at the start nor at the end */
    double *history; /* the merit at the start and after each iteration */
    size_t history_count;
};

/*
 * The local minimum that damped least squares, or Ceres, finds from the lens's own numbers.
 *
 * Errors    ERROR_DOMAIN: the start has no merit, with the reason; as solver_run
 */
bool optimize_run(const struct optimize_task *task, struct arena *arena,
                  struct optimize_answer *answer, struct error *error);

/* Who has an effect on a residual there, by the derivatives of merit_measure, is no longer idle. */
void optimize_find_effects(const struct merit *merit, const double *residuals,
                           const double *jacobian, bool *is_idle);

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
 *           much of them as goes, which grows as the lens gets better, by steps that shrink and
 *           grow. Where none goes the pupil is vignetted at the edge of the field; then numbers of
 *           aspheres, which begin as the lens has them and are held, vary too, low orders first.
 *           Rays are kept farther from loss than `grazing` wants
 * Errors    ERROR_DOMAIN: no goal has a value, nothing helps, or task->goes_on says no before it
 *           does; with the reason
 */
bool optimize_begin(const struct optimize_task *task, double *numbers, struct arena *arena,
                    const char **words, struct error *error);

#endif
