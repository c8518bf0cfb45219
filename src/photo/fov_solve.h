/* photo/fov_solve.h - focal length, distance or sensor from what the picture shall show. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_FOV_SOLVE_H
#define LENSCALC_PHOTO_FOV_SOLVE_H

#include "photo/fov.h"

/* What the picture shall show; NaN = not asked for. Angles rad, lengths mm. */
struct fov_goals {
    double horizontal, vertical, diagonal;            /* full angles of view */
    double field_width, field_height, field_diagonal; /* in the plane of focus */
    double pixel;                                     /* width of one pixel there */
};

/* What a goal is reached by. */
enum fov_unknown { FOV_GIVEN, FOV_FOCAL_LENGTH, FOV_DISTANCE, FOV_SENSOR };

/* A lens on a sensor, of which one thing may be open, and the goals that settle it. */
struct fov_problem {
    struct fov_setting setting; /* f NaN: open; s infinite: open where f and a field are given */
    struct sensor sensor;
    bool sensor_is_open; /* nobody named it: with f, s and a field it is solved for, in its shape */
    struct fov_goals goals;
    enum fov_unknown unknown; /* result */
    const char *by;           /* result: the goal that counts, "field width"; null = all, or none */
};

/*
 * Magnification at which all wanted fields are in the picture.
 *
 * Given     problem  its sensor (checked here), squeeze and goals, of them at least one field
 * Result    m        > 0;  by  the field that counts, "field width"
 * Formula   m = w/W, the least of those of all fields, squeeze x width for the width; pitch/pixel
 * Source    similar triangles
 * Errors    a field or the pitch not above 0; a wanted pixel without a pitch (ERROR_USAGE)
 */
bool fov_goal_magnification(const struct fov_problem *problem, double *m, const char **by,
                            struct error *error);

/*
 * The setting and sensor of a problem, complete.
 *
 * Given     problem  with no goal f is given; with an angle f is open; with fields, of which all
 *                    shall be in the picture, one of f, s and the sensor is open
 * Result    problem  setting, sensor, unknown and by
 * Formula   thin lens, exact up to and beyond 1:1: m = w/W, f = s m/(1 + m) = s w/(W + w),
 *           s = f (1 + 1/m) = f (1 + W/w), w = m W with m = f/(s - f); angles: fov_focal_length
 * Source    1/f = 1/s + 1/v with v = m s
 * Errors    ERROR_USAGE: not exactly one unknown; ERROR_DOMAIN: a field with a fisheye, or without
 *           focal length and finite distance; s not beyond f; as fov_goal_magnification and
 *           fov_focal_length
 * Limits    the usual f W/w for s falls short by f: 1 % at 1:100, half at 1:1. A sensor of which
 *           one side or the diagonal is found keeps its shape
 */
bool fov_solve(struct fov_problem *problem, struct error *error);

/*
 * Focal length and distance for a magnification where the distance is from the sensor.
 *
 * Given     m         > 0;  distance  sensor to subject, mm, > 0
 * Result    f, s      mm
 * Formula   f = D m/(1 + m)^2, s = f (1 + 1/m): D = s + v, v = f (1 + m)
 * Source    [SukHamburg14] f = OO'/(1/b + b + 2)
 * Errors    a number not above 0
 * Limits    a thin lens: its principal planes coincide
 */
bool fov_focal_length_from_sensor(double m, double distance, double *f, double *s,
                                  struct error *error);

#endif
