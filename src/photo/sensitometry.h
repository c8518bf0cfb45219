/* photo/sensitometry.h - light on the film or sensor, and the speeds defined from it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_SENSITOMETRY_H
#define LENSCALC_PHOTO_SENSITOMETRY_H

#include "base/error.h"

/* ISO 12232's q with transmittance 0.9, vignetting 0.98, 10 deg off axis: 0.6516, quoted 0.65. */
#define LENS_Q_STANDARD 0.65

/*
 * The constant q that turns scene luminance into focal-plane exposure.
 *
 * Given     T      lens transmittance, above 0 and up to 1
 *           v      vignetting factor, above 0 and up to 1
 *           theta  angle off axis in object space, rad, 0 up to (not at) pi/2
 * Result    q, at most pi/4
 * Formula   q = (pi/4) T v cos^4 theta
 * Source    ISO 12232:2006; Wikipedia "Film speed"
 * Errors    a number outside its range
 * Limits    cos^4 holds for a thin lens with a stop in it; a real lens may differ either way
 */
bool lens_q(double T, double v, double theta, double *q, struct error *error);

/*
 * Luminous exposure of the film or sensor.
 *
 * Given     q     above 0 and up to pi/4;  L  scene luminance, cd/m^2, > 0
 *           N, t  f-number; exposure time, s; both > 0
 *           loss  further stops lost (filters, extension; not what q holds already), >= LOSS_LEAST
 * Result    H     lx s
 * Formula   H = q L t/N^2 2^-loss
 * Source    ISO 12232:2006; Wikipedia "Film speed"
 * Errors    a number outside its range
 * Limits    aplanat at infinity; for close-ups give 2 log2(1 + m/P) in `loss`
 */
bool focal_plane_exposure(double q, double L, double N, double t, double loss, double *H,
                          struct error *error);

/*
 * Speeds of a sensor from a focal-plane exposure and back.
 *
 * Given     H  lx s, > 0: at saturation, or of the recommended mean exposure; or S ISO speed > 0
 * Result    speed, or exposure in lx s
 * Formula   S_sat = 78/H_sat, REI = 10/H_mean
 * Source    ISO 12232:2006; Wikipedia "Film speed"
 * Errors    none: H and S above 0 are the caller's promise
 * Limits    78 leaves half a stop above white: mean exposure at S lies log2(7.8) = 2.96 stops
 *           below saturation
 */
double saturation_speed(double H);
double saturation_exposure(double S);
double recommended_exposure(double S);

#endif
