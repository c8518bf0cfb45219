/* tests/truth/clear_waves.h - for clear_sums.c: wave fronts, and the sphere that fits one best. */
/* SPDX-License-Identifier: MIT */
#ifndef CLEAR_WAVES_H
#define CLEAR_WAVES_H

#include "clear_rays.h"

/* What wave fronts are compared with. */
struct sphere {
    double wavelength, centre[3], crossing[3], n, zero;
    bool is_plane; /* the pupil is infinitely far away: the sphere's radius is infinite */
};

/* Rays that are kept, with what each counts. */
struct sheaf {
    struct ray *rays;
    double *weights;
    int count;
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

static double sheaf_square(const struct sheaf *sheaf, const struct sphere *sphere)
{
    double all = 0, mean = 0, square = 0;
    for (int i = 0; i < sheaf->count; i++) {
        all += sheaf->weights[i];
        mean += sheaf->weights[i] * wave_of(sphere, &sheaf->rays[i]);
    }
    for (int i = 0; i < sheaf->count; i++) {
        const double off = wave_of(sphere, &sheaf->rays[i]) - mean / all;
        square += sheaf->weights[i] * off * off;
    }
    return square / all;
}

/*
 * Newton's steps to the least mean square in y and z of the centre, by differences; fields lie in
 * y. False: there is no least one close by.
 */
static bool find_best(const struct sheaf *sheaf, struct sphere *sphere)
{
    double step[2] = {1e-3, 1e-2};
    for (int turns = 0; turns < 60; turns++) {
        double f[3][3], move[2];
        for (int i = 0; i < 9; i++) {
            struct sphere moved = *sphere;
            moved.centre[1] += (i / 3 - 1) * step[0];
            moved.centre[2] += (i % 3 - 1) * step[1];
            f[i / 3][i % 3] = sheaf_square(sheaf, &moved);
        }
        const double gy = (f[2][1] - f[0][1]) / 2, gz = (f[1][2] - f[1][0]) / 2;
        const double yy = f[2][1] - 2 * f[1][1] + f[0][1], zz = f[1][2] - 2 * f[1][1] + f[1][0];
        const double yz = (f[2][2] - f[2][0] - f[0][2] + f[0][0]) / 4, det = yy * zz - yz * yz;
        if (!(det > 0 && yy > 0)) {
            return false;
        }
        move[0] = -(zz * gy - yz * gz) / det;
        move[1] = -(yy * gz - yz * gy) / det;
        sphere->centre[1] += move[0] * step[0];
        sphere->centre[2] += move[1] * step[1];
        if (hypot(move[0], move[1]) < 1e-5) {
            if (step[0] < 1e-4) {
                return true;
            }
            step[0] /= 16;
            step[1] /= 16;
        }
    }
    return false;
}

#endif
