/* camera/lens_film.h - a lens made ready to be looked through from its film. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_CAMERA_LENS_FILM_H
#define LENSCALC_CAMERA_LENS_FILM_H

#include "analysis/setup.h"
#include "base/arena.h"
#include "base/error.h"
#include "base/sobol.h"
#include "camera/film_rays.h"

struct lens_film {
    const struct system **systems; /* one a wavelength of the setup */
    struct film_region region;
    struct sobol sobol[FILM_DIMENSIONS];
    double corner; /* how far from the axis the film goes, mm */
};

/*
 * Given     setup          round, with its image plane and the wavelengths that count
 *           width, height  of the film, mm
 * Errors    ERROR_DOMAIN: as film_region_open; no stop, or none with a diameter; no image plane; no
 *           light reaches the film; as setup_system
 */
bool lens_film_open(const struct setup *setup, double width, double height, struct arena *arena,
                    struct lens_film *film, struct error *error);

#endif
