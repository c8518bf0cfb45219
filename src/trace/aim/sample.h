/* trace/aim/sample.h - points of the pupil to trace rays through. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TRACE_AIM_SAMPLE_H
#define LENSCALC_TRACE_AIM_SAMPLE_H

#include "base/arena.h"
#include "base/error.h"
#include "base/text.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum pattern {
    PATTERN_GAUSS,     /* quadrature: Gauss's points in r^2, equal arms */
    PATTERN_HEXAPOLAR, /* centre and rings of 6, 12, 18 ...: as other programs print */
    PATTERN_SQUARE,    /* a grid */
    PATTERN_FAN,       /* along x and y */
    PATTERN_SOBOL,     /* a scrambled sequence of low discrepancy */
    PATTERNS
};

/* The words of the command line for them, indexed by enum pattern; ends with null. */
extern const struct word patterns[PATTERNS + 1];

/* A point of the pupil's unit disc; the weights of a sample add up to 1. */
struct pupil_point {
    double x, y, weight;
};

struct sample {
    struct pupil_point *points;
    size_t count;
};

/*
 * Points spread over the unit disc.
 *
 * Given     pattern
 *           rays    about how many are wanted; the pattern takes the next number it can have
 *           seed    of the scrambling, for PATTERN_SOBOL
 * Result    gauss: k rings at the roots of Gauss and Legendre in r^2, 2k + 1 arms, the first
 *           upwards: a polynomial of the disc up to degree 2k is integrated exactly
 *           hexapolar, square, fan, sobol: equal weights; a fan holds x = 0 and y = 0 with 2m + 1
 *           points each, the centre in both
 *           square: (2 i + 1 - k)/k, those inside the disc
 * Source    [Forbes88] (Gauss in the pupil); sobol: the first two dimensions of base/sobol.h,
 *           sequence 0, for the area and the angle
 * Errors    ERROR_USAGE: no rays, or more than 1e9
 */
bool sample_make(enum pattern pattern, size_t rays, uint64_t seed, struct arena *arena,
                 struct sample *sample, struct error *error);

/*
 * Gauss and Legendre's rule on 0..1.
 *
 * Given     count    of points, 1 and more
 *           x, w     receive abscissas, ascending, and weights; correct to a few ulp
 * Formula   Newton's method on P_n from cos(pi (i + 3/4)/(n + 1/2))
 * Source    [Abramowitz64] 25.4.30
 */
void gauss_rule(size_t count, double *x, double *w);

/* Such rules of 4, 8, 12 .. 128 points, found when they are first wanted. */
enum { GAUSS_STEP = 4, GAUSS_RULES = 32, GAUSS_PANEL = GAUSS_STEP * GAUSS_RULES };
struct gauss_rules {
    double *x[GAUSS_RULES], *w[GAUSS_RULES];
    bool is_ready[GAUSS_RULES];
};
struct gauss_rules *gauss_rules_new(struct arena *arena);

/* Many points of 0..1: one rule, in equal panels of which each is like the others. */
struct gauss_panels {
    const double *x, *w;
    size_t each, panels;
};

/* As many points as are wanted, and some more. */
struct gauss_panels gauss_panels_of(struct gauss_rules *rules, double wanted);

static inline double gauss_panels_at(const struct gauss_panels *rule, size_t i)
{
    return ((double)(i / rule->each) + rule->x[i % rule->each]) / (double)rule->panels;
}

static inline double gauss_panels_weight(const struct gauss_panels *rule, size_t i)
{
    return rule->w[i % rule->each] / (double)rule->panels;
}

#endif
