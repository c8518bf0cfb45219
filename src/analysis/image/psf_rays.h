/* analysis/image/psf_rays.h - the image of a point by rays, where waves turn too often to be added up. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_PSF_RAYS_H
#define LENSCALC_ANALYSIS_IMAGE_PSF_RAYS_H

#include "analysis/image/psf_light.h"

/* Where the rays of one wavelength meet the image plane, from the reference. */
struct psf_rays {
    const double (*at)[2]; /* mm */
    const double *weights; /* they add up to 1 */
    size_t count;
    double farthest; /* of them, along x or y, mm */
};

/*
 * Trace them.
 *
 * Given     pupil  of an image that lies not infinitely far away
 * Formula   quadrature_make, weighted as the energy of the beam
 * Errors    as bundle_trace
 */
bool psf_rays_trace(const struct exit_pupil *pupil, struct arena *arena, struct psf_rays *rays,
                    struct error *error);

/*
 * Add them to the pixels they meet.
 *
 * Given     values  plane->size * plane->size, per mm^2
 *           energy  of all of them
 * Formula   a ray is as large as a pixel: four have shares of it. What meets none is left out
 */
void psf_rays_add(const struct psf_rays *rays, const struct psf_plane *plane, double energy,
                  double *values);

/* The amplitude of W = 0 at the reference: plane->perfect. Errors as psf_points_put. */
bool psf_rays_perfect(const struct psf_plane *plane, double *perfect, struct error *error);

#endif
