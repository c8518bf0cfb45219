/* analysis/rays/spot.h - spot diagrams: sizes, energy radii, rays on the image plane. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_SPOT_H
#define LENSCALC_ANALYSIS_RAYS_SPOT_H

#include "analysis/pupil/bundle.h"
#include "trace/pupil/pupil_islands.h"

#include <stdbool.h>
#include <stddef.h>

/* What is asked: all wavelengths of the setup by their weights, as one spot. */
struct spot_question {
    struct bundle_question bundle; /* its wavelength is not used */
    size_t rays;                   /* of each wavelength; 0: doubled until `error` is met */
    double error;                  /* relative to the root mean square */
    size_t to;                     /* the place behind the surface looked at; 0: the last */
    bool about_chief;              /* radius and energy radius, else about the centroid */
    bool no_radius;                /* the largest distance is not wanted: NaN */
    double energy;                 /* the share of `energy_radius`; NaN: none is wanted */
};

/* Lengths in mm. Without an image plane: sines of angles from the chief ray, `is_angular`. */
struct spot {
    bool is_angular;
    double rms, rms_x, rms_y;     /* about the centroid */
    double rms_chief;             /* about the chief ray; NaN: it is lost */
    double radius, radius_error;  /* the largest distance from the centroid */
    double energy_radius;         /* about the centroid; NaN: not asked for */
    double error, energy_error;   /* of rms and energy_radius */
    double centroid[2], chief[2]; /* on the plane, or angular from the chief ray */
    double clear;                 /* share of the pupil's area, mean of the wavelengths */
    size_t rays;                  /* of one wavelength, those of `rms` */
    struct pupil_islands islands; /* light that it leaves out, of the first wavelength */
    bool has_converged;           /* false: `error` was wanted smaller */
};

/*
 * The spot of a field.
 *
 * Formula   weights of a wavelength times those of the rays. One chief ray for all: that of the
 *           first wavelength. Means about the chief ray first, so that no digits are lost far off
 *           the axis. `error`: thrice the difference from a sample with twice the rays, at least
 *           rounding. The energy radius, the weighted quantile of distances, is that of twice
 *           the rays, unless their number is asked for; its error is the largest of six times what
 *           the last doubling changes, three times the change before and 1.5 times the one before
 *           Largest distance: spot_radius_find; of other patterns than PATTERN_GAUSS that of their
 *           rays. Its error: of the search, and what twice the rays move the centroid
 *           Angular: components of the direction along two axes across that of the chief ray, the
 *           first in the plane of x
 * Source    weights [Forbes88]; tested against an independent 50-digit program
 * Errors    as bundle_open and bundle_trace; ERROR_DOMAIN: about a chief ray that is lost
 * Limits    2^17 rays of a wavelength; what has not converged then says so
 */
bool spot_find(const struct spot_question *question, struct arena *arena, struct spot *spot,
               struct error *error);

/* Where rays meet the plane, about the chief ray: what a spot diagram shows. */
struct spot_points {
    size_t count;
    const double (*at)[2]; /* mm, or sines of angles */
};

/*
 * The points of about so many rays at one wavelength, evenly spread over the pupil.
 *
 * Given     wavelength  its place in the setup; points are about the chief ray of the first one
 * Errors    as spot_find
 */
bool spot_points_find(const struct spot_question *question, size_t wavelength, size_t rays,
                      struct arena *arena, struct spot_points *points, struct error *error);

/* Two unit vectors across a direction, the first in the plane of x: those that angles lie along. */
void spot_axes(const double direction[3], double across[2][3]);

#endif
