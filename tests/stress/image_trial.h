/* tests/stress/image_trial.h - random lenses that make images, and rays for sums of our own. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_STRESS_IMAGE_TRIAL_H
#define LENSCALC_TESTS_STRESS_IMAGE_TRIAL_H

#include "drawn_lens.h"

#include "analysis/setup/setup.h"
#include "trace/aim/aim.h"

/* A lens whose beam is as wide as its stop, at one field and one wavelength. */
struct image_trial {
    struct lens lens;
    struct setup setup;
};

/* Given is_clipped: other surfaces have clear apertures too. False: no image plane, no beam. */
bool image_trial_open(struct trial *trial, double radius, bool is_clipped, struct image_trial *one);

/* Gauss's points and weights of 0..1 by Newton's method on Legendre's polynomials. */
void image_legendre(int count, double *x, double *w);

/* What aiming leaves of a miss, up to 1e-9 of the radius: made up for by the chief's slopes. */
void image_aim_closer(const struct aim *aim, const struct pupil_point *points, size_t count,
                      const struct rays *rays, struct arena *arena);

#endif
