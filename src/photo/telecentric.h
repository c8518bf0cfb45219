/* photo/telecentric.h - depth of field of a telecentric lens. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_TELECENTRIC_H
#define LENSCALC_PHOTO_TELECENTRIC_H

#include "base/error.h"

/*
 * Depth of field of a lens whose magnification does not change with the distance.
 *
 * Given     m        magnification, > 0
 *           fnumber  working f-number, that of the cone at the sensor, > 0
 *           c        circle of confusion on the sensor, mm, > 0
 * Result    depth    from near to far limit, mm, half before and half behind the best focus
 * Formula   2 c N/m^2 = c/(m NA), NA = m/(2 N) that of the cone at the subject
 * Source    [Pomeas23]; similar triangles at the image, depths there m^2 times those here
 * Errors    numbers not above 0
 * Limits    geometric: diffraction blurs the sharpest image already by some N wavelengths
 */
bool telecentric_depth(double m, double fnumber, double c, double *depth, struct error *error);

/* The working f-number of a lens of that numerical aperture at the subject: m/(2 NA). */
double telecentric_fnumber(double m, double na);

#endif
