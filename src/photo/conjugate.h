/* photo/conjugate.h - conjugate points: focal length, distances and magnification. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_CONJUGATE_H
#define LENSCALC_PHOTO_CONJUGATE_H

#include <stdbool.h>

#include "base/error.h"

/* Which of the two focusings between a fixed subject and a fixed sensor is meant. */
enum conjugates_choice {
    CONJUGATES_REDUCED, /* m <= 1, the usual photograph */
    CONJUGATES_ENLARGED /* m >= 1, the lens nearer to the subject */
};

/* What is known: exactly two of f, s, v, m and T; NaN = not given. */
struct conjugates_given {
    double f;      /* focal length, mm, > 0 */
    double s;      /* distance, subject from the front principal plane, mm, > 0, may be inf */
    double v;      /* image distance, sensor from the rear principal plane, mm, > 0 */
    double m;      /* magnification, positive number, 0 at infinity */
    double T;      /* sensor distance, subject to sensor, mm, may be inf */
    double hiatus; /* from H to H', mm, may be negative; 0 = thin lens */
    enum conjugates_choice choice; /* used where f and T are given, else ignored */
};

/* All of it; lengths in mm. */
struct conjugates {
    double f, s, v, m, T;
    double extension;          /* v - f, computed as f m */
    double twin_magnification; /* 1/m, of the other focusing with the same T; inf for m = 0 */
};

/* What a magnification does to the exposure. */
struct conjugates_exposure {
    double working_fnumber; /* N (1 + m/P) */
    double factor;          /* multiply the time by this: (1 + m/P)^2 */
    double stops;           /* the same in stops, log2 of the factor */
};

/*
 * Solve the conjugate equation of a lens in air for everything that was not given.
 *
 * Given     two of f, s, v, m, T (see struct conjugates_given); the others NaN
 * Result    all five, the given ones unchanged; s and T are inf for a subject at infinity (m = 0).
 *           For f and T there are two solutions, m and 1/m with s and v exchanged: `choice` picks
 *           one, twin_magnification is the other
 * Formula   1/f = 1/s + 1/v; m = v/s = f/(s - f); s = f (1 + 1/m); v = f (1 + m);
 *           T = s + v + hiatus = f (2 + m + 1/m) + hiatus.
 *           f, T: with D = T - hiatus and x = D/f - 4 >= 0, m = 2/(2 + x + sqrt(x (x + 4))), which
 *           has no cancellation at small m. s, T: v = D - s. m, T: f = D m/(1 + m)^2
 * Source    Gauss, Dioptrische Untersuchungen (1841): principal planes; Newton's x x' = f^2
 * Errors    ERROR_USAGE unless exactly two are given. ERROR_DOMAIN: a length not above 0; s within
 *           f and v within f (virtual image: a magnifier, not a photograph); T below 4 f + hiatus;
 *           a pair that leaves the lens undetermined (s = inf with T, m = 0 with s or T)
 * Limits    paraxial, one focal length: a lens with internal focusing changes f on the way. Given
 *           its nearest T and its magnification there, f is the focal length it has there.
 *           T and f within 1e-12 f of T = 4 f + hiatus count as 1:1 (rounding of decimal input)
 */
bool conjugates_solve(const struct conjugates_given *given, struct conjugates *result,
                      struct error *error);

/*
 * Effective f-number and exposure factor at a magnification ("bellows factor").
 *
 * Given     N  f-number as marked, > 0
 *           m  magnification, >= 0
 *           P  pupil magnification, exit/entrance diameter, > 0; reversed lens: N/P and 1/P;
 *              beyond the range of photo/given.h
 * Formula   N_eff = N (1 + m/P), factor (1 + m/P)^2, stops 2 log2(1 + m/P)
 * Source    Kingslake, Optics in Photography (1992); Bigler, quoted in test_conjugate.c
 * Errors    values outside the ranges above
 * Limits    compare like with like: factor 1 is the same lens at infinity
 */
bool conjugates_exposure(double N, double m, double P, struct conjugates_exposure *result,
                         struct error *error);

/*
 * Working distance: from the subject to the lens's front.
 *
 * Given     s                subject from the front principal plane, mm, may be inf
 *           front_principal  position of the front principal plane seen from the lens's front
 *                            (vertex or rim), mm, + towards the sensor
 * Result    distance s - front_principal, mm
 * Errors    not above 0: the subject would lie inside the lens
 */
bool conjugates_working_distance(double s, double front_principal, double *distance,
                                 struct error *error);

/*
 * Distance of the subject from the entrance pupil, the centre of perspective.
 *
 * Given     f > 0 mm, m >= 0, P > 0
 * Result    X, mm; inf for m = 0
 * Formula   X = f (1/m + 1/P) = s - f (1 - 1/P)
 * Source    lenscalc.7, depth of field with a pupil magnification; photo/dof.h measures from it
 */
double conjugates_pupil_distance(double f, double m, double P);

#endif
