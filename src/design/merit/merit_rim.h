/* design/merit/merit_rim.h - the stop as wide as the exact marginal ray, where a lens asks for that. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_RIM_H
#define LENSCALC_DESIGN_MERIT_MERIT_RIM_H

#include "design/merit/merit_state.h"

/*
 * Make a place ready whose lens has lens.stop_is_real, and an aperture that is not the diameter of
 * its stop.
 *
 * Errors    ERROR_DOMAIN: an ideal thick lens, whose rays have no derivatives; as merit_bundle_open
 */
bool merit_rim_open(struct merit *merit, size_t place, struct arena *arena, struct error *error);

/*
 * The stop of the lens as it is now, with derivatives: place->stop, by which rays are aimed.
 *
 * Formula   the height in the stop of the ray of the axis, at the primary wavelength, through the
 *           edge of the paraxial entrance pupil. Where that ray is lost the stop is as wide as the
 *           paraxial one
 */
void merit_rim_find(struct merit *merit, size_t place);

#endif
