/* analysis/image/psf_points.h - points of an exit pupil that waves are added up from. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_IMAGE_PSF_POINTS_H
#define LENSCALC_ANALYSIS_IMAGE_PSF_POINTS_H

#include "analysis/image/psf_light.h"

/* Points of the pupil, line by line. */
struct psf_points {
    double (*at)[2];            /* direction cosines; a line has one of the second */
    double *waves, *amplitudes; /* W, wavelengths; times what each counts */
    size_t *ends;               /* behind each line */
    size_t lines, count;
    double total; /* of the amplitudes */
};

/* How often the phase turns across the pupil at the edge of the image. */
double psf_points_turns(const struct psf_plane *plane);

/* Does the phase turn as rarely as sums take? Errors: ERROR_DOMAIN: it does not, and what would. */
bool psf_points_fit(const struct psf_plane *plane, struct error *error);

/*
 * Gauss's points between the edges of the pupil, along lines, and over the angle that
 * struct exit_piece has from one line to the next.
 *
 * Formula   exp(i k x) over -1..1 is a polynomial of degree k and some more, which half as many
 *           points integrate: pi/2 = 1.6 a turn along a line. Of exp(i k sin u) over a half turn
 *           of u the slope is pi/2 times that in the middle: 2.5 a turn. Some more of both leave
 *           1e-8 of the peak, of 2 to 300 turns
 * Errors    as psf_points_fit
 */
bool psf_points_put(const struct psf_plane *plane, struct psf_points *points, struct error *error);

#endif
