/* photo/dof_turn.h - depth of field as turns of a disc: the same for every distance. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_DOF_TURN_H
#define LENSCALC_PHOTO_DOF_TURN_H

#include "photo/dof.h"

/*
 * Where a distance stands on a scale on which the depth of field has the same length everywhere.
 *
 * Given     f, P  focal length, mm, > 0; pupil magnification, > 0 (not checked)
 *           s     from the front principal plane, mm, > f; may be inf
 * Result    0 at infinity, growing towards the lens; times any factor an angle
 * Formula   w = -ln(1 - f/(P S)), S = s - f(1 - 1/P) from the entrance pupil
 * Source    derived here from the limits of photo/dof.h: with e = N c/f they are
 *           1 - f/(P Sn) = (1 - f/(P S))(1 - e/P) and 1 - f/(P Sf) = (1 - f/(P S))(1 + e/P), so
 *           that w(near) - w(s) and w(s) - w(far) do not depend on s
 */
double dof_turn_place(double f, double P, double s);

/*
 * How far from the place in focus the limits are on that scale.
 *
 * Given     f, N, c, P  as above, c mm
 * Result    near  towards the lens; inf from N c = f P on, where the near limit has no image
 *           far   away from it; infinity is sharp where it is at least the place in focus
 * Formula   near = -ln(1 - N c/(f P)), far = ln(1 + N c/(f P))
 * Source    as above
 */
void dof_turn_limits(double f, double N, double c, double P, double *near, double *far);

#endif
