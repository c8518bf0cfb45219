/* analysis/waves/exit_pupil.h - a beam behind the lens, over the direction cosines of the image space. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_ANALYSIS_WAVES_EXIT_PUPIL_H
#define LENSCALC_ANALYSIS_WAVES_EXIT_PUPIL_H

#include "analysis/waves/pupil_series.h"
#include "analysis/waves/wave_reference.h"
#include "trace/pupil/pupil_islands.h"

#include <stdbool.h>
#include <stddef.h>

enum { EXIT_PUPIL_RIM = 256 + PUPIL_BOUNDARY_CORNERS };

/*
 * What passes the pupil of one field at one wavelength. Its points are named by a and b, the
 * components in x and y of the unit vector from the reference sphere to its centre, along the
 * light; of an infinite sphere that is the direction of the ray. Of an image infinitely far away
 * they are mm on the reference plane along the axes of spot_axes, the other way round, and what
 * is said of direction cosines and mm of an image holds of mm and sines of angles.
 */
struct exit_pupil {
    const struct wave_light *light;
    const struct wave_reference *reference;
    double n, waves;               /* index; wavelengths in a mm of path */
    double zero;                   /* path of the chief ray, mm */
    double energy;                 /* integral of the squared amplitude */
    double middle[2], half[2];     /* the box about its rim */
    double rim[EXIT_PUPIL_RIM][2]; /* once around */
    size_t rim_count;
    double off; /* what the map leaves between a point and where its ray goes, in half boxes */
    /* what polynomials of W and the amplitude leave: wavelengths, and of the mean amplitude */
    double off_waves, off_amplitude;
    /* internal: as polynomials u and v of the beam, and W and the amplitude */
    struct pupil_form terms;
    double scale[2]; /* of the disc that they are polynomials of, about the middle of the box */
    double *map[2], *form[2];
    bool is_blocked;     /* something may stand within */
    bool is_mirrored[2]; /* its rays, W and amplitude are the same at -a, and at -b */
};

/* A field at all wavelengths of its setup, about the first chief ray. */
struct exit_pupils {
    struct wave_lights lights;
    struct wave_reference reference;
    struct exit_pupil *list;      /* lights.count */
    struct pupil_islands islands; /* light that they leave out, of the first wavelength */
};

/*
 * Make a field ready.
 *
 * Given     bundle  its wavelength, pattern and weight are not used
 * Formula   u and v of the beam as polynomials in a and b of a degree up to 14, by least squares
 *           over a quadrature and the rim, of the terms that mirrors leave where it has some; W
 *           and the amplitude alike
 * Errors    as wave_open and wave_reference_find; ERROR_DOMAIN: nothing is clear; no reference
 *           sphere, or one that the rays of the edge miss
 */
bool exit_pupils_open(const struct bundle_question *bundle, struct arena *arena,
                      struct exit_pupils *pupils, struct error *error);

/* That of its light: wave_light_weight. */
double exit_pupil_weight(const struct exit_pupil *pupil);

/* Where nothing ends a ray, and names of what does. */
enum { EXIT_PUPIL_CLEAR = 0 };

/* Is light there? Receives EXIT_PUPIL_CLEAR or a number of what stops it, one a point. */
void exit_pupil_look(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                     size_t *limits);

/*
 * Do the rays that the polynomials name go to these points? Beyond the rim polynomials may fold
 * back into the pupil, and name rays that go elsewhere.
 */
void exit_pupil_meets(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                      bool *meets);

/* W and the amplitude at points. */
typedef void exit_pupil_ask(const struct exit_pupil *pupil, const double (*at)[2], size_t count,
                            double *waves, double *amplitudes);

/*
 * The wave front and the amplitude at points, whether they are clear or not.
 *
 * Given     waves  receives W, wavelengths; amplitudes: roots of energy per area of a and b
 * Formula   the ray that the polynomials name, traced, and from where it goes to the point by the
 *           slope dW/da = n (e_z m_x - e_x m_z)/c, m from the centre across to the ray, c the third
 *           component: what is left is of second order in `off`
 */
exit_pupil_ask exit_pupil_values;

/* The same from polynomials, at once, as well as off_waves and off_amplitude say. */
exit_pupil_ask exit_pupil_form;

/* From where to where it reaches in a direction of unit length. */
void exit_pupil_range(const struct exit_pupil *pupil, const double along[2], double range[2]);

#endif
