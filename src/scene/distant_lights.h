/* scene/distant_lights.h - distant lights: discs infinitely far away, suns and stars. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_DISTANT_LIGHTS_H
#define LENSCALC_SCENE_DISTANT_LIGHTS_H

#include "base/arena.h"
#include "light/bands.h"
#include "scene/scene.h"
#include "scene/spectra.h"

#include <stdbool.h>
#include <stddef.h>

struct distant_light {
    struct vector direction;   /* to its middle */
    double radius;             /* rad */
    double chord;              /* its square, from the middle to the edge on the unit sphere */
    double pdf;                /* with which samples lie in it, per sr */
    double luminance;          /* cd/m^2 */
    const struct banded *unit; /* light of luminance 1 */
};

/* Read-only afterwards. Which discs a direction may lie in stands in cells of the sphere. */
struct distant_lights {
    struct distant_light *all;
    double *below; /* illuminance of those before each, and of all */
    size_t count;
    double total; /* lx */
    size_t rows, columns;
    size_t *begins; /* of each cell, and the end of the last */
    size_t *listed; /* numbers of discs */
};

/*
 * Make all suns and stars of a scene ready; those of one place, size and colour become one.
 *
 * Given     units  of each light of the scene that shines the light of luminance 1
 * Formula   L = E/(pi sin^2 r): the illuminance of a plane that faces a disc of the radius r
 */
void distant_lights_open(const struct scene *scene, const struct banded *const *units,
                         struct arena *arena, struct distant_lights *discs);

/* A direction to a disc, evenly over it, by two numbers in 0..1. */
struct vector distant_light_direction(const struct distant_light *disc, const double u[2]);

/*
 * A direction to one of them: each as often as its illuminance has it, evenly over its disc.
 *
 * Given     u  three numbers in 0..1
 */
struct vector distant_lights_sample(const struct distant_lights *discs, const double u[3]);

/* Of these samples, per sr. */
double distant_lights_pdf(const struct distant_lights *discs, struct vector direction);

/* Add what shines there. */
void distant_lights_add(const struct distant_lights *discs, struct vector direction,
                        const struct lanes *lanes, struct radiance *light);

#endif
