/* camera/film/lens_rays.h - the rays that a film sees through a lens, for whoever has a scene. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_FILM_LENS_RAYS_H
#define LENSCALC_CAMERA_FILM_LENS_RAYS_H

#include "base/arena.h"
#include "base/error.h"
#include "camera/film/lens_film.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A lens, its film, and how many rays. */
struct lens_rays_question {
    struct film_question film;
    uint64_t samples; /* 1 and more: rays that leave the film */
    uint64_t seed;
};

/* A ray that leaves the lens towards the scene. */
struct lens_ray {
    double film[2];    /* where it leaves the film, mm */
    double wavelength; /* um */
    double point[3];   /* on the first surface, in the frame of its vertex, mm */
    double cosine[3];  /* direction, away from the film */
    double weight;     /* sr */
    double time;       /* of the exposure: 0 it begins, 1 it ends; in the middle of the film, of a
                          shutter to which that matters */
};

/* Rays on their way: what blocks have in common, and how far they have come. */
struct lens_rays {
    const struct lens_rays_question *question;
    struct lens_film film;
    struct film_plan plan; /* of the part of the film that may be lit */
    struct film_samples samples;
    struct sobol sobol_time; /* of one more dimension than the film has */
    double times[RAYS_BLOCK];
    struct rays rays;
    size_t wavelength;         /* at work */
    double share;              /* of the light that it is */
    uint64_t done, samples_of; /* of its samples */
    uint64_t sent;             /* of all, with those of this wavelength */
    uint32_t when;
    struct lens_ray passed[RAYS_BLOCK]; /* what lens_rays_next has found */
    uint64_t arrived;                   /* of the samples so far */
};

/*
 * Send rays through the lens, wavelength by wavelength; question must outlive them.
 *
 * Result    weights: their sum, each times the radiance its ray meets, is the irradiance averaged
 *           over the film; of a uniform scene the sum is that of E/L, as
 *           analysis/rays/illumination.h has it. Each wavelength has its share of the samples by
 *           its weight
 * Formula   camera/film/film_rays.h at scrambled Sobol' points of film, pupil and time, a sequence
 *           for each wavelength; times (n'/n)^2
 * Errors    as lens_film_open
 */
bool lens_rays_open(const struct lens_rays_question *question, struct arena *arena,
                    struct lens_rays *stream, struct error *error);

/* The next ones that pass, in their order: how many; 0: these were all. */
size_t lens_rays_next(struct lens_rays *stream);

#endif
