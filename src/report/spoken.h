/* report/spoken.h - quantities that people write in several units, or as fractions. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_REPORT_SPOKEN_H
#define LENSCALC_REPORT_SPOKEN_H

#include <stddef.h>

/* Longest text of the functions below, with its NUL. */
enum { SPOKEN_LENGTH = 64 };

/*
 * A time as cameras and timers show it: "1/125 s" below about 0.3 s, "15 s", "2 min 30 s",
 * "1 h 2 min". From a minute on in whole seconds, but where more than four digits are wanted.
 *
 * Given     to       room for SPOKEN_LENGTH
 *           seconds  finite
 *           digits   significant digits, of the denominator in a fraction
 */
void spoken_time(char *to, double seconds, int digits);

/* A time that passes, which nobody sets: the same, but never as a fraction. */
void spoken_span(char *to, double seconds, int digits);

/* A part of a whole, as flashes have their power: "1/16", "1/1". Given a value of 0 to 1. */
void spoken_part(char *to, double value, int digits);

/*
 * 9' 4.3": feet and inches.
 *
 * Given     to           room for SPOKEN_LENGTH
 *           millimetres  finite
 *           digits       significant digits
 *           places       decimals of the inches; below 0: as many as `digits` leave, and from
 *                        thousands of feet on no inches at all
 */
void spoken_feet(char *to, double millimetres, int digits, int places);

/* The decimals of the inches that `digits` significant digits leave a length; may be below 0. */
int spoken_inch_places(double millimetres, int digits);

#endif
