/* base/constants.h - pi, the degree and the metre. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BASE_CONSTANTS_H
#define LENSCALC_BASE_CONSTANTS_H

/* Macros, so that tables may hold them: a const object is no constant expression in C17. */
#define PI                 3.14159265358979323846
#define RADIANS_PER_DEGREE 0.017453292519943295769
#define DEGREES_PER_RADIAN 57.295779513082320877
#define MM_PER_M           1000.0
#define MM2_PER_M2         1e6

static inline double degrees_from_radians(double angle)
{
    return angle * DEGREES_PER_RADIAN;
}

#endif
