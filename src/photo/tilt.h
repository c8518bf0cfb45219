/* photo/tilt.h - tilted lens: Scheimpflug, hinge rule, wedge of sharpness, image circle. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_TILT_H
#define LENSCALC_PHOTO_TILT_H

#include <stdbool.h>

#include "base/error.h"

/*
 * Side view, the plane of the tilt. The lens centre is the origin; the sensor is upright at
 * distance v' behind it. u = distance in front of the lens along the sensor normal, y = upward. A
 * positive tilt turns the top of the lens towards the subject and the plane of sharp focus under
 * the lens. A swing is the same seen from above. Every plane of sharpness here is a line A u - B y
 * = f with B = sin(tilt) and A = cos(tilt) - f/v'.
 */

/* What is known; NaN = not given. One of tilt and hinge, one of image, distance and angle. */
struct tilt_given {
    double f;        /* focal length, mm, > 0 */
    double N;        /* f-number, > 0 */
    double c;        /* circle of confusion, mm, >= 0 and below f/N */
    double tilt;     /* tilt of the lens against the sensor, rad, -pi/2 .. pi/2 */
    double hinge;    /* hinge, depth J of the hinge line below the lens, mm, |J| >= f, not 0 */
    double image;    /* image distance, lens to sensor along the sensor normal v', mm, > 0 */
    double distance; /* distance, sharp point straight ahead (along the sensor normal), mm */
    double angle;    /* angle, plane of sharp focus against the sensor plane, psi, rad */
};

/* A tilted camera and its planes. Angles psi are from the sensor plane, sign of the tilt. */
struct tilt {
    double f, N, c;
    double tilt;        /* rad */
    double hinge;       /* J = f/sin(tilt), mm below the lens; +-inf untilted */
    double image;       /* v', mm */
    double distance;    /* sharp point straight ahead, mm; inf if there is none */
    double angle;       /* psi of the plane of sharp focus */
    double near_angle;  /* psi of the near limit */
    double far_angle;   /* psi of the far limit */
    double scheimpflug; /* depth of the Scheimpflug line below the lens, in the sensor plane, mm */
    double hyperfocal;  /* H0 = f^2/(N c), without + f, mm; inf for c = 0 */
    double half_height; /* near and far limit above and below the plane of focus, per unit of u */
    double A, A_near, A_far, B; /* lines A u - B y = f */
};

/* A point of the subject, as seen from the lens. */
struct tilt_point {
    double distance; /* u along the sensor normal, mm, > 0, may be inf */
    double rise;     /* y/u, tangent of the elevation, + above */
};

/* Sharpness along one line of sight; distances u along the sensor normal, mm. */
struct tilt_reach {
    double sharp, near, far; /* inf: the ray meets that plane nowhere in front of the lens */
    double front, behind;    /* sharp - near, far - sharp, without that subtraction */
};

/* What the frame asks of the lens. */
struct tilt_coverage {
    double angle;  /* half angle from the lens axis to the worst corner, rad */
    double circle; /* diameter of the image circle at infinity that holds all corners, mm */
};

/*
 * Solve a tilted camera.
 *
 * Given     see struct tilt_given
 * Formula   J = f/sin(a); tan(psi) = sin a/(cos a - f/v'), so v' = f sin(psi)/sin(psi - a);
 *           straight ahead u = f/(cos a - f/v'). Limits: cot(psi) +- (J/H0)(f/v'), that is f/v'
 *           replaced by (f/v')(1 -+ N c/f) in A: images in the planes v'/(1 -+ N c/f), parallel to
 *           the sensor, therefore through the same hinge line. Lines A u - B y = f stay finite at a
 *           = 0
 * Source    Merklinger, Focusing the View Camera (1993), hinge rule and p. 126; Scheimpflug, GB
 *           patent 1196/1904
 * Errors    ERROR_USAGE: not one of tilt and hinge, or not one of image, distance and angle.
 *           ERROR_DOMAIN: |tilt| of 90 degrees or more; |J| below f; distance within f/cos(a);
 *           angle outside a .. 180 degrees; an angle without tilt; c not below the aperture f/N
 *           Limits thin lens, P = 1. The blur is c measured along the tilt axis (exact there,
 *           test_tilt.c traces it); across it the patch is an ellipse, shorter by about cos(tilt)
 */
bool tilt_solve(const struct tilt_given *given, struct tilt *result, struct error *error);

/*
 * The tilt and image distance that bring two points into focus.
 *
 * Given     f > 0 mm, two points on different lines of sight; one may be at infinity
 * Result    tilt in rad, image v' in mm: what tilt_solve takes
 * Formula   with w = 1/u and t = y/u: sin a = f (w1 - w2)/(t2 - t1), f/v' = cos a - f w1 - t1 sin a
 * Source    two points on the line A u - B y = f of tilt_solve
 * Errors    equal t; |sin a| >= 1; no real image (f/v' not above 0); a distance not above 0
 */
bool tilt_through(double f, const struct tilt_point *first, const struct tilt_point *second,
                  double *tilt, double *image, struct error *error);

/*
 * Near limit, plane of focus and far limit along one line of sight.
 *
 * Given     rise  y/u of the ray through the lens centre; -h/v' for the image height h
 * Formula   u = f/(A - rise B) for each plane; front = f (f/v')(N c/f)/(D Dn), D and Dn the two
 *           denominators
 * Result    all inf where even the near limit is not met: nothing is sharp on that ray
 */
struct tilt_reach tilt_along(const struct tilt *camera, double rise);

/* A frame behind a lens, mm. */
struct tilt_frame {
    double width, height; /* > 0; the height in the plane of the tilt */
    double rise;          /* the lens raised against the frame's middle */
    double shift;         /* the lens moved sideways */
};

/*
 * The image circle that tilt and shift ask for.
 *
 * Given     camera  solved
 * Formula   corner (x, y) on the sensor: tan(angle) = sqrt(x^2 + (y cos a - v' sin a)^2)/
 *           (v' cos a + y sin a), the greatest of the four; circle = 2 f tan(angle)
 * Errors    a corner lies beside or in front of the lens: no circle is large enough
 * Limits    compare with the circle the maker states for infinity (and the f-number in use)
 */
bool tilt_coverage(const struct tilt *camera, const struct tilt_frame *frame,
                   struct tilt_coverage *coverage, struct error *error);

/*
 * How far an untilted lens may be moved along the frame's height (exchange the sides for sideways).
 *
 * Given     camera  its f > 0 and v' >= f
 *           circle  the image circle's diameter at infinity, mm
 *           frame   its width and height
 * Result    sqrt((circle v'/(2 f))^2 - (width/2)^2) - height/2, mm
 * Errors    the circle does not cover the frame
 */
bool tilt_shift_limit(const struct tilt *camera, double circle, const struct tilt_frame *frame,
                      double *limit, struct error *error);

#endif
