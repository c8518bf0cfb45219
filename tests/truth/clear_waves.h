/* tests/truth/clear_waves.h - for clear_sums.c: wave fronts. */
/* SPDX-License-Identifier: MIT */
#ifndef CLEAR_WAVES_H
#define CLEAR_WAVES_H

#include "clear_rays.h"

/* What wave fronts are compared with. */
struct sphere {
    double wavelength, centre[3], crossing[3], n, zero;
    bool is_plane; /* the pupil is infinitely far away: the sphere's radius is infinite */
};

/* Where a ray meets the image plane. */
static void at_image(const struct ray *ray, double at[3])
{
    const double t = (image_z - ray->p[2]) / ray->d[2];
    for (int k = 0; k < 3; k++) {
        at[k] = ray->p[k] + t * ray->d[k];
    }
}

/* The path to the sphere, less its radius, by the textbook's quadratic. */
static double path_to(const struct sphere *sphere, const struct ray *ray)
{
    double from[3], back = 0, square = 0, radius2 = 0, side = 0;
    for (int k = 0; k < 3; k++) {
        const double crossing = sphere->crossing[k] - sphere->centre[k];
        from[k] = ray->p[k] - sphere->centre[k];
        back += from[k] * ray->d[k];
        square += from[k] * from[k];
        radius2 += crossing * crossing;
        side += crossing * ray->d[k];
    }
    const long double q = (long double)square - (long double)back * back;
    const double bulge =
        sphere->is_plane ? 0 : (double)(q / (sqrt(radius2) + sqrt(radius2 - (double)q)));
    return ray->path - sphere->n * (back - (side > 0 ? -1 : 1) * bulge);
}

static double wave_of(const struct sphere *sphere, const struct ray *ray)
{
    return (sphere->zero - path_to(sphere, ray)) / sphere->wavelength;
}

/* How it changes as the centre moves along an axis, per mm. */
static double slope_of(const struct sphere *sphere, const struct ray *ray, int axis)
{
    const double step = axis == 2 ? 1e-2 : 1e-3;
    double wave[2];
    for (int i = 0; i < 2; i++) {
        struct sphere moved = *sphere;
        moved.centre[axis] += (i == 0 ? -1 : 1) * step;
        wave[i] = wave_of(&moved, ray);
    }
    return (wave[1] - wave[0]) / (2 * step);
}

#endif
