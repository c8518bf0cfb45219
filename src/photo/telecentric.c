/* photo/telecentric.c - depth of field of a telecentric lens. */
/* SPDX-License-Identifier: MIT */
#include "photo/telecentric.h"

#include "photo/given.h"

double telecentric_fnumber(double m, double na)
{
    return m / (2 * na);
}

bool telecentric_depth(double m, double fnumber, double c, double *depth, struct error *error)
{
    *depth = 2 * c * fnumber / (m * m);
    return check_positive("magnification", "", m, error) &&
           check_positive("working f-number", "", fnumber, error) &&
           check_positive("circle of confusion", " mm", c, error);
}
