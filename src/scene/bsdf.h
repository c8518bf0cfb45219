/* scene/bsdf.h - BSDFs of surfaces: Lambertian, mirror, and microfacets over a diffuse ground. */
/* SPDX-License-Identifier: MIT */
#ifndef LENSCALC_SCENE_BSDF_H
#define LENSCALC_SCENE_BSDF_H

#include "light/bands.h"
#include "scene/microfacets.h"
#include "scene/scene.h"
#include "scene/vector.h"

#include <stdbool.h>
#include <stddef.h>

/* The BSDF at one point of a surface, in the lanes of a ray. */
struct bsdf {
    enum scene_material_kind kind;
    size_t lanes;
    struct radiance colour;                /* shares, 0 to 1; of a glossy one those of its ground */
    const struct microfacets *microfacets; /* of a glossy one */
    double ground; /* 0 to 1: about its colour, by which directions are chosen; the same
                                for all lanes that a ray may have */
};

/* A direction sampled from the BSDF. */
struct bsdf_sample {
    struct vector direction;    /* of length 1 */
    struct radiance throughput; /* value over pdf: what a path carries on */
    double pdf;                 /* per sr; INFINITY: a mirror's only direction */
};

/*
 * Light that comes from one direction and leaves in another.
 *
 * Given     out, in  of length 1, away from the surface, in axes of which z is its normal
 * Result    value    of each lane f(in, out) cos(in), per sr: light that leaves towards `out` is
 *                    the integral of it times what comes from `in`. Of mirrors 0
 *           returns the pdf per sr with which bsdf_sample finds `in`; 0: never, or one of
 *           the two lies behind the surface
 * Formula   Lambert: colour cos/pi. Glossy: F D G/(4 cos(in) cos(out)) of the coat, and of the
 *           ground colour (1 - E(in)) (1 - E(out))/(pi (1 - mean E)), E the coat's share: so a
 *           white ground gives all light back, no colour more than came, and either way is the same
 * Source    [Walter07] equations 20, 22, 33 (microfacets, Fresnel, GGX); [Heitz14] equation 99 (G);
 *           [Kelemen01] (the ground)
 */
double bsdf_value(const struct bsdf *scatter, struct vector out, struct vector in,
                  struct radiance *value);

/*
 * Sample the direction that light comes from which leaves in another.
 *
 * Given     out  as above
 *           u    three numbers, each evenly spread over 0..1
 * Result    false: nothing comes from there, and no light is lost by that
 * Formula   the coat or the ground by what each reflects; the coat's normals as they are seen, the
 *           ground's directions by their cosine; the pdf is that of both together
 * Source    [Heitz18]
 */
bool bsdf_sample(const struct bsdf *scatter, struct vector out, const double u[3],
                 struct bsdf_sample *sample);

#endif
