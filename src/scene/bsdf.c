/* scene/bsdf.c - BSDFs of surfaces: Lambertian, mirror, and microfacets over a diffuse ground. */
/* SPDX-License-Identifier: MIT */
#include "scene/bsdf.h"

#include "base/constants.h"
#include "base/turns.h"

#include <math.h>

/* -------- the coat -------- */

/* A normal of the coat as they are seen from `out`. */
static struct vector facet_of(double alpha, struct vector out, double u, double v)
{
    const struct vector seen = vector_unit((struct vector){alpha * out.x, alpha * out.y, out.z});
    const double beside = sqrt(seen.x * seen.x + seen.y * seen.y);
    const struct vector level = beside > 0 ? (struct vector){-seen.y / beside, seen.x / beside, 0}
                                           : (struct vector){1, 0, 0};
    const struct frame frame = {level, vector_cross(seen, level), seen};
    /* of the disc across `seen` the lower half is hidden by the horizon: it is pressed together */
    double cosine, sine;
    turns_of(v, &cosine, &sine);
    const double across = sqrt(u) * cosine, edge = sqrt(fmax(0, 1 - across * across));
    const double share = (1 + seen.z) / 2;
    const double up = (1 - share) * edge + share * sqrt(u) * sine;
    const double towards = sqrt(fmax(0, edge * edge - up * up));
    const struct vector normal = frame_out(&frame, (struct vector){across, up, towards});
    return vector_unit((struct vector){alpha * normal.x, alpha * normal.y, fmax(0, normal.z)});
}

/* -------- surfaces -------- */

/* Of the coat and the ground, how often the coat is chosen; -1: nothing of it reflects. */
static double coat_chance(const struct bsdf *scatter, struct vector out)
{
    if (scatter->kind == MATERIAL_LAMBERT) {
        return 0;
    }
    const double coat = microfacets_albedo(scatter->microfacets, out.z);
    const double ground = scatter->ground * (1 - coat);
    return coat + ground > 0 ? coat / (coat + ground) : -1;
}

double bsdf_value(const struct bsdf *scatter, struct vector out, struct vector in,
                  struct radiance *value)
{
    *value = (struct radiance){{0}};
    const bool is_glossy = scatter->kind == MATERIAL_GLOSSY;
    if (!(out.z > 0 && in.z > 0) || !(is_glossy || scatter->kind == MATERIAL_LAMBERT)) {
        return 0;
    }
    double coat = 0, ground = in.z / PI, pdf = ground;
    if (is_glossy) {
        const struct vector normal = vector_unit(vector_along(out, 1, in));
        const double own = microfacets_lambda(scatter->microfacets, out);
        /* G1 D/(4 cos(out)): of the directions that normals as they are seen send light from */
        const double alpha = scatter->microfacets->alpha;
        const double x = normal.x / alpha, y = normal.y / alpha;
        const double all = x * x + y * y + normal.z * normal.z;
        const double normals = 1 / (PI * alpha * alpha * all * all);
        const double found = normals / ((1 + own) * 4 * out.z);
        coat = found * microfacets_reflect(scatter->microfacets, out, normal, in);
        const double chance = coat_chance(scatter, out);
        pdf = chance < 0 ? 0 : chance * found + (1 - chance) * in.z / PI;
        /* what the ground under a coat sends on, over what it would send without */
        ground *= (1 - microfacets_albedo(scatter->microfacets, out.z)) *
                  (1 - microfacets_albedo(scatter->microfacets, in.z)) /
                  (1 - scatter->microfacets->mean_albedo);
    }
    for (size_t k = 0; k < scatter->lanes; k++) {
        value->of[k] = coat + scatter->colour.of[k] * ground;
    }
    return pdf;
}

bool bsdf_sample(const struct bsdf *scatter, struct vector out, const double u[3],
                 struct bsdf_sample *sample)
{
    if (!(out.z > 0) || scatter->kind == MATERIAL_BLACK) {
        return false;
    }
    if (scatter->kind == MATERIAL_MIRROR) {
        *sample = (struct bsdf_sample){{-out.x, -out.y, out.z}, scatter->colour, INFINITY};
        return true;
    }
    if (u[0] < coat_chance(scatter, out)) {
        sample->direction =
            vector_mirrored(out, facet_of(scatter->microfacets->alpha, out, u[1], u[2]));
    } else {
        double cosine, sine;
        turns_of(u[2], &cosine, &sine);
        const double beside = sqrt(u[1]);
        sample->direction = (struct vector){beside * cosine, beside * sine, sqrt(1 - u[1])};
    }
    sample->pdf = bsdf_value(scatter, out, sample->direction, &sample->throughput);
    for (size_t k = 0; k < scatter->lanes && sample->pdf > 0; k++) {
        sample->throughput.of[k] /= sample->pdf;
    }
    return sample->pdf > 0;
}
