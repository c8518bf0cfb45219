/* design/solver/solver_descent.h - where a descent stands, and its steps. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_SOLVER_DESCENT_H
#define LENSCALC_DESIGN_SOLVER_SOLVER_DESCENT_H

#include "design/solver/solver_engine.h"
#include "design/solver/solver_sided.h"
#include "design/solver/solver_step.h"

#include <math.h>

/* Residuals at some parameters, and what is made of them. */
struct place {
    double *parameters, *residuals;
    double cost;   /* half the sum of rho */
    double excess; /* sum of the exact residuals' sizes */
};

/* A descent; parameters are measured in their scales. */
struct descent {
    struct engine_run *run;
    const struct solver_problem *problem;
    size_t n, squares, exact;
    struct place here, there;
    double *jacobian, *weights; /* here */
    double *scale;
    double *normal, *rest;     /* here, of all but what counts on one side only */
    double *gradient, *slopes; /* here; slopes are those of the exact residuals */
    double *diagonal;          /* what the damping is multiplied with */
    double damping, growth;
    double first_cost; /* at the start */
    double price;      /* of the exact residuals against the cost */
    double share;      /* of the exact residuals that a step takes off: less after steps too far */
    double *damped, *low, *high, *move, *none, *before, *wanted;
    double *second, *straight; /* residuals' second derivatives along a step, and that step */
    enum step_side *sides;     /* its sides */
    double *room;              /* of the normal equations */
    struct solver_sided sided;
    struct solver_step step;
    int steady; /* steps in succession that changed next to nothing */
};

/* Exact residuals are met as exactly as anybody asks. */
#define DESCENT_MET 1e-12

/* What a parameter is measured in. */
static inline double descent_scale(const struct descent *descent, size_t i)
{
    return isfinite(descent->scale[i]) ? descent->scale[i] : 1;
}

/* Room, of the problem of a run. */
void descent_open(struct descent *descent, struct arena *arena);

/* Residuals of a place, and derivatives where they are wanted. Result: false: it has no value */
bool descent_measure(struct descent *descent, struct place *place, double *jacobian);

/* What the descent makes small. */
double descent_height(const struct descent *descent, const struct place *place);

/* What follows from residuals and derivatives here. */
void descent_set_equations(struct descent *descent);

/* Damping at the start. */
void descent_begin(struct descent *descent);

/* The gradient that residuals there would have with the derivatives here. */
void descent_carry(const struct descent *descent, const double *residuals, double *into);

/*
 * Second derivatives by each parameter.
 *
 * Given     explained  the gradient here as descent_carry has it from before the step
 *           from       the parameters before it
 */
void descent_learn(struct descent *descent, const double *explained, const double *from);

/* Find the step and what there is behind it. Result: false: no value there; NaN promise: no step */
bool descent_step(struct descent *descent, double *promised);

/*
 * Bend the step that was found, which leads straight from here.
 *
 * Formula   d + a/2 with (J^T J + l D) a = -J^T r'', r'' the second derivative along d from the
 *           residuals at a tenth of it; not where a is long against d
 * Source    [Transtrum11] (geodesic acceleration)
 */
void descent_bend(struct descent *descent);

/* The last thing: exact residuals are 0 as nearly as can be. */
void descent_finish(struct descent *descent);

#endif
