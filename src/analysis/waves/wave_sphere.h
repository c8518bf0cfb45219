/* analysis/waves/wave_sphere.h - a field by wavelengths, and the sphere that fits its waves. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_WAVE_SPHERE_H
#define LENSCALC_ANALYSIS_WAVES_WAVE_SPHERE_H

#include "analysis/pupil/bundle.h"
#include "analysis/waves/opd.h"

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

/*
 * The reference sphere that fits the wave fronts best.
 *
 * Given     pupil      z of the exit pupil, as opd_sphere has it
 *           reference  a sphere about the chief ray; receives the best
 *           doubt      receives what the last doubling of rays changes of W (root mean square,
 *                      wavelengths)
 * Formula   the centre C that makes sum w ((W - mean W)/wavelength)^2 smallest, the mean that of
 *           each wavelength: steps of Gauss and Newton, dW/dC by opd_path_by_centre, until one
 *           changes W by less than 1e-9 wavelengths (root mean square); rays are doubled until that
 *           changes less than 1e-6
 * Errors    ERROR_DOMAIN: no ray arrives; 50 steps do not get to a change of 1e-6 wavelengths
 * Limits    2^15 rays of a wavelength
 */
bool wave_sphere_fit(const struct wave_lights *lights, double pupil, struct arena *arena,
                     struct opd_reference *reference, double *doubt, struct error *error);

#endif
