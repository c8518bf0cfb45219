/* camera/lens_film.h - a lens made ready to be looked through from its film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_LENS_FILM_H
#define LENSCALC_CAMERA_LENS_FILM_H

#include "analysis/setup.h"
#include "base/arena.h"
#include "base/error.h"
#include "base/sobol.h"
#include "camera/film_rays.h"
#include "optics/blades.h"

struct lens_film {
    const struct system **systems; /* one a wavelength of the setup */
    struct film_region region;
    struct sobol sobol[FILM_DIMENSIONS];
    double corner; /* how far from the axis the film goes, mm */
};

/* A film, and what the lens has for a stop. */
struct film_question {
    const struct setup *setup; /* round, with its image plane and the wavelengths that count */
    double width, height;      /* of the film, mm */
    struct blades blades;      /* count 0: the stop is round */
};

/*
 * Errors    ERROR_DOMAIN: as film_region_open and blades_stop; no stop, or none with a diameter; no
 *           image plane; no light reaches the film; as setup_system
 */
bool lens_film_open(const struct film_question *question, struct arena *arena,
                    struct lens_film *film, struct error *error);

#endif
