/* photo/stars.h - star trails of a camera that stands still. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_STARS_H
#define LENSCALC_PHOTO_STARS_H

#include "base/error.h"

/*
 * Rotation of the Earth against the fixed stars, rad/s: 2 pi in a stellar day of
 * 86164.098903691 s (IERS; Wikipedia "Earth's rotation"). Rounded 7.2921e-5.
 */
#define STELLAR_DAY  86164.098903691
#define STELLAR_RATE 7.292115146706924e-5

/* What an exposure makes of a star at the frame centre. */
struct star_trail {
    double linear;     /* trail on the sensor, mm: first order in time */
    double chord;      /* end to end on the sensor, mm, exact for a rectilinear lens aimed at the
                          star's place at mid-exposure; inf once the star is 90 deg off the axis */
    double arc;        /* length along its circle in the sky, rad */
    double separation; /* great circle between its ends, rad */
    double rotation;   /* angle about the pole, rad: what the arcs of a trail picture span */
};

/*
 * Trail of a star.
 *
 * Given     f    focal length, mm, > 0
 *           dec  declination of the frame centre, rad, -pi/2..pi/2 (at the pole a trail is 0)
 *           t    exposure time, s, above 0 and up to STELLAR_DAY
 * Result    trail
 * Formula   w = STELLAR_RATE, q = w t/2: linear = f w t cos dec; chord = 2 f cos dec sin q/(1 -
 *           2 cos^2 dec sin^2(q/2)); arc = w t cos dec; separation = 2 asin(cos dec sin q)
 * Source    gnomonic projection (Snyder, Map Projections, USGS PP 1395, eq. 22-4) at hour angles
 *           -q and +q; both ends have the same y, so the chord is the difference in x. At dec = 0:
 *           2 f tan q
 * Errors    numbers outside their ranges
 * Limits    focused at infinity, no refraction of the air; the path bends between its ends off
 *           the equator; towards the frame's edge trails differ (star_trail_worst)
 */
bool star_trail(double f, double dec, double t, struct star_trail *trail, struct error *error);

/*
 * Longest trail anywhere in the frame of a rectilinear lens, however the camera is turned.
 *
 * Given     f, dec, t      as star_trail
 *           half_diagonal  of the sensor, mm, >= 0
 * Result    worst          mm; not below `linear`
 * Formula   with c = cos |dec|, s = sin |dec|, R = half_diagonal/f, k = cosine of the angle between
 *           a point at the distance R and the direction to the equator, the speed of the image is
 *           f w sqrt(c^2 (1 + R^2)^2 + R^2 s^2 + 2 s c R k - c^2 R^2 (2 + R^2) k^2), greatest at
 *           k = s/(c R (2 + R^2)), or at 1: f w (c + s R)
 * Source    derived here: the velocity p x d of a direction d about the pole p, in the gnomonic
 *           projection; it grows outwards, so that a corner has it. test_stars.c turns the sky
 * Errors    numbers outside their ranges
 * Limits    to first order in time; a corner that points elsewhere has a shorter one
 */
bool star_trail_worst(double f, double dec, double t, double half_diagonal, double *worst,
                      struct error *error);

/* Longest exposure for a trail. */
struct star_time {
    double linear; /* s, from the linear trail */
    double exact;  /* s, from the chord; inf where the star's whole circle stays within it */
};

/*
 * Longest exposure time that keeps a trail within a length.
 *
 * Given     f, dec   as star_trail, but the pole is refused
 *           allowed  trail on the sensor, mm, > 0 (pixels times pitch, or c)
 * Result    time
 * Formula   linear = a/(f w cos dec); exact = 4 atan(u)/w, u = a/(2 g + sqrt(4 g^2 + a^2 cos 2
 *           dec)), g = f cos dec
 * Source    inverse of the chord with u = tan(w t/4); the form without cancellation
 * Errors    numbers outside their ranges; |dec| = 90 deg: a star at the pole does not move
 */
bool star_time(double f, double dec, double allowed, struct star_time *time, struct error *error);

/*
 * Longest focal length that keeps a trail within a length.
 *
 * Given     dec, t, allowed   as above; the pole is refused
 * Result    f                 mm, from the exact chord
 * Formula   f = a/(chord per mm of focal length)
 * Source    star_trail
 * Errors    as star_time
 */
bool star_focal_length(double dec, double t, double allowed, double *f, struct error *error);

/*
 * The rule "500 over focal length".
 *
 * Given     constant  s mm, > 0: 500; 600, 400 and 300 are about
 *           f         focal length, mm, > 0;  crop  diagonal of 35 mm film by the sensor's, > 0
 * Result    t         s
 * Formula   t = constant/(crop f)
 * Source    rule of thumb from film; as told in F. Michaud's announcement of the NPF rule
 *           (cloudynights.com/topic/533329)
 * Errors    numbers outside their ranges
 * Limits    on the equator the star trails constant w/crop mm: 0.036 mm for 500 and crop 1,
 *           several pixels of any digital camera
 */
bool star_rule_time(double constant, double f, double crop, double *t, struct error *error);

/*
 * The NPF rule of Frederic Michaud, simplified.
 *
 * Given     f      focal length, mm, > 0 (the real one, no crop factor)
 *           N      f-number, > 0;  pitch  pixel pitch, mm, > 0
 * Result    t      s
 * Formula   t = (35 N + 30 p)/f with p in um
 * Source    F. Michaud, Societe Astronomique du Havre, "Regle NPF", sahavre.fr/wp/regle-npf-rule
 *           (as given by github.com/itwars/astro-exposure-time)
 * Errors    numbers outside their ranges
 */
bool npf_simple_time(double f, double N, double pitch, double *t, struct error *error);

/*
 * The NPF rule in full.
 *
 * Given     f, N, pitch   as npf_simple_time
 *           dec           declination, rad; the pole is refused
 *           k             accuracy, > 0: 1 points, 2 slightly drawn out, 3 drawn out
 * Result    t             s
 * Formula   t = k (16.9 N + 0.10 f + 13.7 p)/(f cos dec), p in um: diffraction, seeing, pixel
 * Source    as npf_simple_time; 13.7 p/(f cos dec) is the time a star takes over one pixel
 * Errors    numbers outside their ranges; |dec| = 90 deg
 */
bool npf_full_time(double f, double N, double pitch, double dec, double k, double *t,
                   struct error *error);

/*
 * Michaud's "4 - crop" rule, for a head without calculator.
 *
 * Given     f  focal length, mm, > 0;  crop  above 0 and below 4
 * Result    t  s
 * Formula   t = 100 (4 - crop)/f: 300/f for 35 mm, 250/f for crop 1.5, 200/f for Micro 4/3
 * Source    F. Michaud (Fred_76), webastro.net/forums/topic/186159
 * Errors    numbers outside their ranges
 */
bool four_minus_crop_time(double f, double crop, double *t, struct error *error);

#endif
