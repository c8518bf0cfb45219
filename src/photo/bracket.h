/* photo/bracket.h - plan of an exposure bracket by time. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_BRACKET_H
#define LENSCALC_PHOTO_BRACKET_H

#include "base/error.h"

/* The most shots a plan may have. */
#define BRACKET_SHOTS 1000

/* What is asked; NaN is "not given". */
struct bracket_given {
    double from, to; /* first and last time, s, > 0, in either order */
    double step;     /* stops between shots, > 0 */
    double shots;    /* a whole number, 1..BRACKET_SHOTS */
};

/* The plan; shots run from the longest time to the shortest. */
struct bracket {
    int shots;
    double longest;  /* time of the first shot, s */
    double shortest; /* time of the last shot, s: longest 2^(-(shots-1) step) */
    double step;     /* stops between neighbours */
    double span;     /* stops from first to last: (shots-1) step */
    double residual; /* stops by which `shortest` exposes more (+) or less (-) than the end asked
                        for; 0 where the step was solved for */
    double total;    /* sum of all times, s */
};

/*
 * Plan a bracket from whichever three of its numbers are given.
 *
 * Given     given  from and to with step or shots; or one of from and to with step and shots
 *                  (from is then the longest, to the shortest time)
 * Result    plan
 * Formula   shots = round(|log2(from/to)|/step) + 1; times longest 2^(-i step), i = 0..shots-1;
 *           step = |log2(from/to)|/(shots - 1); total = longest (1 - 2^(-n step))/(1 - 2^-step)
 * Source    lecture: 30 s to 1/1000 s in one-stop steps is 16 shots
 * Errors    not exactly three numbers (ERROR_USAGE); a number out of range, one shot between two
 *           different times, more than BRACKET_SHOTS shots (ERROR_DOMAIN)
 * Limits    times are exact steps from the longest; a camera's 30 s is 32 s and its 1/1000 s is
 *           1/1024 s, so its sixteen shots fit without residual
 */
bool bracket_plan(const struct bracket_given *given, struct bracket *plan, struct error *error);

/*
 * A bracket around a metered time, as cameras do it.
 *
 * Given     metered  time of the middle of the bracket, s, > 0
 *           step     stops, > 0;  shots 1..BRACKET_SHOTS, even numbers straddle the middle
 * Result    plan from metered 2^(+(shots-1) step/2) to metered 2^(-(shots-1) step/2)
 * Errors    a number outside its range
 */
bool bracket_around(double metered, double step, double shots, struct bracket *plan,
                    struct error *error);

/*
 * One shot of the plan.
 *
 * Given     plan
 *           i       0 .. shots-1 (the caller's promise)
 *           base    time that counts as 0 EV, s, > 0: the metered one, or `longest`
 * Result    bracket_time: s; bracket_offset: stops, + exposes more than base
 */
double bracket_time(const struct bracket *plan, int i);
double bracket_offset(const struct bracket *plan, int i, double base);

/* Scene contrast that a bracket records. */
struct bracket_range {
    double covered; /* stops, shadows of the longest to highlights of the shortest shot */
    double overlap; /* stops shared by neighbouring shots; negative: a gap between them */
};

/*
 * Dynamic range of the whole bracket.
 *
 * Given     plan
 *           single  usable range of one shot, stops, > 0
 * Result    range
 * Formula   covered = single + span, overlap = single - step
 * Source    derived: each shot moves the same window of `single` stops by `step`
 * Errors    single out of range
 * Limits    covered is continuous only for overlap >= 0
 */
bool bracket_covers(const struct bracket *plan, double single, struct bracket_range *range,
                    struct error *error);

/*
 * Shots that a scene needs.
 *
 * Given     scene   contrast of the scene, stops, > 0
 *           single  usable range of one shot, stops, > 0
 *           step    stops between shots, above 0 and up to single
 * Result    shots   the smallest number with single + (shots-1) step >= scene
 * Source    inverse of bracket_covers
 * Errors    a number outside its range; a step over `single` (it would leave gaps)
 */
bool bracket_shots_needed(double scene, double single, double step, int *shots,
                          struct error *error);

#endif
