/* analysis/waves/wave_reference.h - the wave fronts of a field, and what they are compared with. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_WAVE_REFERENCE_H
#define LENSCALC_ANALYSIS_WAVES_WAVE_REFERENCE_H

#include "analysis/pupil/bundle.h"
#include "analysis/waves/opd.h"

#include <stdbool.h>
#include <stddef.h>

/* One wavelength. Its source points into it. */
struct wave_light {
    double wavelength, weight; /* um */
    struct bundle_question question;
    struct bundle_source source;
    const struct system *system; /* with paths, to the image plane */
    const struct system *open;   /* the same, but nothing is clipped */
    struct ray chief;            /* where it arrives */
};

struct wave_lights {
    struct wave_light *list;
    size_t count;
};

/* What energy of 1 stands for beside other wavelengths: its weight, and the area of u and v. */
double wave_light_weight(const struct wave_light *light);

/* One ray from its start through a system. */
struct ray wave_light_trace(const struct system *system, const struct ray *start,
                            struct arena *arena);

/* What aberrations are counted from. */
enum wave_about {
    WAVE_CHIEF,    /* the chief ray */
    WAVE_CENTROID, /* the centroid of the spot */
    WAVE_BEST      /* the centre of the sphere that fits the wave front best */
};

/* One reference for all wavelengths of a field. */
struct wave_reference {
    bool is_angular;     /* the image lies infinitely far away */
    double at[2];        /* of an angular one, sines from the chief ray; else its distance, mm */
    double across[2][3]; /* of angles */
    double centre[3];    /* in the frame of the image plane, mm; z is not 0 of WAVE_BEST alone */
    double doubt;        /* what its place may change of W, rms in wavelengths; 0: of a chief ray,
                            and of an angular centroid, where it is not known */
    struct opd_reference opd;
    const char *no_opd; /* why there are no optical path differences; null: there are */
};

/*
 * Make a field ready at all wavelengths of its setup.
 *
 * Given     bundle  its wavelength is not used
 * Errors    as bundle_open; ERROR_DOMAIN: a chief ray is lost
 */
bool wave_open(const struct bundle_question *bundle, struct arena *arena,
               struct wave_lights *lights, struct error *error);

/*
 * Find the reference.
 *
 * Formula   the chief ray of the first wavelength, or the centroid of all by their weights
 *           (spot_find to 1e-7), or the sphere with the least weighted mean square of W/wavelength,
 *           its piston for each wavelength free. Spheres go through the crossing of the first
 *           wavelength's chief ray and its paraxial exit pupil; without a stop their radius is
 *           infinite. Angular: a plane wave across the reference, along spot_axes
 * Source    [Welford86]
 * Errors    as spot_find; ERROR_DOMAIN: WAVE_BEST of an image infinitely far away, or of a thick
 *           lens
 */
bool wave_reference_find(const struct wave_lights *lights, enum wave_about about,
                         struct arena *arena, struct wave_reference *reference,
                         struct error *error);

/* The direction from the axis to the field point, as the pupil has it, of unit length. */
void wave_section(const struct field_point *field, double along[2]);

#endif
