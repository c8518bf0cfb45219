/* photo/motion.h - blur of moving subjects and unsteady cameras. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_MOTION_H
#define LENSCALC_PHOTO_MOTION_H

#include "base/error.h"

/*
 * Magnification of a thin lens focused at a distance.
 *
 * Given     f  focal length, mm, > 0;  s  subject distance from the front principal plane, mm, > f
 * Result    m  positive number, 0 for s = inf
 * Formula   m = f/(s - f)
 * Source    thin lens (lenscalc physics 3)
 * Errors    f not above 0; s not beyond f: no real image
 */
bool motion_magnification(double f, double s, double *m, struct error *error);

/* A moving subject; exactly one of v, t, m and blur is NaN and is solved for. */
struct motion {
    double v;     /* speed of the subject, mm/s, > 0 */
    double t;     /* exposure time, s, > 0 */
    double m;     /* magnification at the start, > 0 */
    double blur;  /* on the sensor, mm, > 0 */
    double angle; /* between direction of motion and the line towards the camera, rad, 0..pi:
                     pi/2 across the view, 0 straight at the camera */
    double s;     /* subject distance, mm, > 0; inf or NaN where motion in depth is not counted */
    double h;     /* image height of the subject, mm, + on the side it moves to; 0 on the axis */
};

/*
 * Blur of a moving subject, and the time, speed or magnification that gives a blur.
 *
 * Given     motion   see there
 * Result    motion   complete; t is inf where the subject never blurs that much
 * Formula   blur = v t (m sin a + h cos a/s)/(1 - v t cos a/s), its absolute value; for motion
 *           across (or s = inf) that is v t m sin a
 * Source    central projection through the lens: image b X/s goes to b (X + v t sin a)/(s - v t
 *           cos a), b = m s. Derived here; unit test against that projection
 * Errors    not exactly one unknown (ERROR_USAGE); numbers outside their ranges; a subject that
 *           reaches the lens within the exposure; a speed or magnification asked for motion that
 *           cannot blur; m asked with h other than 0
 * Limits    constant velocity, shutter open at once; a defocus from motion in depth is not counted
 */
bool motion_solve(struct motion *motion, struct error *error);

/* A camera that turns; exactly one of f, omega, t and blur is NaN and is solved for. */
struct shake {
    double f;     /* focal length, mm, > 0 */
    double omega; /* angular speed about an axis across the view, rad/s, > 0 */
    double t;     /* exposure time, s, > 0 */
    double blur;  /* mm on the sensor at the frame centre, > 0 */
    double m;     /* magnification, >= 0 */
};

/*
 * Blur of a turning camera.
 *
 * Given     shake   see there
 * Result    shake   complete
 * Formula   blur = f (1 + m) omega t
 * Source    lenscalc physics 3: image distance f (1 + m) times the angle
 * Errors    not exactly one unknown (ERROR_USAGE); numbers outside their ranges
 * Limits    small angles: the chord on a flat sensor, 2 f (1+m) tan(omega t/2), is longer by
 *           (omega t)^2/12 (0.1 % at 6.3 deg); turns about the entrance pupil
 */
bool shake_solve(struct shake *shake, struct error *error);

/* A blur in the units people judge it by; NaN where pitch or c is not given. */
struct blur_size {
    double pixels;  /* blur/pitch */
    double circles; /* blur/c */
};

/*
 * Given     blur   mm, >= 0 (may be inf);  pitch  pixel pitch, mm;  c  circle of confusion, mm
 *           (each > 0, or NaN)
 * Result    size
 * Errors    pitch or c not above 0
 */
bool blur_measure(double blur, double pitch, double c, struct blur_size *size, struct error *error);

/* A camera following a subject that moves across. */
struct panning_shot {
    double v;     /* mm/s, > 0 */
    double angle; /* rad, 0..pi, as in struct motion */
    double t;     /* s, > 0 */
    double f, s;  /* mm, s > f */
    double track; /* pan rate as a fraction of the right one; 1 follows exactly, 0 stands still */
};

/* What panning leaves. */
struct panning_blur {
    double rate;       /* angular speed of the right pan, rad/s: v sin a/s */
    double subject;    /* blur left on the subject, mm */
    double background; /* blur of anything that stands still, mm, whatever its distance */
};

/*
 * Panning residual.
 *
 * Given     pan
 * Result    blur
 * Formula   m = f/(s - f); subject = |1 - track| m v t sin a; background = track f (1 + m) (v sin
 *           a/s) t = track m v t sin a
 * Source    shake and motion above: f (1 + m)/s = m
 * Errors    numbers outside their ranges
 * Limits    as shake_solve; the pan turns about the entrance pupil
 */
bool panning_solve(const struct panning_shot *pan, struct panning_blur *blur, struct error *error);

/*
 * The hand-held rule "one over focal length".
 *
 * Given     f      focal length, mm, > 0;  crop  diagonal of 35 mm film by the sensor's, > 0
 *           stops  of the stabiliser (CIPA), 0..20
 * Result    t      longest time, s
 * Formula   t = 2^stops/(crop f), f in mm
 * Source    rule of thumb. With blur = c and m = 0 it allows omega = c crop/1 mm rad/s: 1.7 deg/s
 *           for c = 0.03 mm and crop 1
 * Errors    numbers outside their ranges
 * Limits    hands differ by more than a stop
 */
bool handheld_time(double f, double crop, double stops, double *t, struct error *error);

/* Lean of an upright edge that moves while the rows are read. */
struct rolling_skew {
    double shift; /* mm on the sensor between first and last row */
    double angle; /* rad */
};

/*
 * Rolling shutter.
 *
 * Given     speed    of the image along the rows, mm/s on the sensor, >= 0 (motion: blur/t)
 *           readout  time from first to last row, s, > 0
 *           height   of the sensor across the rows, mm, > 0
 * Result    skew
 * Formula   shift = speed readout, angle = atan(shift/height)
 * Source    definition; toolsforfilm.com: 8192 px/s and 15 ms lean 123 px
 * Errors    numbers outside their ranges
 */
bool rolling_shutter(double speed, double readout, double height, struct rolling_skew *skew,
                     struct error *error);

#endif
