/* design/merit/merit_rays.h - operands of many rays: spots and wave fronts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_RAYS_H
#define LENSCALC_DESIGN_MERIT_MERIT_RAYS_H

#include "design/merit/merit_beams.h"
#include "design/merit/merit_state.h"

/*
 * spot, poly: one residual a ray and coordinate in the image plane, for all fields and wavelengths
 * or those of the operand. What is alike by symmetry is there once, with the weight of all.
 *
 * Formula   sqrt(W w) (x - mean x)/deviation: w of the rays of a field at a wavelength, adding up
 *           to 1, W that of the field times that of the wavelength. So the squares add up to the
 *           sum of W RMS^2 of the spots (analysis/rays/spot.h), in mm^2. The mean is that of the
 *           rays of a field at one wavelength; of `poly` that of all wavelengths, by their weights
 * opd: one residual a ray, sqrt(W w) (L - mean L)/wavelength/deviation, L the optical path to the
 * reference sphere (analysis/waves/opd.h) about the point where the chief ray of the first
 * wavelength
 * meets the image plane, through that ray's crossing of its paraxial exit pupil; the mean is that
 * of each wavelength. The squares add up to the sum of W RMS^2 in wavelengths. Of the index of the
 * image space itself only what it does to rays is derived
 *
 * Errors    of merit_prepare_rays: as merit_bundle_open; a target, a relation but '='. Of
 *           merit_fill_rays: a ray that is lost, or cannot be aimed
 */
merit_fill merit_fill_rays;
merit_prepare merit_prepare_rays;

/*
 * Mean squares of the spots or wave fronts of each field, of all wavelengths by their weights.
 *
 * Given     residuals  of the slot, as merit_fill_rays has filled them last
 *           squares    receives one a field of the bundle's wish: mm^2, or wavelengths^2
 */
void merit_rays_squares(const struct merit_slot *slot, const double *residuals, double *squares);

#endif
