/* analysis/image/psf_energy.h - encircled and ensquared energy by diffraction. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_PSF_ENERGY_H
#define LENSCALC_ANALYSIS_IMAGE_PSF_ENERGY_H

#include "analysis/image/psf.h"

#include <stdbool.h>
#include <stddef.h>

struct psf_energy_question {
    struct bundle_question bundle; /* its wavelength, pattern and weight are not used */
    double farthest;               /* the largest radius that is asked for, mm; NaN: as is usual */
    bool about_chief;              /* the circles, else about the centroid of all light */
    bool has_limit;                /* that of a perfect wave front is wanted too */
    int threads;
};

/* Images of a point, of which energies are found. Of an image infinitely far away mm are sines. */
struct psf_energy_image {
    struct psf psf, perfect; /* perfect: of the same pupil with W = 0; no values: not wanted */
    double centre[2];        /* of the circles, mm from the chief ray */
    double off[2];           /* how far the centroid of all light may be from there, mm */
    double usual;            /* a radius that holds most of the light, mm */
};

struct psf_energy {
    double encircled, ensquared; /* shares of all light: NaN where they leave the image */
    double limit;                /* encircled by a perfect wave front, about the chief ray */
    double error;                /* of the first two */
};

/*
 * Images fine and wide enough.
 *
 * Result    usual is the spread of the rays and 8 of the resolved lengths, the wavelength over the
 *           width of the cone of light, more; the image reaches so far, or as far as was asked,
 *           and 0.4 of the spread farther about a centroid. Pixels are a quarter of a resolved
 *           length, or 0.45 of it where that would be over 160 pixels a side
 * Errors    as psf_find; ERROR_DOMAIN: PSF_SIZE_MOST pixels do not reach so far
 */
bool psf_energy_open(const struct psf_energy_question *question, struct arena *arena,
                     struct psf_energy_image *image, struct error *error);

/*
 * The shares of all light within circles, and within squares about them.
 *
 * Given     radii   of the circles, half the sides of the squares, mm, >= 0, ascending
 *           shares  receives `count`
 * Formula   the light between pixels by polynomials through eight of them each way, as in
 *           psf_radius_find; over a circle by Gauss's points of the radius, two a pixel, and equal
 *           steps of the angle, more of them than twice the waves around it; over a square by
 *           Gauss's points in each pixel, row by row. The light of all is that of the pupil
 * Source    [BornWolf99] 8.5.2: 1 - J0(v)^2 - J1(v)^2 of a clear circle; a test has it, the
 *           integral of an obscured circle's image, and that of a defocused one
 * Limits    the error is what polynomials through four pixels change, 1e-5 for the sums, and what
 *           another centroid changes, which light beyond the pixels may move
 */
void psf_energy_find(const struct psf_energy_image *image, const double *radii, size_t count,
                     struct psf_energy *shares, struct arena *arena);

#endif
