/* tests/unit/looked.h - scenes of few things, and the mean light that rays meet in them. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_TESTS_UNIT_LOOKED_H
#define LENSCALC_TESTS_UNIT_LOOKED_H

#include "base/constants.h"
#include "check.h"
#include "scene/path.h"

enum { LOOKED_SEQUENCES = 16, LOOKED_BITS = 20 };

/* A scene made ready; it stays where it is. */
struct looked {
    struct arena arena;
    struct bands bands;
    struct world world;
    struct lights lights;
    struct path path;
    const struct sampler_table *table;
};

struct looked_mean {
    double mean, sigma; /* of the mean, by what sequences differ */
};

/* Initialisers, for constants too. */
#define LOOKED_UPRIGHT                                                                             \
    {                                                                                              \
        {1, 0, 0}, {0, 1, 0},                                                                      \
        {                                                                                          \
            0, 0, 1                                                                                \
        }                                                                                          \
    }
/* its z is up: the scene's y */
#define LOOKED_LEVEL                                                                               \
    {                                                                                              \
        {1, 0, 0}, {0, 0, -1},                                                                     \
        {                                                                                          \
            0, 1, 0                                                                                \
        }                                                                                          \
    }
/* and down */
#define LOOKED_DOWN                                                                                \
    {                                                                                              \
        {1, 0, 0}, {0, 0, 1},                                                                      \
        {                                                                                          \
            0, -1, 0                                                                               \
        }                                                                                          \
    }

#define LOOKED_GREY(share)                                                                         \
    {                                                                                              \
        SPECTRUM_RGB, {(share), (share), (share)}, 0, 0, NULL, NULL                                \
    }
#define LOOKED_PLACE(frame, ...)                                                                   \
    {                                                                                              \
        .at = {__VA_ARGS__}, .turned = frame                                                       \
    }

static inline void looked_open(const struct scene *scene, int bounces, struct looked *looked)
{
    struct error error = {0};
    *looked = (struct looked){0};
    bands_three(&looked->bands);
    CHECK(world_open(scene, (const double[]){-1, 1}, &looked->arena, &looked->world, &error));
    CHECK(lights_open(scene, &looked->bands, &looked->arena, &looked->lights, &error));
    looked->path =
        (struct path){.world = &looked->world, .lights = &looked->lights, .bounces = bounces};
    looked->table = sampler_table_new(5, LOOKED_BITS, &looked->arena);
    if (error.message[0] != 0) {
        printf("%s\n", error.message);
    }
}

/* Green along one ray; `which` of its points. */
static inline double looked_once(const struct looked *looked, const struct world_ray *ray,
                                 uint32_t sequence, uint32_t which)
{
    static const struct lanes lanes = {3, {0, 1, 2}};
    struct sampler_sequence of;
    struct radiance light;
    sampler_sequence_open(looked->table, 1, sequence, &of);
    struct sampler points = sampler_of(&of, which, 0);
    path_radiance(&looked->path, ray, &lanes, &points, &light);
    return light.of[1];
}

static inline struct looked_mean looked_mean(const struct looked *looked,
                                             const struct world_ray *ray, uint32_t count)
{
    static const struct lanes lanes = {3, {0, 1, 2}};
    double all = 0, squares = 0;
    for (uint32_t sequence = 0; sequence < LOOKED_SEQUENCES; sequence++) {
        struct sampler_sequence of;
        double sum = 0;
        sampler_sequence_open(looked->table, 1, sequence, &of);
        for (uint32_t i = 0; i < count; i++) {
            struct sampler points = sampler_of(&of, i, 0);
            struct radiance light;
            path_radiance(&looked->path, ray, &lanes, &points, &light);
            sum += light.of[1] / count;
        }
        all += sum / LOOKED_SEQUENCES;
        squares += sum * sum / LOOKED_SEQUENCES;
    }
    const double variance = fmax(0, squares - all * all);
    return (struct looked_mean){all, sqrt(variance / (LOOKED_SEQUENCES - 1))};
}

/* The mean is the expected one within 4 sigma, of which each is at most 0.5 % of it. */
static inline void looked_check(const struct looked *looked, const struct world_ray *ray,
                                uint32_t count, double expected, const char *what)
{
    const struct looked_mean found = looked_mean(looked, ray, count);
    CHECK_NEAR(found.mean, expected, 4 * found.sigma + 1e-9 * fabs(expected), what);
    CHECK_NEAR(found.sigma, 0, 0.005 * fabs(expected), what);
}

static inline struct world_ray looked_ray(struct vector from, struct vector at)
{
    return (struct world_ray){from, vector_unit(vector_minus(at, from)), 0, INFINITY};
}

#endif
