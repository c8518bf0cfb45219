/* analysis/image/psf_light.h - the light of one wavelength over the pixels of an image. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_PSF_LIGHT_H
#define LENSCALC_ANALYSIS_IMAGE_PSF_LIGHT_H

#include "analysis/image/psf.h"

/* Pixels at work; mm, or of an image infinitely far away sines of angles. */
struct psf_plane {
    const struct exit_pupil *pupil;
    size_t size;
    double pitch;
    double spread;    /* of rays from the reference, at most: the slope of the wave front */
    const char *unit; /* of a thousandth of that, for messages */
    double *re, *im;  /* size * size, 0 at first; receive the amplitude, scaled by the pitch */
    double perfect;   /* receives the amplitude of W = 0 at the reference */
    int threads;      /* that may work on it, for wavelets */
    struct arena *arena;
};

/* The ways of it. Errors as psf_find. */
typedef bool psf_way(struct psf_plane *plane, struct error *error);
psf_way psf_by_plane, psf_by_fft, psf_by_huygens;

#endif
