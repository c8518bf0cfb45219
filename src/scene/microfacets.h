/* scene/microfacets.h - microfacets: the GGX distribution, its masking and its albedo. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_MICROFACETS_H
#define LENSCALC_SCENE_MICROFACETS_H

#include "scene/vector.h"

/*
 * Its facets are mirrors of a clear medium, whose slopes are spread as GGX has it. What it lets
 * through meets the ground.
 */
enum { MICROFACET_NODES = 65 };
struct microfacets {
    double alpha; /* root mean square slope, about */
    double index; /* of its medium */
    double
        albedo[MICROFACET_NODES]; /* that it reflects, in all directions together, of light from an
                                 angle whose cosine is (k / (COAT_NODES - 1))^4 */
    double mean_albedo;           /* of these, over light from everywhere */
};

/*
 * Given     roughness  alpha, 0.001 .. 1
 *           index      1 .. 3
 * Formula   share(o) = mean of F(o.h) G(o, i)/G1(o) over normals h that are seen from o. Stretched
 *           by 1/alpha these are the half of a sphere that is seen, n = (cos b sin g, sin b,
 *           cos b cos g) in axes of which the last goes towards o: evenly by cos^2 b cos g db dg,
 *           from the horizon, g = -asin(o.z), on. Where i leaves the surface g lies within an
 *           angle for each b, and b below one, both known: Gauss and Legendre's rule within, which
 *           in g is closer together where it starts, along the surface
 * Source    [Heitz18] (normals that are seen); [Heitz14] equations 72, 99 (Smith's G1 and G);
 *           the limits derived in coat.c
 * Limits    off by 3e-4 at most, at nodes and between them, and the mean by 2e-4: seen by
 *           comparison with 12 x 50 points
 */
void microfacets_open(double roughness, double index, struct microfacets *coat);

/* The share of light that comes at an angle, or leaves at it. */
double microfacets_albedo(const struct microfacets *coat, double cosine);

/*
 * What one of its normals sends on of the light from `in`, over how often it is seen from `out`;
 * 0: `in` lies behind the surface.
 */
double microfacets_reflect(const struct microfacets *coat, struct vector out, struct vector normal,
                           struct vector in);

/* Smith's Lambda: facets hidden for each one that is seen. */
double microfacets_lambda(const struct microfacets *coat, struct vector direction);

#endif
