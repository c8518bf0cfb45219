/* design/solver/solver.h - nonlinear least squares with bounds and robust losses. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_H

#include "base/arena.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * How much a residual counts that is far off: rho(s) of its square s, with a the scale.
 *   none     s
 *   huber    s up to a^2, then 2 a sqrt(s) - a^2
 *   soft-l1  2 a^2 (sqrt(1 + s/a^2) - 1)
 *   cauchy   a^2 log(1 + s/a^2)
 */
enum solver_loss { LOSS_NONE, LOSS_HUBER, LOSS_SOFT_L1, LOSS_CAUCHY };

/* Consecutive residuals that are one observation: s is the sum of their squares. */
struct solver_block {
    size_t residuals;
    enum solver_loss loss;
    double scale; /* a, above 0, in units of the residual; not read without a loss */
};

/* On which side of 0 a residual counts: on the other it is as if it were 0. */
enum solver_side { SIDE_BOTH, SIDE_ABOVE, SIDE_BELOW };

/*
 * Residuals, and where `jacobian` is not null their derivatives, residual by residual.
 *
 * Result    false: there is no value here; the step that led here is taken back
 */
typedef bool solver_function(void *context, const double *parameters, double *residuals,
                             double *jacobian);

struct solver_problem {
    size_t parameter_count, residual_count;
    solver_function *evaluate;
    void *context;
    const double *low, *high;          /* bounds, infinite where there is none; null = no bounds */
    const struct solver_block *blocks; /* in the order of the residuals; null = no loss */
    size_t block_count;
    /* Of the parameters: changes by so much are alike; null = by the derivatives. SOLVER_DLS */
    const double *scale;
    /* So many residuals, the last, are to be 0: they are no part of the cost. SOLVER_DLS */
    size_t exact_count;
    /* Of each residual; null = both. `evaluate` gives it and its derivatives on the other side too:
       steps look ahead. Neither with losses nor of exact ones */
    const enum solver_side *sides;
};

/*
 * What makes the steps.
 *   dls    damped least squares, inside bounds and along exact conditions
 *   ceres  the solver of that name, where the program is linked with it
 */
enum solver_engine { SOLVER_DLS, SOLVER_CERES };

/* How far it has come, once an iteration. */
struct solver_progress {
    int iteration;
    double cost;
    const double *parameters;
};

/* What is 0 stands for its usual value. */
struct solver_options {
    enum solver_engine engine;
    int iterations;       /* at most so many; usually 200 */
    double function;      /* converged: relative change of the cost; usually 1e-15 */
    double gradient;      /* largest element of the gradient; usually 1e-30: it has a unit */
    double parameter;     /* relative change of the parameters; usually 1e-13 */
    double initial_trust; /* radius of the first step in parameters scaled by the Jacobian; 1e4 */
    bool lean; /* find the minimum and nothing else: no undamped steps to its last digit, no errors;
                  there may be fewer residuals than parameters, or no parameter at all */
    double dependent; /* a parameter is not determined where the others leave less of its
                             derivative; usually 1e-11 */
    bool (*progress)(void *context, const struct solver_progress *progress); /* false: stop */
    void *progress_context;
};

enum solver_status {
    SOLVER_CONVERGED,
    SOLVER_LIMIT,   /* as many iterations as allowed; the result is the best so far */
    SOLVER_STOPPED, /* by `progress`; the result is the best so far */
    SOLVER_STUCK    /* no step that lowers the cost could be computed */
};

/* Arrays lie in the arena. */
struct solver_summary {
    enum solver_status status;
    const char *message; /* in words */
    long iterations, evaluations, derivatives;
    double initial_cost, final_cost; /* half the sum of rho */
    double rms;                      /* of the residuals at the end, without loss */
    double excess;                   /* the largest of the exact residuals */
    size_t degrees_of_freedom;       /* residuals less parameters that were free and determined */
    bool *at_bound;                  /* a parameter that its bound holds; it has no error */
    bool *undetermined;              /* a parameter that the residuals do not fix by themselves */
    size_t rank;                     /* of the derivatives by the free parameters */
    double *covariance;              /* n x n, scaled by the variance of the residuals; NaN where
                                        there is none */
    const double *residuals, *jacobian; /* at the end */
    double *inverse;                    /* n x n: (J^T W J)^-1, of which that is a multiple */
    double *standard_error;             /* n */
};

/* Is the engine part of this program? */
bool solver_has(enum solver_engine engine);

/*
 * Find the parameters that make half the sum of the squared residuals (of rho) smallest.
 *
 * Given     parameters  the start, within the bounds; receives the best
 * Result    summary of how it went; not converging is a status, not an error
 * Formula   SOLVER_DLS: (J^T J + l D) d = -J^T r inside the bounds and with the exact residuals'
 *           slopes times d making up for them, by multipliers; l by the gain against what the step
 *           promised. D is 1 in natural scales at first, then follows the second derivatives that
 *           steps meet, |change of J^T r at the same r| over the move; without scales the diagonal
 *           of J^T J. Steps that gain little follow the bend of the valley that they are in, after
 *           the second derivative along them, but for exact residuals. Residuals of one side are
 *           part of the step where they count at its end. Exact residuals bend: a step is followed
 *           by some that only return to them.
 *           SOLVER_CERES: Levenberg-Marquardt with orthogonal factors, and bounds by an active set:
 *           as soon as a parameter lies on a bound and the cost falls beyond it, it is held there
 *           and the rest goes on (a projected step alone stalls: the others then move as if it had
 *           not been cut); where nothing more is gained and the cost falls inwards, it is let go.
 *           Covariance s^2 (J^T W J)^-1 at the end, s^2 = sum rho' r^2/(degrees of freedom), W =
 *           diag rho', over the parameters that are free and determined
 * Source    [Levenberg44]; [Transtrum11] (bent steps); [Spencer63] (exact conditions);
 *           [Dilworth78] (second derivatives); [Nielsen99] 2.2 (damping); [Ceres22];
 *           [Nocedal06] 10.3, 16.5 (active sets)
 * Errors    ERROR_DOMAIN: fewer residuals than parameters, no parameter (but for lean), bounds that
 *           contradict each other, a start outside of them or without finite residuals and
 *           derivatives, a loss without scale, sides and losses at once; Ceres where it is not part
 *           of the program, or asked for exact residuals
 * Limits    a local minimum. No random numbers, no clock, one thread: the same every time
 */
bool solver_run(const struct solver_problem *problem, const struct solver_options *options,
                double *parameters, struct arena *arena, struct solver_summary *summary,
                struct error *error);

#endif
