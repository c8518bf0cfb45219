/* photo/equivalent.h - the same picture on another format. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_PHOTO_EQUIVALENT_H
#define LENSCALC_PHOTO_EQUIVALENT_H

#include <stdbool.h>

#include "base/error.h"
#include "photo/format.h"

/* By which measure two formats are compared; it only matters if their shapes differ. */
enum equivalent_measure {
    EQUIVALENT_DIAGONAL,
    EQUIVALENT_WIDTH,
    EQUIVALENT_HEIGHT,
    EQUIVALENT_AREA /* square root of the area */
};

/* What stays the same besides framing and perspective. */
enum equivalent_keep {
    EQUIVALENT_PICTURE, /* depth of field, diffraction, total light, time: N and ISO change */
    EQUIVALENT_EXPOSURE /* effective f-number, ISO, time: depth of field changes */
};

/* A photograph to be matched. */
struct equivalent_setting {
    double f;   /* mm, > 0 */
    double N;   /* f-number, > 0 */
    double m;   /* magnification, >= 0; 0 = infinity */
    double P;   /* pupil magnification, > 0, taken as the same for both lenses */
    double iso; /* > 0 */
    double c;   /* circle of confusion, mm, >= 0 */
};

/* The match on the other format. */
struct equivalent {
    double k; /* size of the other format over this one, by the measure */
    double f, N, m, iso, c;
    double pupil_diameter;    /* entrance pupil f/N, mm */
    double working_fnumber;   /* N (1 + m/P) */
    double light_stops;       /* total light on the sensor against the original, stops */
    double field_depth_ratio; /* N c/(m f) over the original's: 1 = equal depth of field */
};

/*
 * Size ratio of two formats: `to` over `from`. The crop factor of a format is its ratio to 36 x 24.
 *
 * Errors    a side not above 0
 */
bool equivalent_ratio(const struct sensor *from, const struct sensor *to,
                      enum equivalent_measure measure, double *k, struct error *error);

/*
 * The lens, f-number and ISO that take the same picture from the same place on another format.
 *
 * Given     setting  the original
 *           k        size of the other format over the original's, > 0 (equivalent_ratio)
 *           keep     see enum equivalent_keep
 * Result    same subject plane, same distance from the entrance pupil (perspective), same framing
 *           by the measure; c scales with the format, that is with the same print
 * Formula   m' = k m; X = f (1/m + 1/P) kept: f' = k f (1 + m/P)/(1 + k m/P), k f at infinity.
 *           Picture: N' = N f'/f (same pupil; eps = N c/(m f) is kept, dof.h), so N_eff' = k N_eff
 *           and ISO' = k^2 ISO exactly, at any distance. Exposure: N_eff' = N_eff, ISO' = ISO;
 *           total light k^2 times, 2 log2 k stops
 * Source    James, Equivalence (josephjamesphotography.com) for infinity; at finite distance
 *           derived here from the constancy of X and m'/m; test_equivalent.c pins it with dof's
 *           formulas
 * Errors    values outside their ranges
 * Limits    the same subject distance from the principal plane would give another perspective; both
 *           lenses are taken to have the same P
 */
bool equivalent_compute(const struct equivalent_setting *setting, double k,
                        enum equivalent_keep keep, struct equivalent *result, struct error *error);

#endif
