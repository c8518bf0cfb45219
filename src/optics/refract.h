/* optics/refract.h - one spherical surface: conjugate points, and one ray exactly. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_OPTICS_REFRACT_H
#define LENSCALC_OPTICS_REFRACT_H

#include <stdbool.h>

#include "base/error.h"

/*
 * One surface and a pair of conjugate points on its axis. All z are from the vertex, + to the
 * right, where the light goes: a real object has z < 0.
 */
struct refract_surface {
    double n;       /* index before, > 0 */
    double n_after; /* index after, > 0; a mirror: ignored, -n is taken */
    double R;       /* radius, mm, not 0; + with the centre to the right; inf = plane */
    double z;       /* object point, mm; +-inf = infinity */
    double z_image; /* its Gaussian image, mm; may be infinite */
    bool mirror;
};

/* Surface power (n' - n)/R, 1/mm; 0 for a plane. */
double refract_power(const struct refract_surface *surface);

/*
 * The one of n, n', R, z, z' that is missing.
 *
 * Given     surface  exactly one of the five is NaN (of a mirror: of n, R, z, z', and never n,
 *                    which drops out); filled in
 * Result    z' infinite for an image at infinity, z -inf for an object there, R inf for a plane
 * Formula   n'/z' = n/z + (n' - n)/R; indices from n'(1/z' - 1/R) = n (1/z - 1/R)
 * Source    [Welford86] ch. 3; Gauss' formula of [Hanrahan04] with signed coordinates
 * Errors    ERROR_USAGE: not one unknown; ERROR_DOMAIN: index not above 0 or infinite, R = 0, and
 *           questions without one answer: a radius between equal indices, anything but z and z'
 *           from an object in the vertex, an index from points at the centre of curvature
 * Limits    Paraxial. Near z' = inf it is conditioned as refract_condition says
 */
bool refract_solve(struct refract_surface *surface, struct error *error);

/*
 * Angles of a surface between two media, rad; NaN where there is none.
 *
 * Result    critical  from which on all light is reflected; only where n' < n
 *           Brewster  at which reflected light is polarised wholly
 * Formula   sin I = n'/n; tan I = n'/n
 * Source    [OpenStax16] ch. 1.4, 1.7
 */
double refract_critical_angle(double n, double n_after);
double refract_brewster_angle(double n, double n_after);

/*
 * The index behind a surface, from the angles at it.
 *
 * Given     n           index before, > 0
 *           incidence   I, refraction  I': rad, both of one sign, not 0, below a right angle
 * Formula   n' = n sin I/sin I'
 * Source    Snell's law, [OpenStax16] ch. 1.3
 * Errors    ERROR_DOMAIN: angles of different signs, 0, or a right angle and more
 */
bool refract_index_of(double n, double incidence, double refraction, double *n_after,
                      struct error *error);

/* How much z' moves, relatively, with n/z and P: (|n/z| + |P|)/|n/z + P|; 1 where it is sure. */
double refract_condition(const struct refract_surface *surface);

/* Which meridional ray; NaN = not given. */
struct refract_aim {
    double height;  /* where it meets the surface, or the vertex plane; mm */
    double angle;   /* slope angle U before, rad, + rising to the right, |U| < pi/2 */
    bool at_vertex; /* the height is in the vertex plane, continued straight */
};

/* A ray at the surface. Angles rad; lines are from axis towards ray, + turns to larger y. */
struct refract_ray {
    double z;                    /* where it crosses the axis before, mm; -inf for a parallel ray */
    double height, sag;          /* point of the surface, mm */
    double sin_u, cos_u;         /* of U */
    double inverse_s;            /* 1/s, s from the surface along the ray to the axis point, 1/mm */
    double slope;                /* U */
    double normal;               /* phi, angle of the radius with the axis: sin phi = h/R */
    double incidence;            /* I = U + phi */
    double refraction;           /* I', n' sin I' = n sin I; a mirror: -I */
    double slope_after;          /* U' = I' - phi */
    double crossing;             /* where it crosses the axis after, mm; inf if it does not */
    double difference;           /* crossing - Gaussian image, mm; NaN if either is infinite */
    double transverse;           /* its height in the Gaussian image plane, mm; NaN likewise */
    double paraxial_slope;       /* u = -h/z */
    double paraxial_incidence;   /* i = u + h/R */
    double paraxial_refraction;  /* i' = n i/n' */
    double paraxial_slope_after; /* u' = (n u - h P)/n' */
};

/*
 * The ray before the surface: z, height, sag, slope from two of height, angle and z.
 *
 * Given     surface  R, and z or NaN
 *           aim      two of height, angle and surface->z are given
 *           ray      receives z, height, sag, sin_u, cos_u, inverse_s, slope
 * Formula   sag = c h^2/(1 + sqrt(1 - c^2 h^2)); from a vertex height y0, with L, M = cos U, sin U:
 *           t = c y0^2/(G + sqrt(G^2 - c^2 y0^2)), G = L - c y0 M
 * Source    [Welford86] ch. 4
 * Errors    the ray misses the surface, or meets its sphere only beyond the hemisphere; the three
 *           do not make one ray
 */
bool refract_place(const struct refract_surface *surface, const struct refract_aim *aim,
                   struct refract_ray *ray, struct error *error);

/*
 * The ray after the surface, exactly and paraxially.
 *
 * Given     surface  complete, as refract_solve leaves it
 *           ray      as refract_place leaves it; the rest is filled in
 * Formula   G = n' cos I' - n cos I = (n'^2 - n^2)/(n' cos I' + n cos I) (mirror: -2 n cos I),
 *           n' sin U' = n sin U - G sin phi, n' cos U' = n cos U + G cos phi,
 *           n'/s' = n/s + G/R, crossing = sag + s' cos U'.
 *           G in the place of n' - n is all that distinguishes it from the paraxial formula. No
 *           step subtracts what the problem does not; h = 0 is no exception. The difference is
 *           sag + n'(D - (1 - cos U') Kp)/(K Kp), K = n'/s', Kp = n'/z', with D = Kp - K from
 *           n/z - n/s = n (z (1 - cos U) - sag)/(z (z - sag)) and
 *           G - (n' - n) = (n' - n)(n'(1 - cos I') + n (1 - cos I))/(n' cos I' + n cos I):
 *           every term is of the order h^2 and keeps its digits as h goes to 0.
 * Source    Vector form of Snell's law [Welford86] ch. 4; the rest derived here, pinned by
 *           tests/unit/test_refract.c (exact - paraxial ~ h^2, aplanatic points, reversal)
 * Errors    ERROR_DOMAIN: total reflection, with the critical angle; the surface is turned away
 *           from the ray
 */
bool refract_through(const struct refract_surface *surface, struct refract_ray *ray,
                     struct error *error);

#endif
