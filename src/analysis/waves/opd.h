/* analysis/waves/opd.h - the reference sphere of an image point and optical path differences to it. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_OPD_H
#define LENSCALC_ANALYSIS_WAVES_OPD_H

#include "base/error.h"
#include "trace/kernel/rays.h"

#include <stdbool.h>

/* What the wave front of an image point is compared with. */
struct opd_reference {
    double n;         /* index of the image space, > 0 */
    double centre[3]; /* of the sphere; of a plane a point of it. mm, in the frame rays end in */
    double normal[3]; /* of a plane: the way of the chief ray, unit length; of a sphere 0 0 0 */
    double radius;    /* mm; infinite: a pupil infinitely far away; of a plane not used */
    double pupil[3];  /* from the centre to the chief ray's crossing of the pupil, mm; 0 0 0 where
                         that lies infinitely far away, and of a plane */
    double side;      /* +1: light meets the sphere before its centre; -1: behind it */
    bool is_plane;    /* the image lies infinitely far away */
    double plane_way; /* from the chief ray's last point along it to the plane, mm */
};

/*
 * The sphere about an image point, through the chief ray's crossing of the exit pupil.
 *
 * Given     chief   the chief ray where it meets the image plane (a system with SETUP_IMAGE)
 *           pupil   z of the paraxial exit pupil in the frame of the image plane, mm; infinite or
 *                   NaN: it lies infinitely far away, and the sphere's radius is infinite
 *           n       index of the image space
 *           centre  of the sphere, in the same frame; null: where the chief ray is
 * Errors    ERROR_DOMAIN: the chief ray is lost, or crosses the pupil at the centre
 */
bool opd_sphere(const struct ray *chief, double pupil, double n, const double centre[3],
                struct opd_reference *reference, struct error *error);

/*
 * The plane wave of an image infinitely far away: across the chief ray, where it crosses the exit
 * pupil.
 *
 * Given     chief  behind the last surface
 *           pupil  z of the exit pupil in the frame of the ray; infinite or NaN: the plane goes
 *                  through the ray's last point
 * Errors    ERROR_DOMAIN: the chief ray is lost
 */
bool opd_plane(const struct ray *chief, double pupil, double n, struct opd_reference *reference,
               struct error *error);

/*
 * The optical path of a ray to the reference, less the same constant for all rays: the wave front
 * aberration is W = opd_path(chief) - opd_path(ray), positive where the wave front is ahead of
 * the reference.
 *
 * Given     ray     at the place where the chief ray was, with its path
 * Result    mm; NaN: the ray is lost (a clipped one is not) or misses the sphere
 * Formula   with D from the centre to the ray, e its direction and q = |D x e|^2, the sphere lies
 *           t = -D.e - s sqrt(R^2 - q) along the ray; R is left out:
 *           path = P - n (D.e - s q/(R + sqrt(R^2 - q))), which keeps its digits however large R
 *           is, and holds for an infinite one. A plane with the normal d through the chief ray's
 *           point A + w d: t = ((A - X).d + w |d - e|^2/2)/(d.e), less w
 * Source    [Welford86] chapter "Optical aberrations"; the forms without cancellation are derived
 *           here, and tested against a program of 50 digits
 * Limits    the rounding of the paths themselves: 1e-13 mm of a way of 200 mm
 */
double opd_path(const struct opd_reference *reference, const struct ray *ray);

/*
 * How opd_path of a ray changes with the centre of the sphere, which goes on through the chief
 * ray's crossing of the pupil.
 *
 * Given     reference  a sphere
 * Result    by the three coordinates of the centre; NaN as opd_path
 * Formula   with T from the centre to the crossing, R = |T| and S = sqrt(R^2 - q), in the symbols
 *           of opd_path: n e + n s (T q/(R S (R + S)) + ((D.e) e - D)/S); n e for an infinite R.
 *           Derived here; a test takes differences of opd_path
 */
void opd_path_by_centre(const struct opd_reference *reference, const struct ray *ray,
                        double slope[3]);

#endif
