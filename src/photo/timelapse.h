/* photo/timelapse.h - plan of a time-lapse or of star trails: shots, interval, clip, storage. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_TIMELAPSE_H
#define LENSCALC_PHOTO_TIMELAPSE_H

#include <stdbool.h>

#include "base/error.h"

/* Frames a second of a clip where neither it nor what it follows from is given. */
#define TIMELAPSE_RATE 24

/* The most shots a plan may have. */
#define TIMELAPSE_SHOTS 1e9

/* What is given; NaN = not given. Every number is above 0, but for the gap, which may be 0. */
struct timelapse_given {
    double shots;      /* a whole number, up to TIMELAPSE_SHOTS */
    double interval;   /* from the beginning of a shot to that of the next, s */
    double event;      /* what is recorded lasts, s; not with star_angle */
    double clip, rate; /* length of the clip, s, and its frames per second */
    double time;       /* exposure time of a shot, s */
    double gap;        /* that the camera needs between two exposures, s; used with time */
    double star_angle; /* about the pole, of star trails, rad, up to 2 pi; wants time */
    double frame;      /* storage that a shot takes, bytes */
    double card;       /* storage there is, bytes; wants frame */
};

/* The plan; NaN = does not follow from what is given. */
struct timelapse {
    long shots;
    double interval; /* s */
    double event;    /* shots x interval, s */
    double clip;     /* shots/rate, s */
    double rate;     /* frames per second */
    bool rate_assumed;
    double speed_up;      /* event/clip */
    double pause;         /* without exposure between two shots, s */
    double shutter_angle; /* of the clip: 2 pi x the exposed part of an interval, rad */
    double span;          /* from the beginning of the first exposure to the end of the last, s */
    double star_angle;    /* by which the sky turns in it, rad */
    double space;         /* bytes */
    double card_shots;    /* that a card holds, a whole number */
    double cards;         /* that all shots need, a whole number */
    double card_time;     /* until a card is full, s */
};

/*
 * Solve a time-lapse for whatever is missing.
 *
 * Given     given  enough for the number of shots: itself; event (or star_angle) with interval;
 *                  clip with rate; event (or star_angle) with the exposure time, as fast as the
 *                  camera can; or card with frame. The first of these that is given counts, the
 *                  others must agree with it
 * Result    plan   shots is rounded down where the event and up where clip or star_angle asks for
 *                  it; the rest follows from it, so that event and clip may differ from those given
 *                  by less than an interval and a frame
 * Formula   event = shots interval; shots = clip rate; speed-up = interval rate; span = (shots - 1)
 *           interval + time = star_angle/w with w of photo/stars.h; interval = time + gap where
 *           nothing else says it; space = shots frame
 * Source    definitions; a shot and the wait behind it are counted as one interval, the last too
 * Errors    ERROR_USAGE: not enough given, event beside star_angle, star_angle without time, card
 *           without frame; ERROR_DOMAIN: a number out of range, numbers that contradict each other,
 *           exposure and gap longer than the interval, an event shorter than it, a frame larger
 *           than the card
 */
bool timelapse_solve(const struct timelapse_given *given, struct timelapse *plan,
                     struct error *error);

#endif
