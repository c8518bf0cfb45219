/* photo/fov.h - field of view of the five projections. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_FOV_H
#define LENSCALC_PHOTO_FOV_H

#include <stdbool.h>

#include "base/error.h"
#include "base/text.h"
#include "photo/format.h"

/* Image height r of the field angle t, both from the axis. */
enum projection {
    RECTILINEAR,   /* f tan t */
    EQUIDISTANT,   /* f t */
    EQUISOLID,     /* 2 f sin(t/2) */
    STEREOGRAPHIC, /* 2 f tan(t/2) */
    ORTHOGRAPHIC,  /* f sin t */
    PROJECTIONS
};

/* The words of the command line for them, indexed by enum projection. */
extern const struct word projections[PROJECTIONS + 1];

/* What the lens does; distances from the front principal plane. */
struct fov_setting {
    enum projection projection;
    double f;       /* focal length, mm, > 0 */
    double s;       /* distance the lens is focused at, mm, > f; may be inf */
    double P;       /* pupil magnification, > 0 */
    double squeeze; /* anamorphic: horizontal field is widened by it, > 0; 1 = none */
};

struct fov {
    double horizontal, vertical, diagonal;         /* full angles, rad */
    double width_at_s, height_at_s, diagonal_at_s; /* field in the plane s, mm; inf at
                                                      infinity, NaN for a fisheye */
    const char *kind;                              /* fov_kind of the diagonal angle */
};

/*
 * Full angle of view across a sensor dimension.
 *
 * Given     projection
 *           scale       f' = f(1 + m/P), mm, > 0: the distance exit pupil to image over P
 *           dimension   full length w on the sensor, mm, > 0
 * Result    angle       rad; below pi for rectilinear, at most 2 pi
 * Formula   r = w/2: 2 atan(r/f'), 2 r/f', 4 asin(r/(2f')), 4 atan(r/(2f')), 2 asin(r/f')
 * Source    The definitions of the projections, solved for the angle
 * Errors    r beyond the edge of the projection: orthographic r > f', equisolid r > 2f',
 *           equidistant r > pi f' (more than a full circle)
 * Limits    The ideal projections; a real lens only comes near to one of them.
 */
bool fov_angle(enum projection projection, double scale, double dimension, double *angle,
               struct error *error);

/*
 * Where a projection images an angle: fov_angle, backwards.
 *
 * Given     angle   from the axis, rad, >= 0
 *           height  receives r/f', 0 on the axis
 * Formula   tan t, t, 2 sin(t/2), 2 tan(t/2), sin t
 * Source    The definitions of the projections
 * Errors    an angle beyond the edge of the projection: 90 deg of the rectilinear and the
 *           orthographic, 180 deg of the others; rectilinear and stereographic end before it
 */
bool fov_height(enum projection projection, double angle, double *height, struct error *error);

/*
 * Angles and field sizes of a lens on a sensor, breathing included.
 *
 * Given     setting, sensor
 * Result    fov
 * Formula   m = f/(s - f), f' = f(1 + m/P); angles by fov_angle, with squeeze x width;
 *           field in the plane s: w/m (rectilinear only)
 * Source    Derived here: the entrance pupil sees the plane s from X = f(1/m + 1/P), and
 *           (w/m)/(2X) = w/(2f'). For a fisheye the same f' is taken: its image is assumed to grow
 *           with focusing as that of a rectilinear lens does near the axis
 * Errors    f, P, squeeze not above 0; s <= f; as sensor_check and fov_angle
 * Limits    Rectilinear is exact for a thin lens with pupils; angles are at the entrance pupil.
 */
bool fov_compute(const struct fov_setting *setting, const struct sensor *sensor, struct fov *fov,
                 struct error *error);

/*
 * Focal length for an angle of view.
 *
 * Given     setting    its projection, s and P
 *           dimension  w on the sensor, mm, > 0 (with squeeze applied, if it is the width)
 *           angle      full angle, rad: below pi (rectilinear), at most pi (orthographic), below
 *                      2 pi (stereographic), at most 2 pi (others)
 *           f          receives the focal length, mm
 * Formula   f' from the projection; then f(1 + f/(P(s - f))) = f', a quadratic whose root below s
 *           is f = 2 P f' s/(b + sqrt(b^2 + 4(1 - P)P f' s)), b = P(s + f'); f = f' at infinity.
 *           Under the root stands P^2(s - f')^2 + 4 P f' s, a sum.
 * Source    Derived here; put back into fov_compute by tests/unit/test_fov.c
 * Errors    an angle out of range; dimension, s or P not above 0
 */
bool fov_focal_length(const struct fov_setting *setting, double dimension, double angle, double *f,
                      struct error *error);

/*
 * Focal length that fits a field of a given width at a distance (rectilinear).
 *
 * Given     dimension  w on the sensor, mm, > 0 (with squeeze applied, if it is the width)
 *           field      its length in the plane s, mm, > 0
 *           s          mm, > 0, finite
 * Formula   m = w/field, f = s m/(1 + m) = s w/(field + w)
 */
bool fov_focal_length_for_field(double dimension, double field, double s, double *f,
                                struct error *error);

/*
 * Scale of the image in the middle of the picture: mm for each radian.
 *
 * Given     setting  complete
 * Formula   f' = f (1 + m/P), m = f/(s - f), of every projection of this file; a pixel of the
 *           pitch p subtends p/f': 206.265 p(um)/f'(mm) arcsec
 * Source    the definitions of the projections
 */
double fov_scale(const struct fov_setting *setting);

/* What a camera above level ground that looks straight down sees of it; lengths in mm. */
struct fov_ground {
    double altitude;      /* of the entrance pupil above the ground */
    double sample;        /* one pixel on the ground, in the middle of the picture */
    double width, height; /* of the ground in the picture; inf from 180 deg on */
};

/*
 * Ground sampling distance and footprint, of a drone or an aeroplane.
 *
 * Given     setting  complete; fov of it;  pitch  of the pixels, mm, > 0, or NaN: not known
 *           ground   one of altitude and sample, mm, > 0, the other NaN
 * Result    ground   complete; sample is NaN without a pitch
 * Formula   sample = pitch altitude/(f (1 + m/P)); width = 2 altitude tan(horizontal/2)
 * Source    similar triangles at the entrance pupil; the first factor is the scale of every
 *           projection of this file in the middle of its picture
 * Errors    ERROR_USAGE: neither or both; an altitude asked for without a pitch; ERROR_DOMAIN: a
 *           number not above 0
 * Limits    level ground, the camera straight down; away from the middle a rectilinear lens keeps
 *           the sample, a fisheye does not
 */
bool fov_ground(const struct fov_setting *setting, const struct fov *fov, double pitch,
                struct fov_ground *ground, struct error *error);

/*
 * What a lens of this full diagonal angle is called.
 *
 * Result    "narrow" < 20 deg, "medium" 20 to 40, "normal" 40 to 60, "wide" 60 to 90,
 *           "ultra-wide" from 90 on
 * Source    Camera Simulation, CS348B lecture 7 (2004); it has no name from 20 to 40: "medium" is
 *           ours, as is the side of the borders (a border belongs to the wider class)
 */
const char *fov_kind(double diagonal);

#endif
