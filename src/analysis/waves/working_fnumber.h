/* analysis/waves/working_fnumber.h - f-numbers of the cone that a field's image gets its light by. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_WORKING_FNUMBER_H
#define LENSCALC_ANALYSIS_WAVES_WORKING_FNUMBER_H

#include "analysis/waves/fan.h"

/* 1/(2 numerical aperture) of what is clear; infinite: no cone. */
struct working_fnumber {
    double tangential, sagittal; /* of the two marginal rays of each section */
    double both;                 /* of all four */
    double height[2];            /* x, y: where the chief ray meets the image plane, mm */
    struct pupil_islands islands;
};

/*
 * Working f-numbers of a field at the first wavelength of its setup.
 *
 * Given     bundle  its wavelength and pattern are not used; with `clip` the marginal rays are the
 *                   last that arrive, else those at the rim of the stop
 * Result    NaN without an image plane: an image at infinity has no cone
 * Formula   NA = n' sin(angle between a marginal ray and the chief ray behind the lens), the
 *           marginal rays those of a fan of 41 rays and its ends (fan_trace), farthest out on both
 *           sides in the section; f-number = 1/(2 sqrt(mean of NA^2)), of two rays, or of all four
 * Source    [OpticStudio25] Working F/#, for its four rays; each section by its two. Of an ideal
 *           lens with a small stop in it, f-number N, that is N/cos(t)^2 tangentially and N/cos(t)
 *           sagittally
 * Errors    as fan_trace
 * Limits    light beyond a second gap in a section; obstructions within the cone do not count
 */
bool working_fnumber_find(const struct bundle_question *bundle, struct arena *arena,
                          struct working_fnumber *found, struct error *error);

#endif
