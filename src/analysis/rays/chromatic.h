/* analysis/rays/chromatic.h - colour of a lens: its foci and chief rays by wavelength. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_CHROMATIC_H
#define LENSCALC_ANALYSIS_RAYS_CHROMATIC_H

#include "analysis/setup/setup.h"

#include <stdbool.h>

/* Where light of one wavelength meets on the axis. */
struct chromatic_focus {
    double image;    /* from the last vertex, mm; infinite where it is parallel */
    double vergence; /* n'/image, 1/mm: 0 where it is parallel, positive where it converges */
    enum ray_status status; /* other than RAY_OK: a real ray is lost, and there are no numbers */
};

/*
 * The paraxial focus.
 *
 * Given     wavelength  um
 * Formula   [a b; c d] of the lens, x = s/n to the object: y = a x + b, v = c x + d (a, c for a
 *           distant one); image -n' y/v, vergence -v/y
 * Source    [Smith05]
 * Errors    as paraxial_compile
 * Limits    in pairs: exact to an ulp, so that differences keep their digits
 */
bool chromatic_focus(const struct setup *setup, double wavelength, struct chromatic_focus *focus,
                     struct error *error);

/* Longitudinal colour, from three foci. */
struct chromatic_axial {
    double primary;   /* image of the shortest - image of the longest wavelength, mm */
    double secondary; /* mean of those two - image of the one in between, mm */
};

/*
 * Axial colour and secondary spectrum.
 *
 * Given     middle  may be the same object as one of the ends: there is no secondary spectrum
 * Result    NaN where an image is at infinity, and what is not there
 * Formula   primary = z(short) - z(long), secondary = (z(short) + z(long))/2 - z(middle): negative
 *           and positive of a simple and of an achromatic converging lens
 */
struct chromatic_axial chromatic_axial(const struct chromatic_focus *shortest,
                                       const struct chromatic_focus *middle,
                                       const struct chromatic_focus *longest);

/*
 * The focus of a real ray through a zone of the pupil: spherical aberration by wavelength.
 *
 * Given     wavelength  um
 *           zone        height of the ray in the y-z plane over the pupil's radius; 0: paraxial
 *           entrance    in the paraxial entrance pupil of the primary wavelength, not in the stop
 * Result    where the ray crosses the axis
 * Formula   of a ray that crosses the plane of the last vertex at h with the slope t: image -h/t,
 *           vergence -n' t/h
 * Errors    as aim_open, aim_at_entrance, system_compile
 */
bool chromatic_zone(const struct setup *setup, double wavelength, double zone, bool entrance,
                    struct chromatic_focus *focus, struct error *error);

/* Where a chief ray meets the image plane; and, of an image at infinity, its direction. */
struct chromatic_chief {
    double height[2]; /* x, y, mm; NaN without an image plane */
    double slope[2];  /* dx/dz, dy/dz */
    enum ray_status status;
};

/*
 * The chief ray of a field point at a wavelength: through the centre of the stop.
 *
 * Given     setup  its image plane placed, or none
 * Result    status other than RAY_OK: no numbers
 * Errors    as setup_beam and aim_open, where no chief ray is found
 */
bool chromatic_chief(const struct setup *setup, const struct field_point *field, double wavelength,
                     struct chromatic_chief *chief, struct error *error);

/* How much higher one chief ray arrives than another. */
struct chromatic_lateral {
    double height; /* mm; NaN without an image plane */
    double angle;  /* rad */
};

/*
 * Lateral colour: how much higher one chief ray arrives than the other.
 *
 * Given     primary, other  of one field point
 *           along           unit: the direction in which heights count
 * Result    what lies across that is left out. NaN where one of them is lost
 * Formula   of slopes t, t': angle atan((t' - t)/(1 + t t')), which keeps its digits
 */
struct chromatic_lateral chromatic_lateral(const struct chromatic_chief *primary,
                                           const struct chromatic_chief *other,
                                           const double along[2]);

#endif
