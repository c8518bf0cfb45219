/* analysis/waves/wavefront.h - the wave front of a field against its reference. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_WAVEFRONT_H
#define LENSCALC_ANALYSIS_WAVES_WAVEFRONT_H

#include "analysis/waves/wave_reference.h"
#include "analysis/waves/zernike.h"
#include "trace/pupil/pupil_islands.h"

#include <stdbool.h>
#include <stddef.h>

struct wavefront_question {
    struct bundle_question bundle; /* its wavelength is not used: all of the setup are */
    enum wave_about about;
    size_t rays;  /* 0: doubled until `error` is met */
    double error; /* relative to the rms, absolute of the Strehl ratio */
};

/* Wavelengths; W = OPL(chief ray) - OPL(ray), as analysis/waves/opd.h has it. */
struct wavefront {
    double rms;      /* about the mean */
    double mean;     /* which is the piston */
    double pv;       /* highest less lowest of the clear pupil */
    double strehl;   /* |mean of exp(2 pi i W)|^2: at the centre of the reference */
    double marechal; /* exp(-(2 pi rms)^2) */
    double error, strehl_error;
    double clear;  /* share of the pupil's area */
    double missed; /* share of the light that misses the reference sphere: no part of the rest */
    double radius; /* of the reference sphere, mm; infinite: a plane */
    size_t rays;   /* of all wavelengths */
    struct pupil_islands islands;
    bool has_converged;
};

/* A field made ready; it points into itself. */
struct wavefront_source {
    const struct wavefront_question *question;
    struct wave_lights lights;
    struct wave_reference reference;
    double zero;  /* path of the chief ray, mm */
    double waves; /* wavelengths in a mm */
};

/*
 * Make a field ready.
 *
 * Errors    as wave_open and wave_reference_find; ERROR_DOMAIN: there is no reference sphere
 */
bool wavefront_open(const struct wavefront_question *question, struct arena *arena,
                    struct wavefront_source *source, struct error *error);

/*
 * The figures of a wave front; of several wavelengths those of all together.
 *
 * Given     wants_pv  the extremes too; else, and of several wavelengths, they are NaN
 * Formula   means weighted as the bundle weighs; extremes over 64 directions and all corners times
 *           15 rings to the edge, then by ever closer looks about the highest and the lowest.
 *           Errors: twice what twice the rays change; of the Strehl ratio as much as light can add
 *           whose phase differs by more than 0.3 wavelengths from ray to ray
 *           Of several wavelengths: rms^2 = sum of w rms^2/sum of w, each in its own wavelength and
 *           about the same reference, w its weight; the Strehl ratio is their light there over
 *           that of perfect waves, sum of w S/wavelength^2 over sum of w/wavelength^2
 * Source    Strehl ratios: [BornWolf99] 9.1.3, [Mahajan83]
 * Errors    as bundle_trace
 * Limits    2^17 rays; what has not converged then says so
 */
bool wavefront_find(const struct wavefront_source *source, bool wants_pv, struct arena *arena,
                    struct wavefront *wavefront, struct error *error);

/* Coefficients of Zernike's polynomials, in wavelengths, and what they leave. */
struct wavefront_fit {
    const double *coefficients; /* one a term */
    double residual;            /* rms that they leave, wavelengths */
    double missed;              /* as struct wavefront's */
    size_t rays;
};

/*
 * The polynomials of the first wavelength that fit best over what is clear of the pupil, whose full
 * radius is 1.
 *
 * Formula   weighted least squares by orthogonal factors over a quadrature of at least eight rays a
 *           term; of a whole disc the same as projections
 * Errors    as bundle_trace; ERROR_DOMAIN: what is clear of the pupil does not tell so many terms
 *           apart
 */
bool wavefront_fit(const struct wavefront_source *source, enum zernike_kind kind, size_t terms,
                   struct arena *arena, struct wavefront_fit *fit, struct error *error);

/*
 * W of the first wavelength on a square grid of the pupil, as points of PATTERN_SQUARE would lie:
 * (2 i + 1 - size)/size.
 *
 * Result    size * size values in wavelengths, rows from below; NaN: no ray arrives
 */
const double *wavefront_map(const struct wavefront_source *source, size_t size,
                            struct arena *arena);

#endif
