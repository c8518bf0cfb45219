/* analysis/waves/pupil_fan.h - pupil aberrations along two sections of the entrance pupil. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_PUPIL_FAN_H
#define LENSCALC_ANALYSIS_WAVES_PUPIL_FAN_H

#include "analysis/waves/fan.h"

/*
 * How far from their paraxial places real rays cross the stop that are aimed at the paraxial
 * entrance pupil.
 *
 * Given     bundle  its wavelength, pattern and pupil are not used; with `clip` rays that apertures
 *                   in front of the stop block are lost, the rim of the stop itself does not count
 *           points  in each section, 2 and more; odd: the middle of the pupil is one of them
 * Result    a fan without ends, reference and path differences: `off` of a ray is its x and y in
 *           the stop less its paraxial ones at the primary wavelength, in units of the paraxial
 *           radius of the stop; 0 where the stop stands in front of the lens
 * Formula   a ray through (px, py) of the entrance pupil, in its radius, has its paraxial place in
 *           the stop at (px, py) times the radius of that
 * Source    [OpticStudio25] Pupil Aberration, which gives one component of it
 * Errors    as setup_beam and aim_at_entrance; ERROR_DOMAIN: no stop, or no ray reaches it
 */
bool pupil_fan_trace(const struct bundle_question *bundle, size_t points, struct arena *arena,
                     struct fan *fan, struct error *error);

#endif
