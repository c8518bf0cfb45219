/* trace/verify.h - one ray with 64 bits of precision, to check what 53 gave. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_VERIFY_H
#define LENSCALC_TRACE_VERIFY_H

#include "trace/system.h"

/* What a ray should be, and how far it is from it. */
struct verification {
    struct ray ray;      /* traced with 64 bits, then rounded; status without clipping */
    double point_error;  /* mm: of the ray under test at its last point */
    double cosine_error; /* of its direction cosines, the largest */
    double path_error;   /* mm; 0 if the system counts no path */
};

/*
 * Trace a ray again in 80-bit numbers and compare.
 *
 * Given     start   as given to rays_set
 *           tested  what rays_get answered
 * Result    NaN errors where either is lost (a clipped ray is not)
 * Limits    4e-17 mm on the double Gauss, a microsecond a ray. Under valgrind, which computes long
 *           double with 53 bits, and where long double is double, it is no better than the kernels
 */
struct verification verify_ray(const struct system *system, const struct ray *start,
                               const struct ray *tested);

#endif
