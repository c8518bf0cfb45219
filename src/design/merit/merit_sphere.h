/* design/merit/merit_sphere.h - reference spheres, and paths to them, with derivatives. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_DESIGN_MERIT_MERIT_SPHERE_H
#define LENSCALC_DESIGN_MERIT_MERIT_SPHERE_H

#include "analysis/waves/opd.h"
#include "design/merit/merit_bundle.h"

#include <stdbool.h>

/* The sphere of one field, and how it changes. */
struct merit_sphere {
    struct opd_reference sphere;
    double *centre[2]; /* by each variable: of its x and y, */
    double *radius;    /* and of its radius, mm */
};

struct merit_spheres {
    struct merit_bundle chief; /* a ray a field, at the first wavelength */
    struct merit_sphere *list; /* one a field */
    struct dual *pupil;        /* z of the exit pupil behind the last vertex, one a variable */
    double *columns;           /* of x, y and r of the chief rays: a row a variable */
    size_t variable_count;
};

/*
 * Choose the chief rays: those through the centre of the stop, whatever other rays are aimed at; of
 * a telecentric object space, or without a stop, that of the entrance pupil.
 *
 * Given     wish   of the rays that paths are wanted of; links: of its first wavelength
 * Result    null: as merit_bundle_open
 */
struct merit_spheres *merit_spheres_open(const struct bundle_wish *wish,
                                         const struct bundle_links *links, size_t variable_count,
                                         struct arena *arena, struct error *error);

/*
 * The spheres of the lens as it is now.
 *
 * Given     spheres->chief  aimed (merit_bundle_aim), with its rates where derivatives are wanted
 *           spheres->pupil  so too
 *           links           of the first wavelength
 * Formula   the chief ray of direction e meets the image plane in C, and the pupil's plane at w =
 *           (pupil - image)/e_z along it: R = |w|
 * Errors    ERROR_DOMAIN: a chief ray is lost, or crosses the pupil in the image plane
 */
bool merit_spheres_find(struct merit_spheres *spheres, const struct bundle_links *links,
                        bool derives, struct error *error);

/*
 * Paths of rays to the spheres, and unit vectors from where they meet them to their centres, along
 * the light.
 *
 * Given     block, end  of the other rays
 *           path        receives opd_path of each, mm
 *           to          receives x and y of each; null: not wanted
 * Formula   with m = D - (D.e) e across the ray: root e - s m/R, root = sqrt(1 - m^2/R^2)
 */
void merit_spheres_meet(const struct merit_spheres *spheres, const struct merit_bundle *bundle,
                        const struct bundle_block *block, const struct ray_block *end, double *path,
                        double *const to[2]);

/* What a function is by the paths of rays and those vectors; and by centres and radii. */
struct merit_spheres_by {
    double path[RAYS_BLOCK], to[2][RAYS_BLOCK];
    double centre[2][RAYS_BLOCK], radius[RAYS_BLOCK]; /* received, one a ray */
};

/*
 * Backwards: adjoint, zeroed, receives the derivatives by the final rays, the sphere at rest.
 *
 * Formula   L = P - n (D.e - s B), B = R - sqrt(R^2 - q), q = D^2 - (D.e)^2: dB/dq = 1/(2 sqrt(R^2
 *           - q))
 * Source    analysis/waves/opd.h, derived here
 */
void merit_spheres_back(const struct merit_spheres *spheres, const struct merit_bundle *bundle,
                        const struct bundle_block *block, const struct ray_block *end,
                        struct merit_spheres_by *by, struct ray_block *adjoint);

/* Add to the columns of rays what the spheres do that move. */
void merit_spheres_move(const struct merit_spheres *spheres, const struct bundle_block *block,
                        const struct merit_spheres_by *by, double *columns);

#endif
