/* scene/material.h - materials in bands: reflectance and emission. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_MATERIAL_H
#define LENSCALC_SCENE_MATERIAL_H

#include "base/arena.h"
#include "base/error.h"
#include "light/bands.h"
#include "scene/bsdf.h"
#include "scene/scene.h"
#include "scene/spectra.h"

#include <stdbool.h>
#include <stddef.h>

/* A material of the scene. */
struct material {
    enum scene_material_kind kind;
    const struct image *texture;           /* null: none */
    const struct banded *colour;           /* shares; null: black */
    double ground;                         /* the largest of them */
    const struct banded *light;            /* of luminance 1; null: it does not shine */
    double luminance;                      /* cd/m^2 */
    const struct microfacets *microfacets; /* null: not glossy, or of no thing */
};

/* Read-only afterwards: threads share it. */
struct materials {
    const struct scene *scene;
    const struct bands *bands;
    const struct material *of; /* one a material */
};

/*
 * Make the materials of a scene ready.
 *
 * Errors    of spectra_surface and spectra_light
 */
bool materials_open(const struct scene *scene, struct spectra *spectra, struct materials *materials,
                    struct error *error);

/*
 * What a thing reflects at one place.
 *
 * Given     thing  of the scene
 *           place  in a texture, from the left and from below, 0 to 1
 * Result    false: nothing, and the rest is not set. Cards with a picture are Lambertian, or, where
 *           they shine, black
 */
bool materials_bsdf(const struct materials *materials, size_t thing, const double place[2],
                    const struct lanes *lanes, struct bsdf *scatter);

/* Does a thing shine anywhere? */
bool materials_shines(const struct materials *materials, size_t thing);

/*
 * The radiance of one that shines, alike in all directions and on both sides; where it is there:
 * alpha counts nothing.
 */
void materials_shine(const struct materials *materials, size_t thing, const double place[2],
                     const struct lanes *lanes, struct radiance *light);

#endif
