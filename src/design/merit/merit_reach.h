/* design/merit/merit_reach.h - how far out light comes at each surface. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_REACH_H
#define LENSCALC_DESIGN_MERIT_MERIT_REACH_H

#include "design/merit/merit_state.h"

/*
 * Make ready: how far out light comes at each surface of the slot's place that states no diameter.
 *
 * Errors    no aperture
 */
bool merit_reach_open(struct merit *merit, const struct merit_slot *slot, struct arena *arena,
                      struct error *error);

/*
 * Those distances and their derivatives, into place->reach.
 *
 * Formula   the largest of real rays of the primary wavelength through the edge of the stop: of the
 *           axis, and of the field farthest from it the two in its plane. Where the lens has no
 *           such rays (no stop, an ideal lens, heights of the real image) |y| + |ybar| of the
 *           paraxial marginal and chief ray
 * Errors    merit->why: a ray is lost
 */
bool merit_reach(struct merit *merit, const struct merit_slot *slot);

#endif
