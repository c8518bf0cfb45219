/* trace/kernel/search.h - where a ray meets an asphere, by search, if Newton's method loses it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_KERNEL_SEARCH_H
#define LENSCALC_TRACE_KERNEL_SEARCH_H

#include "trace/kernel/step.h"

/*
 * Make a step ready to be searched: its `inner`, `rim2` and `depth`, which all rays share.
 *
 * Given     step  STEP_ASPHERE, STEP_TROUGH or STEP_ODD, with `inner` half the diameter that the
 *                 lens gives, or 0
 * Result    `inner` is that, or else the radius up to which no slope can be more than 45 degrees;
 *           the rim is where the conic ends, or the clear aperture, beyond which all is lost
 *           anyway, and never beyond 1000 times `inner`; nor, from twice that on, where the highest
 *           power of an even asphere has taken the sag to 100 times the radius
 */
void search_prepare(struct step *step);

/*
 * The first place within the rim where the ray goes through the surface from front to back.
 *
 * Given     point      of the ray, in the frame of the surface
 *           direction  any length; along the light
 * Result    d: there the ray is at point + d direction; NaN if it goes through nowhere
 * Formula   the sign of z - sag(r) along the part of the ray that is nearer to the axis than the
 *           rim and not farther from the vertex plane than the depth: in steps of 1/24 of `inner`
 *           about the point nearest to the axis, longer ones outside; where the distance has a
 *           minimum between steps it is sought; the step in which the sign changes is halved to
 *           the last bit
 * Limits    pairs of passages closer to each other than a step may be overlooked, unless the
 *           distance shows it; 1e-15 of the size, at grazing incidence less. The same bits whatever
 *           instruction set calls it, for it is compiled once
 */
double search_meet(const struct step *step, const double point[3], const double direction[3]);

#endif
