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
enum distance_from { FROM_PRINCIPAL, FROM_SENSOR, FROM_ENTRANCE, DISTANCES_FROM };

/* The words of the command line for them, indexed by enum distance_from; ends with null. */
extern const struct word distances_from[DISTANCES_FROM + 1];

/*
 * What is added to a distance from the front principal plane of a thin lens to have it from
 * elsewhere.
 *
 * Given     setting  complete
 * Result    mm: 0; for the sensor the image distance v = f s/(s - f) (the lens stands between);
 *           for the entrance pupil -f(1 - 1/P)
 * Source    [Ray02], thin lens
 */
double distance_offset(const struct dof_setting *setting, enum distance_from from);

/*
 * The distance from the front principal plane of a subject whose distance from elsewhere is given.
 *
 * Given     f, P      focal length, mm; pupil magnification
 *           distance  from `from`, mm; may be inf
 *           s         receives it, mm
 * Formula   from the sensor T = s + v: s = (T + sqrt(T (T - 4 f)))/2, the solution with m <= 1;
 *           from the entrance pupil s = distance + f(1 - 1/P)
 * Source    Derived here from 1/f = 1/s + 1/v; put back by tests/unit/test_distance_from.c
 * Errors    T below 4 f: no real image
 */
bool distance_to_principal(double f, double P, double distance, enum distance_from from, double *s,
                           struct error *error);

/*
 * dof_solve with s and the targets near and far measured from `from`. Where s itself is unknown
 * the offset follows from the answer, so the two are solved in turn until they agree.
 *
 * Errors    as dof_solve and distance_to_principal; no agreement after 200 turns
 */
bool distance_solve(struct dof_setting *setting, const struct dof_targets *targets,
                    enum distance_from from, struct error *error);

#endif
