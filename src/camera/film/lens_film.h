/* camera/film/lens_film.h - a lens made ready to be looked through from its film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_LENS_FILM_H
#define LENSCALC_CAMERA_FILM_LENS_FILM_H

#include "analysis/model/ray_model.h"
#include "analysis/setup/setup.h"
#include "base/arena.h"
#include "base/error.h"
#include "base/sobol.h"
#include "camera/film/acceptance.h"
#include "camera/film/film_rays.h"
#include "camera/sensor/shutter.h"
#include "optics/blades.h"

struct lens_film {
    /* starts a block of rays on the film, as film_rays_start has it */
    void (*start)(const struct lens_film *film, struct film_samples *samples,
                  struct ray_block *block);
    /* the same where u, v are places in the pupil, whatever `start` makes of them */
    void (*aim)(const struct lens_film *film, struct film_samples *samples,
                struct ray_block *block);
    struct ray_model *models; /* from the film into the scene, one a wavelength of the setup */
    struct exit_pupil_bounds region;
    struct sobol sobol[FILM_DIMENSIONS];
    const struct acceptance *acceptance;
    const struct shutter *shutter; /* null: nothing depends on it */
    double corner;                 /* how far from the axis the film goes, mm */
    double lit;                    /* the same of light, towards that corner where it ends first */
    struct disc disc; /* the pupil, of thick and thin lenses; then no region has been looked for */
    /* of a start anywhere: direction cosines from (0, h), least and most of x and y */
    double low[2], high[2];
};

/* A film, and what the lens has for a stop. */
struct film_question {
    const struct setup *setup;           /* with its image plane and the wavelengths that count */
    double width, height;                /* of the film, mm */
    struct blades blades;                /* count 0: the stop is round */
    enum lens_model model;               /* the setup's lens is that of it */
    const struct acceptance *acceptance; /* of its pixels; null: they take all light */
    const struct shutter *shutter;       /* null: open to all rays at once; nobody asks when */
    bool is_anywhere; /* rays start in one rectangle of directions for all points of the film */
};

/*
 * A lens as its film's rays go through it, clipped, with its blades: one a wavelength of the setup.
 *
 * Given     way  SETUP_REVERSED: from the film into the scene; SETUP_IMAGE: from the scene to it
 * Result    null with `error` set: as setup_system and blades_stop
 */
struct ray_model *lens_film_models(const struct film_question *question, unsigned way,
                                   struct arena *arena, struct error *error);

/*
 * Result    rays of regions of pupils, but of models whose pupil is a disc through that
 * Errors    ERROR_DOMAIN: blades or a leaf shutter of a pinhole; curtains in the lens; as
 *           exit_pupil_bounds_open and blades_stop; no stop, or
 *           none with a diameter; no image plane; no light reaches the film; as setup_system
 */
bool lens_film_open(const struct film_question *question, struct arena *arena,
                    struct lens_film *film, struct error *error);

/* Start a block of rays on the film: film_rays_start, weighed by what pixels accept. */
void lens_film_start(const struct lens_film *film, struct film_samples *samples,
                     struct ray_block *block);

/*
 * Trace a block that has been started through the whole lens.
 *
 * Given     rays  one block
 * Result    as rays_trace; of a film with a shutter samples' begin and end, and the weights times
 *           the share of the exposure time that this is. The height of a ray in the stop, which a
 *           leaf shutter wants to know, is that of the traced ray
 */
void lens_film_trace(const struct lens_film *film, size_t wavelength, struct film_samples *samples,
                     const struct rays *rays);

/*
 * E/L of a point of the film, sr, in the lens's last medium.
 *
 * Given     at      of the point, mm
 *           blocks  of rays, started as a picture's are: of a pupil with a hole or in pieces, or
 *                   with a shutter
 *           samples, rays  room for one of them
 * Formula   of all others Gauss's points along lines up to where light ends: 1e-5, 1e-4 where edges
 *           cross
 */
double lens_film_light(const struct lens_film *film, const double at[2], size_t wavelength,
                       size_t blocks, struct film_samples *samples, const struct rays *rays);

/*
 * How much of its light comes to the middle of a film that has a shutter, or, where that is dark,
 * to the pole of its region.
 *
 * Given     wavelengths  of the setup
 * Result    over that of a shutter that is fully open for the exposure time, by the same 16384 rays
 *           of each wavelength through the lens as it is modelled; the mean of the wavelengths.
 *           NaN: no light comes there either
 */
double lens_film_open_share(const struct lens_film *film, size_t wavelengths, struct arena *arena);

/*
 * From when to when any ray of a film with a shutter comes.
 *
 * Result    span  s; for curtains by the rims of pupils of 17 x 17 points of the film, and a step
 *                 between these more
 */
void lens_film_span(const struct lens_film *film, double span[2]);

/*
 * The ray from a point of the film through the middle of what is clear, of the first wavelength,
 * traced: the first of a block. From beyond where light arrives: from the border of that.
 */
void lens_film_chief(const struct lens_film *film, const double at[2], struct film_samples *samples,
                     struct rays *rays);

/*
 * The angle between such rays from the middle of the film and from a step aside, before the lens.
 *
 * Given     step  mm
 * Result    rad; 0 where the lens is telecentric in the scene; NaN: one of them is lost
 */
double lens_film_angle(const struct lens_film *film, const double step[2],
                       struct film_samples *samples, struct rays *rays);

#endif
