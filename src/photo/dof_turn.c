/* photo/dof_turn.c - depth of field as turns of a disc: the same for every distance. */
/* SPDX-License-Identifier: MIT */
#include "photo/dof_turn.h"

#include <math.h>

double dof_turn_place(double f, double P, double s)
{
    const double S = s - f * (1 - 1 / P);
    return -log1p(-f / (P * S));
}

void dof_turn_limits(double f, double N, double c, double P, double *near, double *far)
{
    const double e = N * c / (f * P);
    *near = e < 1 ? -log1p(-e) : INFINITY;
    *far = log1p(e);
}
