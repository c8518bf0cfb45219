/* scene/environment_light.h - environment lights: skies and pictures, importance sampled. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_ENVIRONMENT_LIGHT_H
#define LENSCALC_SCENE_ENVIRONMENT_LIGHT_H

#include "base/arena.h"
#include "light/bands.h"
#include "scene/scene.h"
#include "scene/spectra.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * One sky or environment. Cells of the sphere, as rows and columns of a picture of it, have shares
 * of its light: single precision is enough for chances, whose pdf is known exactly.
 */
struct environment_light {
    const struct scene_light *light;
    const struct banded *unit; /* light of luminance 1 */
    double cosine, sine;       /* of its turn about y */
    double total;              /* luminance times solid angle, lx */
    size_t rows, columns;
    const float *down;   /* shares of all rows before each, and 1 */
    const float *across; /* in each row the same of its columns */
};

bool is_environment_light(const struct scene_light *light);

struct environment_light environment_light_open(const struct scene_light *light,
                                                const struct banded *unit, struct arena *arena);

/* A direction, as often as its cell's light has it, evenly within; u and v are 0..1. */
struct vector environment_light_sample(const struct environment_light *around, double u, double v);

/* Of these samples, per sr. */
double environment_light_pdf(const struct environment_light *around, struct vector direction);

/* Add what shines there; of pictures what lies between four pixels goes in a straight line. */
void environment_light_add(const struct environment_light *around, const struct bands *bands,
                           struct vector direction, const struct lanes *lanes,
                           struct radiance *light);

#endif
