/* scene/lights.h - all lights of a scene: sampled together, with their pdf. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_LIGHTS_H
#define LENSCALC_SCENE_LIGHTS_H

#include "base/arena.h"
#include "base/error.h"
#include "light/bands.h"
#include "scene/distant_lights.h"
#include "scene/environment_light.h"
#include "scene/light_tree.h"
#include "scene/material.h"
#include "scene/spectra.h"
#include "scene/world.h"

#include <stdbool.h>
#include <stddef.h>

/* Read-only afterwards: threads share it. */
struct lights {
    const struct scene *scene;
    const struct bands *bands;
    const struct banded **units; /* of each light of luminance 1; null: it gives none */
    struct materials materials;
    struct distant_lights distant;
    struct environment_light *environments;
    double *environment_below; /* light of those before each, and of all */
    size_t environment_count;
    struct light_tree tree;
    size_t *planes;      /* things */
    double *plane_below; /* luminance of those before each, and of all */
    size_t plane_count;
    size_t *first; /* of a thing its first emitter, or its number among the planes; SCENE_NONE */
};

struct light_sample {
    struct vector direction; /* of length 1 */
    double distance;         /* mm, to what shines; INFINITY: behind everything */
    double pdf;    /* with which all lights together sample this direction, per sr; of points 1 */
    bool is_point; /* no ray meets it by chance */
    struct radiance
        light; /* radiance, cd/m^2; of a point its illuminance across the direction, lx, over
                              the chance that it was picked */
};

/*
 * Make the lights of a scene ready, and the things in it that shine.
 *
 * Errors    of materials_open and spectra_light
 */
bool lights_open(const struct scene *scene, const struct bands *bands, struct arena *arena,
                 struct lights *lights, struct error *error);

/*
 * Sample light that comes to a point (next-event estimation).
 *
 * Given     from    where it is wanted; its normal is not asked for
 *           time    s
 *           u       three numbers in 0..1
 *           sample  light over pdf is right in the mean for the light that comes through the
 *                   unit sphere about the point, if nothing occludes it
 * Result    false: this time none; counts as 0
 * Formula   discs far away, skies and pictures, emitters, and planes that shine: each of these that
 *           are there as often as half its share of their light and half evenly, so that what
 *           the brightest one cannot reach is found too
 */
bool lights_sample(const struct lights *lights, struct vector from, double time, const double u[3],
                   const struct lanes *lanes, struct light_sample *sample);

/*
 * The pdf of lights_sample for a direction, per sr.
 *
 * Given     hit  what a ray met there; null: it went past everything
 * Result    0: lights_sample does not go there
 */
double lights_pdf(const struct lights *lights, struct vector from, struct vector direction,
                  double time, const struct world_hit *hit);

/* What comes from behind everything: suns, stars, skies and pictures; 0 where nothing is. */
void lights_background(const struct lights *lights, struct vector direction,
                       const struct lanes *lanes, struct radiance *light);

#endif
