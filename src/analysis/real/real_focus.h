/* analysis/real/real_focus.h - how sharp a point on the axis is, by a lens's own rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_REAL_REAL_FOCUS_H
#define LENSCALC_ANALYSIS_REAL_REAL_FOCUS_H

#include "analysis/pupil/encircled_energy.h"
#include "analysis/setup/setup_question.h"
#include "base/arena.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * What of a blur counts. Each says how large the evenly lit disc is that blurs as much, which is
 * what a circle of confusion means.
 */
enum blur_measure {
    BLUR_RMS,    /* the same root mean square distance from the middle */
    BLUR_ENERGY, /* the same radius holds so much of the light */
    BLUR_MTF     /* the same contrast of a sine grating, by rays */
};

struct blur_rule {
    enum blur_measure measure;
    double at; /* share of the light, 0..1; frequency, 1/mm */
};

/* What is looked at. */
struct real_focus_question {
    struct setup_question lens; /* its object is not used */
    struct blur_rule rule;
    double object; /* before the first vertex, mm; may be infinite */
    double c;      /* the blur that matters, mm */
};

/* A lens whose points on the axis are looked at. */
struct real_focus {
    struct setup_question asked;
    struct blur_rule rule;
    size_t rays;         /* of each wavelength; by real_focus_open */
    double error;        /* relative, of blurs: what twice the rays changed */
    struct arena *arena; /* for working: reset by whoever owns it */
};

/* The rays of one point behind the lens, about the plane where they lie closest. */
struct real_point {
    double sharpest; /* where its blur is smallest, behind the last vertex, mm */
    double nearest;  /* that of the root mean square: the plane of `at` */
    size_t count;
    const double (*at)[2], (*slope)[2];        /* mm, mm/mm, about their means */
    const struct encircled_energy_mark *marks; /* their weights, in all 1 */
    bool has_arms;
    const struct encircled_energy_sheet *sheets;
    double square, spread; /* means of |at|^2 and |slope|^2 */
};

/*
 * Make a lens ready: as many rays as blurs want, found with a point at that distance.
 *
 * Errors    as real_focus_point
 * Limits    a blur of about c changes by less than 1e-9 (RMS), 1e-3 (energy), 1e-6 (MTF) where
 *           rays are doubled, but no more than 2^13 rays of a wavelength are taken, for energy
 *           2^11: see `error`
 */
bool real_focus_open(const struct real_focus_question *question, struct arena *arena,
                     struct real_focus *focus, struct error *error);

/*
 * The rays of a point of the axis, and where its image is sharpest.
 *
 * Formula   rays of equal areas of the stop by analysis/pupil/quadrature.h, clipped. The mean
 * square is
 *           a parabola in the place of the film, whose lowest point is known; other measures are
 *           searched for around it
 * Errors    as setup_open, bundle_open and bundle_trace; ERROR_DOMAIN: rays that leave parallel
 */
bool real_focus_point(const struct real_focus *focus, double object, struct real_point *point,
                      struct error *error);

/*
 * Diameter of the evenly lit disc that is as blurred as the point is on a film, mm.
 *
 * Given     film  behind the last vertex, mm
 * Formula   RMS: 2 sqrt(2) s, s^2 = square + spread (film - nearest)^2
 *           energy: 2 r/sqrt(share), r the radius that holds the share
 *           MTF: d with 2 J1(pi d F)/(pi d F) = mean of cos(2 pi F x), in the first lobe of J1:
 *           at most 5.1356/(pi F), and that where the film is farther off; the mean of x and y
 * Source    a disc has the mean square d^2/8, the share (2 r/d)^2, and that transform
 */
double real_focus_blur(const struct real_focus *focus, const struct real_point *point, double film);

/* The largest disc that a rule can tell from larger ones, mm. */
double blur_rule_reach(struct blur_rule rule);

#endif
