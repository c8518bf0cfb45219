/* design/solver/escape.h - out of a minimum: a problem with hills where minima are known. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_SOLVER_ESCAPE_H
#define LENSCALC_DESIGN_SOLVER_ESCAPE_H

#include "design/solver/solver.h"

/* A hill over a minimum. */
struct escape_hill {
    const double *at; /* the minimum's parameters */
    double height;    /* of the sum of squares there */
    double width;     /* in scales: where the hill's square is 1/e of its height */
};

struct escape {
    const struct solver_problem *problem; /* with scales, without losses */
    const struct escape_hill *hills;
    size_t count;
};

/*
 * The problem with hills.
 *
 * Given     escape  must outlive the problem
 * Result    a residual more for each hill, before the exact ones
 * Formula   sqrt(H) exp(-d^2/(2 W^2)), d^2 = sum ((x - at)/scale)^2: its square, which is added to
 *           the sum of squares, is H on the minimum and is gone a few W away, so that damped least
 *           squares leave the minimum by the lowest of its passes
 * Source    [Isshiki95]: the escape function as one more operand, with height and width
 */
struct solver_problem escape_problem(struct escape *escape);

/* Distance of two points, in scales. */
double escape_distance(const struct solver_problem *problem, const double *a, const double *b);

#endif
