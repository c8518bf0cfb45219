/* analysis/real/real_range.h - what is sharp before a real lens, and where its film may stand. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_REAL_REAL_RANGE_H
#define LENSCALC_ANALYSIS_REAL_REAL_RANGE_H

#include "analysis/real/real_focus.h"

/*
 * All distances of objects are from the front principal plane, mm, films from the last vertex.
 * `front` is that plane seen from the first vertex.
 */
struct real_range {
    double near, far;           /* far: inf where infinity is sharp */
    double film_near, film_far; /* where these are sharpest themselves; film_near: NaN none */
    double film, blur;          /* the film, and the blur of the subject on it */
    double film_low, film_high; /* where the film may stand for the subject */
    double blur_at_infinity;    /* NaN: more than the rule can tell */
};

/*
 * The distances that are no more blurred than c while the lens is focused on one.
 *
 * Given     distance  of the subject, on whose sharpest image the film stands
 *           c         mm, below blur_rule_reach
 * Formula   blur^2 - c^2 in 1/distance, which is nearly a parabola there: stepped outwards from the
 *           subject, then by the Illinois method
 * Errors    as real_focus_point; ERROR_DOMAIN: the subject itself is more blurred than c, c is
 *           beyond the reach of the rule
 */
bool real_range_find(const struct real_focus *focus, double front, double distance, double c,
                     struct real_range *range, struct error *error);

/*
 * The nearest distance on which the lens may be focused with infinity still sharp.
 *
 * Given     blur  receives that of infinity at its sharpest, mm
 * Result    NaN: it never is sharp, so large is its blur
 */
bool real_range_hyperfocal(const struct real_focus *focus, double front, double c,
                           double *hyperfocal, double *blur, struct error *error);

#endif
