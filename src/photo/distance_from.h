/* photo/distance_from.h - distances from the sensor, the pupil or the principal plane. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_DISTANCE_FROM_H
#define LENSCALC_PHOTO_DISTANCE_FROM_H

#include <stdbool.h>

#include "base/error.h"
#include "base/text.h"
#include "photo/dof.h"
#include "photo/dof_solve.h"

/* Where distances are measured from. */
enum distance_from { FROM_PRINCIPAL, FROM_SENSOR, FROM_ENTRANCE, FROM_FRONT, DISTANCES_FROM };

/* The words of the command line for them, indexed by enum distance_from; ends with null. */
extern const struct word distances_from[DISTANCES_FROM + 1];

/* A place to measure from, and what a real lens has between its planes. */
struct distance_reference {
    enum distance_from from;
    double hiatus; /* from H to H', mm, may be negative; 0 = thin lens */
    double front;  /* H seen from the first vertex, mm, + towards the sensor; NaN = none is known */
};

/*
 * Where the image of the subject lies.
 *
 * Given     f, s  focal length and distance from the front principal plane, mm, s > f; may be inf
 * Result    v from the rear principal plane, mm; f for a subject at infinity
 * Formula   v = f + f f/(s - f), which loses nothing near s = f and at infinity
 * Source    [Gauss41]
 */
double distance_image(double f, double s);

/*
 * What is added to a distance from the front principal plane to have it from elsewhere.
 *
 * Given     setting  complete; a lens with the same medium on both sides
 * Result    mm: 0; for the sensor v + hiatus with the image distance v = f s/(s - f) (the lens
 *           stands between); for the entrance pupil -f(1 - 1/P); for the front -front, NaN where
 *           that is not known
 * Source    [Gauss41]; the pupils are conjugates of magnification P, so that the entrance pupil
 *           lies f(1 - 1/P) before H: tests/truth/check_photo_lens.py compares it with its place
 */
double distance_offset(const struct dof_setting *setting,
                       const struct distance_reference *measuring);

/*
 * The distance from the front principal plane of a subject whose distance from elsewhere is given.
 *
 * Given     f, P      focal length, mm; pupil magnification
 *           distance  from the place of `measuring`, mm; may be inf
 *           s         receives it, mm
 * Formula   from the sensor T = s + v + hiatus, D = T - hiatus: s = (D + sqrt(D (D - 4 f)))/2, the
 *           solution with m <= 1; from the entrance pupil s = distance + f(1 - 1/P); from the
 *           front s = distance + front
 * Source    Derived here from 1/f = 1/s + 1/v; put back by tests/unit/test_distance_from.c
 * Errors    D below 4 f: no real image; ERROR_USAGE: a front that is not known
 */
bool distance_to_principal(double f, double P, double distance,
                           const struct distance_reference *measuring, double *s,
                           struct error *error);

/*
 * dof_solve with s and the targets near and far measured from elsewhere. Where s itself is unknown
 * the offset follows from the answer, so the two are solved in turn until they agree.
 *
 * Errors    as dof_solve and distance_to_principal; no agreement after 200 turns
 */
bool distance_solve(struct dof_setting *setting, const struct dof_targets *targets,
                    const struct distance_reference *measuring, struct error *error);

#endif
