/* design/merit/merit_asbuilt.h - spots of lenses as they are made: the nominal one, and errors. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_ASBUILT_H
#define LENSCALC_DESIGN_MERIT_MERIT_ASBUILT_H

#include "design/merit/merit_state.h"

/*
 * asbuilt: the residuals of `poly`, then one for each perturbation of question.errors.
 *
 * Formula   sqrt(sum_i (sigma_j J_ij)^2): J_ij the derivative of residual i of `poly` by
 *           perturbation j, exact, less its part along the derivative by the image plane, as each
 *           position is focused anew, for all of its fields at once; sigma_j the deviation of the
 *           perturbation, of its half range and distribution. So the squares add up to the nominal
 *           sum of W RMS^2, in the plane that the lens has, and the linear variances of all
 *           coordinates of rays about their centroids
 *           Rays go through their points of the stop in every lens. Half ranges in mm, 1/mm, 1 and
 *           rad are those of the lens at the start
 *           Derivatives of these residuals by the variables are central differences of exact first
 *           derivatives, by 1e-4 of natural scales: right to about 1e-5. Where one side has no
 *           value they are of the other side alone; of an error that does nothing they are 0
 * Source    derived here
 * Errors    of merit_prepare_asbuilt: as merit_prepare_rays and perturbed_open; ERROR_DOMAIN:
 *           nothing is perturbed; an index behind or before a mirror
 * Limits    first order: what errors do to the mean by second derivatives is not in it
 */
merit_fill merit_fill_asbuilt;
merit_prepare merit_prepare_asbuilt;

#endif
