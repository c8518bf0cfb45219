/* camera/sensor/shutter.h - when a shutter lets a ray pass to the film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_SENSOR_SHUTTER_H
#define LENSCALC_CAMERA_SENSOR_SHUTTER_H

#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>

/*
 * Shutters. To each ray one is open once, for an interval of time; 0 is the middle of the exposure.
 *
 * global   to all rays at once
 * focal    two curtains that run across the film, a small distance before it, one after the other:
 *          between them is the slit
 * leaf     a round hole in the stop that opens from its middle, stays open, and closes again
 * rolling  line after line of the film, each for the whole exposure time
 */
enum shutter_kind { SHUTTER_GLOBAL, SHUTTER_FOCAL, SHUTTER_LEAF, SHUTTER_ROLLING, SHUTTER_KINDS };

/* Where curtains and reading go to in the picture, which stands upright. */
enum shutter_direction { SHUTTER_DOWN, SHUTTER_UP, SHUTTER_RIGHT, SHUTTER_LEFT };

/* The words of the command line for them; end with null. */
extern const struct word shutter_kinds[], shutter_directions[];

struct shutter_question {
    enum shutter_kind kind;
    enum shutter_direction direction; /* of a focal and of a rolling one */
    double time;                      /* T: exposure time, s, above 0 */
    double width, height;             /* of the film, mm */
    double travel; /* of a curtain, or of the reading, from edge to edge of the film, s, above 0 */
    double distance; /* of the curtains before the film, mm, from 0 */
    double overrun;  /* how far beyond the film's edges curtains start and stop, mm, from 0; inf */
    double opening, closing; /* of a leaf shutter, from nothing to its full radius and back, s */
    double stopped;          /* the stop's radius over that, above 0 to 1; of a leaf shutter */
};

struct shutter {
    enum shutter_kind kind;
    double time;             /* s */
    double opening, closing; /* s, of a leaf shutter; else 0 */
    double stopped;          /* the stop's radius over that of a leaf shutter fully open */
    double along[2];         /* unit vector of the film: where curtains and reading go to */
    double per_mm;           /* s a curtain or the reading takes for it; else 0 */
    double extent, run; /* of the film along that; from the middle to where curtains stop, mm */
    double distance;    /* of the curtains before the film, mm */
};

/* What a shutter is asked about a ray. */
struct shutter_ray {
    double film[2];  /* where it meets the film, mm */
    double slope[2]; /* how much x and y grow with a mm towards the lens */
    double stop;     /* how far from the axis it passes the stop, as a share of the radius of the
                        shutter fully open; only of a leaf shutter */
};

/*
 * Make ready.
 *
 * Errors    ERROR_DOMAIN: an exposure time that is not above 0; no travel time, or one of more than
 *           1e8 exposures; distances and times below 0; a leaf shutter that had to close before it
 *           is open: T below (1 - sqrt(1/2)) (opening + closing)
 */
bool shutter_open(const struct shutter_question *question, struct shutter *shutter,
                  struct error *error);

/*
 * From when to when it lets a ray pass.
 *
 * Result    interval  s; both 0: never. Light of a ray is that of the exposure time T times the
 *           length of its interval over T, at times evenly spread over it
 * Formula   global: -T/2 .. T/2
 *           rolling: later by q R/h, q the distance from the middle of the film along the reading,
 *           R the time that this takes over the film's extent h
 *           focal: later by q R/h, q that of the point where the ray passes the plane of the
 *           curtains; the slit, T h/R wide, is as long over each point; never beyond h/2 + overrun,
 *           where curtains at rest lie on each other
 *           leaf: from -T/2 + a (r - sqrt(1/2)) to T/2 - b (r - sqrt(1/2)), a and b opening and
 *           closing time, r where the ray passes the stop: the radius of the hole grows and shrinks
 *           evenly, and half of the light at full opening passes from -T/2 to T/2
 * Source    derived here. That shutters in the lens are timed so: half of the light is half of the
 *           area, sqrt(1/2) of the radius
 * Limits    curtains run evenly, and have no thickness; what the hole of real leaves lacks to a
 *           circle is not counted
 */
void shutter_interval(const struct shutter *shutter, const struct shutter_ray *ray,
                      double interval[2]);

/*
 * From when to when it lets any ray pass.
 *
 * Given     reach  how far from the middle, along their way, rays pass the plane of the curtains at
 *                  most, mm; of other shutters any
 *           span   receives both, s
 */
void shutter_span(const struct shutter *shutter, double reach, double span[2]);

/* How long light comes to a point of the film. */
struct shutter_times {
    double effective; /* full light for so long would be as much, s */
    double total;     /* s */
};

/*
 * Effective and total time, as [IsoShutter19] has them; their ratio is the efficiency.
 *
 * Given     beam  the width of the beam in the plane of the curtains, mm; of others any
 * Formula   leaf: the interval's mean over the stop of radius s, T + (a + b)(sqrt(1/2) - 2 s/3), of
 *           T + (a + b) sqrt(1/2); focal: T of T + beam R/h, so that the efficiency of a slit w is
 *           w/(w + beam), beam = d/N of the distance d
 * Source    [Ives20] (characteristics of the focal-plane shutter); leaf derived here: 2 r dr/s^2
 */
struct shutter_times shutter_times(const struct shutter *shutter, double beam);

#endif
