/* analysis/rays/coddington.c - a narrow beam by the derivatives of its middle ray. */
/* SPDX-License-Identifier: MIT */
#include "analysis/rays/coddington.h"

#include "trace/tangent.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Below this sine a ray counts as parallel to the axis. */
static const double PARALLEL = 1e-9;

static double coddington_dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void seed(const struct beam *beam, const double at[2], int k, struct ray_block *tangent)
{
    double point[3], direction[3];
    beam_slope(beam, at, k, point, direction);
    memset(tangent, 0, sizeof *tangent);
    tangent->x[0] = point[0];
    tangent->y[0] = point[1];
    tangent->z[0] = point[2];
    tangent->p[0] = direction[0];
    tangent->q[0] = direction[1];
    tangent->r[0] = direction[2];
}

/* Derivatives across the ray, by rows: tangential, sagittal; by columns: those of the start. */
struct beam_spread {
    double A[2][2], B[2][2];
};

static double coddington_size_of(const double m[2][2])
{
    return hypot(hypot(m[0][0], m[0][1]), hypot(m[1][0], m[1][1]));
}

/* Are the two sections independent of each other, but for rounding? */
static bool is_decoupled(const double m[2][2])
{
    return fabs(m[0][1]) + fabs(m[1][0]) <= 8 * DBL_EPSILON * coddington_size_of(m);
}

/*
 * Eigenvalues of a symmetric matrix -P Q^-1: the first is that of the eigenvector next to the first
 * axis. By Jacobi's rotation, which keeps the digits of the smaller one.
 */
static void eigenvalues(const double P[2][2], const double Q[2][2], double values[2], double *turn)
{
    const double over = -1 / (Q[0][0] * Q[1][1] - Q[0][1] * Q[1][0]);
    double a = over * (P[0][0] * Q[1][1] - P[0][1] * Q[1][0]);
    double b = over * (P[1][1] * Q[0][0] - P[1][0] * Q[0][1]);
    double mixed =
        over / 2 *
        ((P[0][1] * Q[0][0] - P[0][0] * Q[0][1]) + (P[1][0] * Q[1][1] - P[1][1] * Q[1][0]));
    double tangent = 0;
    if (mixed != 0) {
        double half = (b - a) / (2 * mixed);
        tangent = copysign(1, half) / (fabs(half) + hypot(1, half));
    }
    values[0] = a - tangent * mixed;
    values[1] = b + tangent * mixed;
    *turn = -atan(tangent);
}

static double coddington_inverse(double value)
{
    return value != 0 ? 1 / value : (double)INFINITY;
}

static void find_foci(const struct beam_spread *all, struct narrow_beam *narrow)
{
    double foci[2], size = coddington_size_of(all->B);
    double det = all->B[0][0] * all->B[1][1] - all->B[0][1] * all->B[1][0];
    narrow->turn = 0;
    if (is_decoupled(all->A) && is_decoupled(all->B)) {
        for (int i = 0; i < 2; i++) {
            foci[i] = all->B[i][i] != 0 ? -all->A[i][i] / all->B[i][i] : (double)INFINITY;
        }
    } else if (fabs(det) > 1e-8 * size * size) {
        eigenvalues(all->A, all->B, foci, &narrow->turn);
    } else {
        eigenvalues(all->B, all->A, foci, &narrow->turn);
        foci[0] = coddington_inverse(foci[0]);
        foci[1] = coddington_inverse(foci[1]);
    }
    narrow->tangential = foci[0];
    narrow->sagittal = foci[1];
}

static double coddington_place_of(const struct ray *ray, double distance)
{
    return isinf(distance) ? (double)INFINITY : ray->point[2] + distance * ray->cosine[2];
}

bool coddington_foci(const struct system *system, const struct beam *beam, const double at[2],
                     struct arena *arena, struct narrow_beam *narrow)
{
    const struct ray start = beam_ray(beam, at[0], at[1]);
    const struct rays rays = rays_new(arena, 2 * (size_t)RAYS_BLOCK);
    struct ray_block *tangents = rays_new(arena, 2 * (size_t)RAYS_BLOCK).blocks;
    rays_set(&rays, 0, beam->n, &start);
    seed(beam, at, 0, &tangents[0]);
    seed(beam, at, 1, &tangents[1]);
    tangent_follow(system, kernel_lanes(1), 2, rays.blocks, tangents);
    *narrow = (struct narrow_beam){.chief = rays_get(&rays, 0, system->index_last)};
    if (narrow->chief.status != RAY_OK) {
        return false;
    }
    double across[2][3];
    struct beam_spread all;
    /* Unit vectors across the ray: in the plane of ray and axis, and at right angles to it. */
    const double *d = narrow->chief.cosine, *x = narrow->chief.point;
    double side = hypot(d[0], d[1]), up[2] = {d[0], d[1]}, away = hypot(x[0], x[1]);
    if (!(side > PARALLEL)) {
        up[0] = away > 0 ? x[0] : 0;
        up[1] = away > 0 ? x[1] : 1;
    }
    double length = hypot(up[0], up[1]), sign = up[1] < 0 ? -1 : 1;
    up[0] *= sign / length;
    up[1] *= sign / length;
    across[1][0] = up[1];
    across[1][1] = -up[0];
    across[1][2] = 0;
    /* d x sagittal, of unit length but for a ray that is parallel only nearly */
    across[0][0] = up[0] * d[2];
    across[0][1] = up[1] * d[2];
    across[0][2] = -(up[0] * d[0] + up[1] * d[1]);
    for (int k = 0; k < 2; k++) {
        const struct ray_block *of = &tangents[k];
        const double point[3] = {of->x[0], of->y[0], of->z[0]};
        const double direction[3] = {of->p[0] / system->index_last, of->q[0] / system->index_last,
                                     of->r[0] / system->index_last};
        for (int i = 0; i < 2; i++) {
            all.A[i][1 - k] = coddington_dot(across[i], point);
            all.B[i][1 - k] = coddington_dot(across[i], direction);
        }
    }
    find_foci(&all, narrow);
    narrow->tangential_z = coddington_place_of(&narrow->chief, narrow->tangential);
    narrow->sagittal_z = coddington_place_of(&narrow->chief, narrow->sagittal);
    return true;
}
