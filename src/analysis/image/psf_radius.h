/* analysis/image/psf_radius.h - the radius that holds a share of the light of a point's image. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_PSF_RADIUS_H
#define LENSCALC_ANALYSIS_IMAGE_PSF_RADIUS_H

#include "analysis/image/psf.h"

/*
 * The circle about the centroid that has so much light.
 *
 * Given     psf    with its values and its centroid
 *           light  in values of pixels, above 0
 * Result    psf->radius80 and its error; they stay where the circle is not within the pixels
 * Formula   sum of values, those on the rim by their share within it. The light has no waves
 *           shorter than psf->finest: pixels of half of that and less hold it between them too, and
 *           small circles are filled with at least 64 steps a radius by polynomials through eight
 *           pixels each way. The error is what polynomials through four change; of coarser pixels
 *           two over the root of how many the rim cuts; and what the place of the centroid changes,
 *           which light beyond the pixels may move towards that of the rays
 * Source    derived here; a test has Airy's disc, whose light within x is 1 - J0^2 - J1^2
 */
void psf_radius_find(struct psf *psf, double light, struct arena *arena);

#endif
