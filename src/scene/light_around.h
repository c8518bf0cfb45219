/* scene/light_around.h - light from all around: a sky, or a picture. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_LIGHT_AROUND_H
#define LENSCALC_SCENE_LIGHT_AROUND_H

#include "base/arena.h"
#include "light/bands.h"
#include "scene/scene.h"
#include "scene/spectra.h"

#include <stdbool.h>
#include <stddef.h>

/*
 * One sky or environment. Cells of the sphere, as rows and columns of a picture of it, have shares
 * of its light: single precision is enough for chances, whose density is known exactly.
 */
struct light_around {
    const struct scene_light *light;
    const struct banded *unit; /* light of luminance 1 */
    double cosine, sine;       /* of its turn about y */
    double total;              /* luminance times solid angle, lx */
    size_t rows, columns;
    const float *down;   /* shares of all rows before each, and 1 */
    const float *across; /* in each row the same of its columns */
};

bool light_around_is(const struct scene_light *light);

struct light_around light_around_open(const struct scene_light *light, const struct banded *unit,
                                      struct arena *arena);

/* A direction, as often as its cell's light has it, evenly within; u and v are 0..1. */
struct vector light_around_sample(const struct light_around *around, double u, double v);

/* Of these samples, per sr. */
double light_around_density(const struct light_around *around, struct vector way);

/* Add what shines there; of pictures what lies between four pixels goes in a straight line. */
void light_around_add(const struct light_around *around, const struct bands *bands,
                      struct vector way, const struct lanes *lanes, struct radiance *light);

#endif
