/* scene/scatter.c - how surfaces send light on: evenly, as a mirror, or glossy. */
/* SPDX-License-Identifier: MIT */
#include "scene/scatter.h"

#include "base/constants.h"
#include "base/turns.h"

#include <math.h>

/*
 * By which a coat's share is found: a lattice of Fibonacci's numbers over the square, with fewer
 * normals where no way is along the surface, which is where the smoothest coats need them all.
 */
struct lattice {
    int count, step;
};
static const struct lattice fine = {1597, 987}, coarse = {377, 233};
#define FINE_BELOW 0.02 /* cosine */
/* The cosine in place of 0, by which nothing leaves: from below alpha all facets look the same. */
#define GRAZING 1e-9

/* -------- the coat -------- */

/* Of natural light that meets a clear medium; c is the cosine of its angle. */
static double fresnel(double index, double c)
{
    const double g = sqrt(index * index - 1 + c * c);
    const double across = (g - c) / (g + c);
    const double along = (c * (g + c) - 1) / (c * (g - c) + 1);
    /* of no other medium nothing, at a right angle too, where the second is 0/0 */
    return index > 1 ? across * across * (1 + along * along) / 2 : 0;
}

/* Smith's Lambda: facets hidden for each one that is seen. */
static double hidden(double alpha, struct vector way)
{
    const double slope = (way.x * way.x + way.y * way.y) / (way.z * way.z);
    return (sqrt(1 + alpha * alpha * slope) - 1) / 2;
}

static double facets(double alpha, struct vector normal)
{
    const double x = normal.x / alpha, y = normal.y / alpha;
    const double all = x * x + y * y + normal.z * normal.z;
    return 1 / (PI * alpha * alpha * all * all);
}

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

static struct vector mirrored(struct vector out, struct vector normal)
{
    return vector_along(vector_times(-1, out), 2 * vector_dot(out, normal), normal);
}

/* Its share of light by one normal, over how often that is seen; 0: it goes behind the surface. */
static double coat_by(const struct coat *coat, struct vector out, struct vector normal,
                      struct vector in)
{
    const double own = hidden(coat->alpha, out);
    if (!(in.z > 0)) {
        return 0;
    }
    return fresnel(coat->index, vector_dot(out, normal)) * (1 + own) /
           (1 + own + hidden(coat->alpha, in));
}

static double share_towards(const struct coat *coat, double cosine)
{
    const struct vector out = {sqrt(fmax(0, 1 - cosine * cosine)), 0, cosine};
    const struct lattice *lattice = cosine < FINE_BELOW ? &fine : &coarse;
    const double count = lattice->count;
    double sum = 0;
    for (int i = 0; i < lattice->count; i++) {
        const struct vector normal = facet_of(coat->alpha, out, (i + 0.5) / count,
                                              i * lattice->step % lattice->count / count);
        sum += coat_by(coat, out, normal, mirrored(out, normal));
    }
    return sum / count;
}

static double node(int k)
{
    const double root = (double)k / (COAT_NODES - 1);
    return root * root;
}

void coat_open(double roughness, double index, struct coat *coat)
{
    coat->alpha = roughness;
    coat->index = index;
    coat->share[0] = share_towards(coat, GRAZING);
    coat->mean = 0;
    for (int k = 1; k < COAT_NODES; k++) {
        const double from = node(k - 1), to = node(k);
        coat->share[k] = share_towards(coat, to);
        /* the integral of 2 c share(c) dc, of straight lines as coat_share has them */
        coat->mean += (to - from) / 3 *
                      (coat->share[k - 1] * (2 * from + to) + coat->share[k] * (from + 2 * to));
    }
}

static double coat_share(const struct coat *coat, double cosine)
{
    const int k = (int)fmin(sqrt(cosine) * (COAT_NODES - 1), COAT_NODES - 2);
    const double place = (cosine - node(k)) / (node(k + 1) - node(k));
    return coat->share[k] + place * (coat->share[k + 1] - coat->share[k]);
}

/* -------- surfaces -------- */

/* Of the coat and the ground, how often the coat is chosen; -1: nothing of it reflects. */
static double coat_chance(const struct scatter *scatter, struct vector out)
{
    if (scatter->kind == MATERIAL_LAMBERT) {
        return 0;
    }
    const double coat = coat_share(scatter->coat, out.z);
    const double ground = scatter->ground * (1 - coat);
    return coat + ground > 0 ? coat / (coat + ground) : -1;
}

/* What the ground under a coat sends on, over what it would send without. */
static double through_coat(const struct coat *coat, struct vector out, struct vector in)
{
    return (1 - coat_share(coat, out.z)) * (1 - coat_share(coat, in.z)) / (1 - coat->mean);
}

double scatter_value(const struct scatter *scatter, struct vector out, struct vector in,
                     struct radiance *value)
{
    *value = (struct radiance){{0}};
    const bool is_glossy = scatter->kind == MATERIAL_GLOSSY;
    if (!(out.z > 0 && in.z > 0) || !(is_glossy || scatter->kind == MATERIAL_LAMBERT)) {
        return 0;
    }
    double coat = 0, ground = in.z / PI, found = 0, chance = 0;
    if (is_glossy) {
        const struct vector normal = vector_unit(vector_along(out, 1, in));
        const double own = hidden(scatter->coat->alpha, out);
        /* G1 D/(4 cos(out)): of the directions that normals as they are seen send light from */
        found = facets(scatter->coat->alpha, normal) / ((1 + own) * 4 * out.z);
        coat = found * coat_by(scatter->coat, out, normal, in);
        chance = coat_chance(scatter, out);
        ground *= through_coat(scatter->coat, out, in);
    }
    for (size_t k = 0; k < scatter->lanes; k++) {
        value->of[k] = coat + scatter->colour.of[k] * ground;
    }
    return chance < 0 ? 0 : chance * found + (1 - chance) * in.z / PI;
}

bool scatter_sample(const struct scatter *scatter, struct vector out, const double u[3],
                    struct scatter_sample *sample)
{
    if (!(out.z > 0) || scatter->kind == MATERIAL_BLACK) {
        return false;
    }
    if (scatter->kind == MATERIAL_MIRROR) {
        *sample = (struct scatter_sample){{-out.x, -out.y, out.z}, scatter->colour, INFINITY};
        return true;
    }
    if (u[0] < coat_chance(scatter, out)) {
        sample->way = mirrored(out, facet_of(scatter->coat->alpha, out, u[1], u[2]));
    } else {
        double cosine, sine;
        turns_of(u[2], &cosine, &sine);
        const double beside = sqrt(u[1]);
        sample->way = (struct vector){beside * cosine, beside * sine, sqrt(1 - u[1])};
    }
    sample->density = scatter_value(scatter, out, sample->way, &sample->share);
    for (size_t k = 0; k < scatter->lanes && sample->density > 0; k++) {
        sample->share.of[k] /= sample->density;
    }
    return sample->density > 0;
}
