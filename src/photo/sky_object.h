/* photo/sky_object.h - how large things in the sky are, and their images. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_SKY_OBJECT_H
#define LENSCALC_PHOTO_SKY_OBJECT_H

#include "photo/fov.h"

/* The words of the command line for them; the first is for none. */
extern const struct word sky_objects[];

/*
 * Apparent diameter of an object in the sky, along its longer axis.
 *
 * Given     object  its place in sky_objects, from 1 on
 * Result    rad
 * Formula   sun, moon and planets: 2 asin(R/d), R the equatorial radius; d the mean distance of sun
 *           and moon, of a planet the difference of its mean distance from the Sun and the Earth's
 * Source    [NSSDC] for R and d; deep-sky objects: the sizes of [Frommert] in arcmin
 * Limits    the moon varies by 7 % about its mean, the sun by 1.7 %, Mars at its oppositions from
 *           14 to 25 arcsec; galaxies, nebulae and clusters have no edge, and photographs show more
 *           of them: M13 has 20 arcmin in [Frommert] and on star charts, 10 to 23 in other lists
 */
double sky_angle(int object);

/*
 * Distance at which something of a size subtends an angle, and the angle from a distance.
 *
 * Given     size, distance  mm, > 0, across the line of sight;  angle  rad, > 0, below pi
 * Formula   d = size/(2 tan(angle/2));  angle = 2 atan(size/(2 d))
 * Source    similar triangles
 */
double sky_distance(double size, double angle);
double sky_subtended(double size, double distance);

/*
 * Length of the image of something that subtends an angle, in the middle of the picture.
 *
 * Given     setting  complete;  angle  rad, > 0
 * Result    image    mm
 * Formula   2 f' h(angle/2), f' = f(1 + m/P), h of fov_height
 * Source    the definitions of the projections
 * Errors    as fov_height
 */
bool sky_image(const struct fov_setting *setting, double angle, double *image, struct error *error);

#endif
