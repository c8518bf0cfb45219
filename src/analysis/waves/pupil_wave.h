/* analysis/waves/pupil_wave.h - the wave front and the amplitude of a pupil from some of its rays. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_PUPIL_WAVE_H
#define LENSCALC_ANALYSIS_WAVES_PUPIL_WAVE_H

#include "analysis/waves/pupil_series.h"
#include "base/arena.h"
#include "base/error.h"
#include "trace/aim/sample.h"

#include <stdbool.h>
#include <stddef.h>

/* What is known of each ray. */
enum {
    PUPIL_TO_X, /* direction cosines towards the centre of the reference sphere, from it */
    PUPIL_TO_Y,
    PUPIL_WAVE,   /* path to it, wavelengths, less any number */
    PUPIL_FROM_X, /* where it is in the beam, of which equal areas count alike */
    PUPIL_FROM_Y,
    PUPIL_PARTS
};

/* A sample of the unit disc, and polynomials on it. */
struct pupil_rule {
    size_t count, room; /* rays, and a multiple of PUPIL_LANES */
    struct pupil_form form;
    double *x, *y, *weights; /* `room`; what lies behind `count` weighs 0 */
    double *factor;          /* of least squares in x and y */
    /* twice as many rings: where polynomials are summed by rays */
    size_t fine_count, fine_room;
    double *fine_x, *fine_y, *fine_weights;
};

/*
 * Make ready.
 *
 * Given     points  those of PATTERN_GAUSS; weights add up to 1
 */
bool pupil_rule_open(const struct pupil_point *points, size_t count, struct arena *arena,
                     struct pupil_rule *rule, struct error *error);

/*
 * One pupil. Places are meant: the direction cosines less what of them is a linear function of the
 * points, so that they lie about where these do in the unit disc.
 */
struct pupil_wave {
    const struct pupil_rule *rule;
    double *parts[PUPIL_PARTS];   /* room: given */
    double *back[PUPIL_PARTS];    /* receive derivatives of what pupil_wave_back is told */
    double matrix[4], inverse[4]; /* direction cosines by places, row by row, and back */
    double *place[2];
    double *c[2];                    /* of W and the amplitude, by places */
    double rim[2][2 * PUPIL_ORDERS]; /* places of the edge: cosines and sines of m phi, in turn */
    double energy;                   /* area in the beam */
    /* derivatives by these of something, to be set before pupil_wave_back */
    double *by_c[2];
    double by_rim[2][2 * PUPIL_ORDERS], by_matrix[4], by_energy;
    /* internal */
    double *slope[4][2], *amplitude, *rest[2], *front[2][2];
    double *work[6], *copy[8], *sums[2], *factor, *rows, sign;
};

void pupil_wave_open(const struct pupil_rule *rule, struct arena *arena, struct pupil_wave *wave);

/*
 * From the parts.
 *
 * Formula   places and the beam as polynomials of the points, by least squares; from their slopes
 *           the areas: amplitude^2 = d(beam)/d(places). W and the amplitude as polynomials of the
 *           places. On the edge |points| = 1
 * Errors    ERROR_DOMAIN: the beam is folded within the pupil, so that it has no amplitude
 */
bool pupil_wave_find(struct pupil_wave *wave, struct error *error);

/* All that `back` comes from is 0. */
void pupil_wave_begin_back(struct pupil_wave *wave);

/* Backwards through all of that: from by_c, by_rim, by_matrix and by_energy to `back`. */
void pupil_wave_back(struct pupil_wave *wave);

/*
 * The same by rays, whose parts PUPIL_TO_X and _Y are places in the image: polynomials of the
 * points, at many of them.
 */
struct pupil_spot {
    struct pupil_wave wave;  /* its rule, parts and back */
    double *place[2], *area; /* fine_room: places, and areas of the beam with weights */
    double *by_place[2], *by_area;
    /* internal */
    double *slope[2][2], *copy[2][2], *spare[2], sign;
};

void pupil_spot_open(const struct pupil_rule *rule, struct arena *arena, struct pupil_spot *spot);

/* Errors    ERROR_DOMAIN: as pupil_wave_find */
bool pupil_spot_find(struct pupil_spot *spot, struct error *error);

/* From by_place and by_area to back. */
void pupil_spot_back(struct pupil_spot *spot);

#endif
