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

/* Takes rays in their order; false: it has failed, with its error set. */
typedef bool lens_rays_visit(void *context, const struct lens_ray *rays, size_t count,
                             struct error *error);

struct lens_rays {
    uint64_t arrived; /* of the samples */
    double largest;   /* how far from the axis light arrives, towards any corner, mm */
    double corner;    /* mm */
    double lit_at[2]; /* a place that light reaches, mm: the middle, unless that is dark */
};

/*
 * Send rays through the lens, wavelength by wavelength, and hand on those that pass.
 *
 * Result    weights: their sum, each times the radiance its ray meets, is the irradiance averaged
 *           over the film; of a uniform scene the sum is that of E/L, as
 *           analysis/rays/illumination.h
 *           has it. Each wavelength has its share of the samples by its weight
 * Formula   camera/film/film_rays.h at scrambled Sobol' points of film, pupil and time, a sequence
 * for
 *           each wavelength; times (n'/n)^2
 * Errors    as lens_film_open, `visit`
 */
bool lens_rays_make(const struct lens_rays_question *question, struct arena *arena,
                    lens_rays_visit *visit, void *context, struct lens_rays *result,
                    struct error *error);

#endif
