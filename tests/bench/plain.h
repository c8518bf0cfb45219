/* tests/bench/plain.h - rays as a textbook traces them: the yardstick of all times. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_BENCH_PLAIN_H
#define LENSCALC_BENCH_PLAIN_H

#include "clock.h"

#include <math.h>
#include <string.h>

/* An array of structs, radius and sag, one ray after the other, early out. */
enum { PLAIN_RAYS = 1024, PLAIN_SURFACES = 12 };

struct plain_surface {
    double radius, thickness, index, clear;
};

struct plain_ray {
    double x, y, z, l, m, n;
    int lost;
};

static int plain_trace(const struct plain_surface *surfaces, int count, struct plain_ray *ray)
{
    double index = 1, distance = 0;
    for (int i = 0; i < count; i++) {
        const struct plain_surface *s = &surfaces[i];
        ray->z -= distance;
        if (s->radius == 0) {
            double t = -ray->z / ray->n;
            ray->x += t * ray->l, ray->y += t * ray->m, ray->z = 0;
        } else {
            double zc = ray->z - s->radius;
            double b = ray->x * ray->l + ray->y * ray->m + zc * ray->n;
            double c = ray->x * ray->x + ray->y * ray->y + zc * zc - s->radius * s->radius;
            double disc = b * b - c;
            if (disc < 0) {
                return 1;
            }
            double t = s->radius > 0 ? -b - sqrt(disc) : -b + sqrt(disc);
            ray->x += t * ray->l, ray->y += t * ray->m, ray->z += t * ray->n;
        }
        if (sqrt(ray->x * ray->x + ray->y * ray->y) > s->clear) {
            return 2;
        }
        if (s->radius != 0) {
            double nx = -ray->x / s->radius, ny = -ray->y / s->radius;
            double nz = 1 - ray->z / s->radius;
            double cosine = nx * ray->l + ny * ray->m + nz * ray->n, ratio = index / s->index;
            double k = 1 - ratio * ratio * (1 - cosine * cosine);
            if (k < 0) {
                return 3;
            }
            double g = sqrt(k) - ratio * cosine;
            ray->l = ratio * ray->l + g * nx;
            ray->m = ratio * ray->m + g * ny;
            ray->n = ratio * ray->n + g * nz;
        }
        index = s->index;
        distance = s->thickness;
    }
    return 0;
}

/* The double Gauss of [Hanrahan04] at its d line, with its stop and image. */
static const struct plain_surface plain_gauss[PLAIN_SURFACES] = {
    {58.950, 7.520, 1.670, 25.2}, {169.660, 0.240, 1, 25.2},   {38.550, 8.050, 1.670, 23},
    {81.540, 6.550, 1.699, 23},   {25.500, 11.410, 1, 18},     {0, 9.000, 1, 17.1},
    {-28.990, 2.360, 1.603, 17},  {81.540, 12.130, 1.658, 20}, {-40.770, 0.380, 1, 20},
    {874.130, 6.440, 1.717, 20},  {-79.460, 72.228, 1, 20},    {0, 0, 1, 1e9},
};

/* A square of rays at 5 degrees: nearly all pass. */
static inline struct plain_ray plain_start(size_t i)
{
    double u = (double)(i % 32) / 31 * 2 - 1, v = (double)(i / 32 % 32) / 31 * 2 - 1;
    return (struct plain_ray){u * 11, v * 11 - 2, 0, 0, 0.087, 0.9962082, 0};
}

/* Seconds for all rays, the best of so many turns. */
static inline double plain_time(int turns)
{
    static struct plain_ray start[PLAIN_RAYS], rays[PLAIN_RAYS];
    double best = 1e9;
    for (size_t i = 0; i < PLAIN_RAYS; i++) {
        start[i] = plain_start(i);
    }
    for (int turn = 0; turn < turns; turn++) {
        double began = clock_time();
        for (int again = 0; again < 5; again++) {
            memcpy(rays, start, sizeof rays);
            for (size_t i = 0; i < PLAIN_RAYS; i++) {
                rays[i].lost = plain_trace(plain_gauss, PLAIN_SURFACES, &rays[i]);
            }
        }
        best = fmin(best, (clock_time() - began) / 5);
    }
    return best;
}

#endif
