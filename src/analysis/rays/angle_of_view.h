/* analysis/rays/angle_of_view.h - what a sensor sees through a real lens, by its exact chief rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_RAYS_ANGLE_OF_VIEW_H
#define LENSCALC_ANALYSIS_RAYS_ANGLE_OF_VIEW_H

#include "analysis/setup/setup.h"
#include "base/arena.h"
#include "base/error.h"
#include "photo/format.h"

/* Lengths in mm; x is the horizontal of the sensor. */
struct view_question {
    const struct setup *setup; /* looked at at its first wavelength */
    double film;               /* the sensor, from the last vertex, > 0 */
    double subject;            /* plane of the subject, from the first vertex, below 0; -inf */
    const struct first_order *first; /* of the lens at that wavelength */
    double squeeze;                  /* of a perfect afocal attachment before the lens; 1 = none */
    struct sensor sensor;
};

/* Across one dimension of the sensor, through its centre. */
struct view_span {
    double angle; /* full, rad; above pi behind a fisheye */
    double size;  /* of what is seen in the plane of the subject, mm; inf for one at infinity, NaN
                     where the rays do not meet it */
    double part;  /* of the dimension that light reaches: 1 = all of it */
};

struct view {
    struct view_span horizontal, vertical, diagonal;
    double circle; /* diameter of the image circle, mm; NaN: it covers the sensor */
    double clear;  /* of the circle within it whose chief rays are not clipped; NaN: none is */
};

/*
 * Angles of view of a lens on a sensor.
 *
 * Formula   from a point of the sensor the ray through the centre of the stop is traced out of the
 *           lens, whose angle with the axis is the field angle t of that point: nothing is searched
 *           for on the object's side, so 90 degrees are nothing special. Newton's method in the
 *           plane of the last vertex, continued from the sensor's centre outwards in steps; the
 *           full angle is that of both ends of the dimension, 2 t for a round lens
 * Result    a point whose chief ray is stopped by a clear aperture still has its angle, as far as
 *           the lens states its field or any of 1280 other rays comes through; from there on the
 *           sensor is dark, and angle and size are those at the edge of the image circle. So too
 *           where the chief ray misses a surface or is totally reflected. A squeeze q turns tan t,
 *           along x, into q tan t
 * Source    derived here; test_angle_of_view.c has the field angles of the thick lenses in
 *           truth/fisheye.json and closed forms, tests/truth/check_fov.py traces the lenses anew
 * Errors    ERROR_DOMAIN: no stop; a sensor not behind the last vertex; no chief ray on the axis;
 *           a squeeze of rays at 90 degrees and more; as system_compile and sensor_check
 * Limits    clear apertures as the lens states them: without a diameter nothing ends the field
 */
bool view_of_lens(const struct view_question *question, struct arena *arena, struct view *view,
                  struct error *error);

#endif
