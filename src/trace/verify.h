/* trace/verify.h - one ray with 64 or 113 bits of precision, to check what 53 gave. */
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

/* Where a ray of so many bits ends, as a sum of two doubles each. */
struct precise_end {
    struct pair point[3];  /* mm, in the frame that the system ends in */
    struct pair cosine[3]; /* its direction there */
    enum ray_status status;
    size_t surface; /* where it was lost, 1-based; 0 = nowhere */
};

/*
 * Trace a ray in numbers of 64 bits, or of 113.
 *
 * Given     system     without clipping
 *           point      where it starts, mm
 *           direction  of any length: it is exact, its length is not looked at
 * Result    lost: NaN
 * Limits    64 bits as verify_ray, two ulp of 113 in the sum; where the compiler has no numbers of
 *           113 bits those of long double
 */
struct precise_end ray_of_64_bits(const struct system *system, const double point[3],
                                  const double direction[3]);
struct precise_end ray_of_113_bits(const struct system *system, const double point[3],
                                   const double direction[3]);

#endif
