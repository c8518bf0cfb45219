/* analysis/image/psf.h - diffraction point spread functions. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_PSF_H
#define LENSCALC_ANALYSIS_IMAGE_PSF_H

#include "analysis/waves/exit_lines.h"

#include <stdbool.h>
#include <stddef.h>

enum psf_method {
    PSF_AUTO,    /* PSF_PLANE, or PSF_RAYS where the phase turns too often for it */
    PSF_PLANE,   /* plane waves, over points of Gauss between the edges of the pupil */
    PSF_FFT,     /* the same over a grid, by a fast Fourier transform */
    PSF_HUYGENS, /* spherical wavelets from the reference sphere, over Gauss's points */
    PSF_RAYS,    /* where rays meet the image, as if light had no wavelength */
    PSF_METHODS
};

/* PSF_TURNS_MOST: of the phase across the pupil, that sums of waves take */
enum { PSF_SIZE_MOST = 2048, PSF_TRANSFORM_MOST = 4096, PSF_TURNS_MOST = 600 };

struct psf_question {
    struct bundle_question bundle; /* its wavelength, pattern and weight are not used */
    enum psf_method method;
    size_t size; /* pixels along a side */
    int threads; /* that wavelets may take; 0 is 1 */
    /* mm, or of an image infinitely far away the sine of an angle; NaN: a quarter of what the waves
       resolve, more where rays spread farther; by rays what has room for all of them */
    double pitch;
    bool is_perfect; /* of the same pupil with W = 0, by PSF_PLANE */
};

/*
 * The image of a point; pixel i of a row lies at (i - size/2) pitch from the chief ray. Of an image
 * infinitely far away all mm are sines of angles from it, along spot_axes.
 */
struct psf {
    bool is_angular;
    size_t size;
    double pitch;             /* mm */
    const double *values;     /* size * size, rows from below; 1: the peak of a perfect image */
    double peak, peak_at[2];  /* the highest of a parabola through it; mm from the chief ray */
    double centroid[2];       /* of the pixels, mm from the chief ray */
    double centroid_error[2]; /* from there to that of all light at most, mm */
    double width[2];          /* at half the peak, through it along x and y, mm; NaN: not inside */
    double finest;            /* above it pixels miss light between them, mm: NaN of the next */
    double spread;            /* of rays from the chief ray, along x or y, at most, mm */
    double inside;            /* share of all light that the pixels have */
    double radius80, radius80_error; /* about the centroid, with 80 % of all light, psf_radius_find;
                                        NaN: the circle is not inside, or pixels are coarse */
    struct pupil_islands islands;
    enum psf_method method; /* not PSF_AUTO */
    double turns; /* of the phase across the pupil at the edge of the image, for which it is
                     PSF_RAYS; 0: that was asked for, or it is not */
};

/*
 * Find it.
 *
 * Formula   E = integral of A exp(2 pi i (W - n (a x + b y)/wavelength)) da db over the pupil; of
 *           wavelets with the way from the points of the sphere in place of the plane wave. The
 *           light |E|^2/wavelength^2 of all wavelengths by their weights, over that of W = 0 at
 *           the reference. A transform takes the means over cells of a grid, 128 across the pupil
 *           or what the slope of the wave front and the spread of its rays want, and undoes what
 *           they leave of the waves; sums take Gauss's points, see psf_points_put. By rays the
 *           light of a pixel is that of the rays which meet it, over the same perfect peak: what
 *           interferes is lost, and the peak is a mean over a pixel
 * Source    [Goodman05] 5.2, [Hopkins55], [GreengardLee04]
 * Errors    as exit_pupils_open; ERROR_DOMAIN: pixels too coarse for the transform, a wave front
 *           too steep for PSF_TRANSFORM_MOST or psf_points_fit, wavelets without a sphere, rays
 *           of an image infinitely far away
 */
bool psf_find(const struct psf_question *question, struct arena *arena, struct psf *psf,
              struct error *error);

/*
 * What the waves resolve and how far rays spread, before an image is laid out: finest and spread,
 * and is_angular; the rest is of no use. Errors as psf_find by PSF_PLANE.
 */
bool psf_look(const struct bundle_question *bundle, struct arena *arena, struct psf *psf,
              struct error *error);

#endif
