/* design/merit/merit_chief.h - operands of real chief rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_CHIEF_H
#define LENSCALC_DESIGN_MERIT_MERIT_CHIEF_H

#include "design/merit/merit_state.h"

/*
 * height, distortion, lateral, telecentric: of the real chief ray of the field of the operand, else
 * of the field farthest from the axis.
 *
 * Formula   height      where it meets the image plane, along the field's direction in the object,
 *                       upwards or to the right, mm
 *           distortion  100 (h - ideal)/ideal, ideal the height of the rectilinear projection:
 *                       |n| f tan t with the focal length of the primary wavelength; of a near
 *                       object its height times the magnification
 *           lateral     height at the wavelength of the operand less that at the primary one; or
 *                       at the shortest less that at the longest
 *           telecentric atan of its slope behind the lens in that direction, rad
 * Source    analysis/rays/distortion.h, analysis/rays/chromatic.h
 * Errors    as merit_ray_check and merit_image_check; distortion on the axis; lateral colour of one
 *           wavelength
 */
merit_fill merit_fill_chief;
merit_prepare merit_prepare_chief;

#endif
