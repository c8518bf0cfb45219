/* photo/stops.h - light lost on the way to the film, in stops; shutter angles. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_STOPS_H
#define LENSCALC_PHOTO_STOPS_H

#include "base/error.h"

/*
 * Conversions between the ways a light loss is written.
 *
 * Given     D optical density (ND 0.9), F filter factor (ND8), transmittance above 0 and up to 1
 * Result    stops of loss; 0 is no loss
 * Formula   stops = log2 F = -log2 transmittance = D/log10 2
 * Source    density D = -log10 transmittance by definition (ISO 5-1)
 * Errors    none: the caller has checked the ranges (light_loss does)
 * Limits    trade labels are rounded: ND 3.0 is 9.966 stops, sold as "10 stops" and "ND1000"
 */
double stops_from_density(double D);
double stops_from_factor(double F);
double stops_from_transmittance(double transmittance);

/* Glass passes 1 at most; real rays may bring a little more than the f-number says they do. */
#define TRANSMITTANCE_MOST 1.25
#define LOSS_LEAST         (-0.322) /* stops: that one */

/* Refuse one outside of 0 to TRANSMITTANCE_MOST, 0 too. */
bool check_transmittance(double transmittance, struct error *error);

/*
 * T-stop of a lens, and its transmittance from both markings.
 *
 * Given     N f-number > 0, transmittance above 0 and up to TRANSMITTANCE_MOST; T T-stop >= N
 * Result    T-stop (pure number); transmittance
 * Formula   T = N/sqrt(transmittance)
 * Source    ISO 517; Wikipedia "F-number", T-stop: f/2.0 at 75 % is T 2.309
 * Errors    T below N: more light than enters; a transmittance outside that
 */
bool t_stop(double N, double transmittance, double *T, struct error *error);
bool transmittance_from_t_stop(double N, double T, double *transmittance, struct error *error);

/* Everything between the scene and the film; NaN where there is none of it. */
struct light_loss {
    double density;       /* ND filter as density, >= 0 */
    double factor;        /* filter factor, >= 1; factors of several filters multiplied */
    double stops;         /* loss in stops, >= 0 */
    double transmittance; /* of the lens, above 0 and up to TRANSMITTANCE_MOST */
    double m, P;          /* magnification >= 0 and pupil magnification > 0 (NaN: 1) */
};

/*
 * Sum of all losses.
 *
 * Given     loss    any of its members, the others NaN
 * Result    stops   >= 0, to open up or lengthen by
 * Formula   D/log10 2 + log2 F + stops - log2 transmittance + 2 log2(1 + m/P)
 * Source    the definitions above; densities and stops add because factors multiply
 * Errors    a member outside its range
 */
bool light_loss(const struct light_loss *loss, double *stops, struct error *error);

/* A rotating-disc shutter; exactly one member is NaN and is solved for. */
struct shutter {
    double angle; /* rad, above 0 and up to 2 pi */
    double rate;  /* frames per second, > 0 */
    double t;     /* exposure time, s, above 0 and up to 1/rate */
};

/*
 * Shutter angle, frame rate and exposure time, each from the other two.
 *
 * Given     shutter  two members, the third NaN
 * Result    the third is filled in
 * Formula   t = angle/(2 pi rate)
 * Source    definition; 180 deg at 24 fps is 1/48 s, 172.8 deg is 1/50 s (provideocoalition.com)
 * Errors    not exactly one unknown (ERROR_USAGE); an angle over 360 deg, given or solved: the
 *           exposure would be longer than the frame
 */
bool shutter_solve(struct shutter *shutter, struct error *error);

#endif
