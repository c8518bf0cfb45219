/* photo/survey.h - pictures of a survey from the air: overlaps, intervals, motion blur. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_SURVEY_H
#define LENSCALC_PHOTO_SURVEY_H

#include "base/error.h"

/* What a flight is planned from; lengths in mm on the ground, NaN = not given. */
struct survey_flight {
    double along, across;    /* the ground in a picture along the track and across it, > 0; NaN */
    double sample;           /* ground sampling distance, > 0; NaN: pixels are not known */
    double overlap, sidelap; /* parts of a picture that the next and the next line have too, 0..1 */
    double speed;            /* mm/s, > 0 */
    double interval;         /* s between two pictures, > 0; not both it and the speed */
    double blur;             /* pixels that the ground may move in an exposure, > 0 */
    double time;             /* exposure time, s, > 0 */
};

/* What comes of it; NaN where what it takes is not given. */
struct survey_plan {
    double base;     /* from one picture to the next, mm */
    double spacing;  /* from line to line, mm */
    double speed;    /* mm/s */
    double interval; /* s */
    double longest;  /* exposure time, s, with no more than that blur */
    double moved;    /* pixels in the given time */
};

/*
 * Plan of a flight over level ground.
 *
 * Given     flight
 * Result    plan
 * Formula   base = along (1 - overlap), spacing = across (1 - sidelap), base = speed interval,
 *           longest = blur sample/speed, moved = speed time/sample; without speed and interval
 *           the speed at which the time is the longest
 * Source    definitions of forward overlap and sidelap; similar triangles
 * Errors    ERROR_USAGE: speed and interval, an interval without an overlap; ERROR_DOMAIN: a number
 *           out of range
 * Limits    level ground below the camera: on a hill overlaps are less
 */
bool survey_solve(const struct survey_flight *flight, struct survey_plan *plan,
                  struct error *error);

#endif
