/* design/merit/merit_rays.h - operands of many rays: spots and wave fronts. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_RAYS_H
#define LENSCALC_DESIGN_MERIT_MERIT_RAYS_H

#include "design/merit/merit_bundle.h"
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

/* The rays of such a slot. */
struct merit_rays_look {
    struct merit_bundle *bundle; /* row: of a group's first residual, its x before its y; of
                                    SYMMETRY_ROUND it has y only */
    bool is_joint;
};
struct merit_rays_look merit_rays_look(const struct merit_slot *slot);

/* The lens as it is now, compiled and aimed: the first half of merit_fill_rays. */
bool merit_rays_aim(struct merit *merit, const struct merit_slot *slot);

/* merit_bundle_settle of all its rays. */
void merit_rays_settle(const struct merit_slot *slot, bool holds);

/* What irregularities do to rays, of the lens that was evaluated last: merit_bundle_deform. */
bool merit_rays_deform(const struct merit_slot *slot, struct error *error);

#endif
