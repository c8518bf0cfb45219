/* scene/path.c - the light that a ray meets, after as many turns as it likes. */
/* SPDX-License-Identifier: MIT */
#include "scene/path.h"

#include <math.h>

/* After so many surfaces paths may end by chance. */
enum { SURE_BOUNCES = 3 };
/*
 * Of the way to what shines, where something else may stand. What is left must hold the rounding
 * of both ends along the ray, which is their slack over the cosine at the emitter: 2^-24 suffices
 * where |x|+|y|+|z| over the way, over that cosine, is below 2^22. In turn what is nearer to a emitter
 * than 6e-8 of the way to it throws no shadow: 60 nm at 1 m.
 */
#define BEFORE_LIGHT (1 - 0x1p-24)

/* A path so far: the ray that it goes on by. */
struct path_state {
    const struct path *path;
    const struct lights *lights; /* that its ray may meet */
    const struct lanes *lanes;
    struct sampler *points;
    struct radiance *light; /* found so far */
    struct world_ray ray;
    struct radiance throughput; /* of light from there that comes back to the beginning */
    double pdf;                 /* by which the surface chose it; INFINITY: there was no choice */
};

double path_power_heuristic(double density, double other)
{
    const double ratio = other / density; /* of INFINITY 0 */
    return 1 / (1 + ratio * ratio);
}

static void path_add(struct path_state *walk, const struct radiance *light, double by)
{
    for (size_t k = 0; k < walk->lanes->count; k++) {
        walk->light->of[k] += by * walk->throughput.of[k] * light->of[k];
    }
}

/* The light of what the ray has met, or of what is behind everything. */
static void path_add_emission(struct path_state *walk, const struct world_hit *hit)
{
    const struct lights *lights = walk->lights;
    const struct materials *materials = &lights->materials;
    struct radiance light = {{0}};
    if (hit == NULL) {
        lights_background(lights, walk->ray.direction, walk->lanes, &light);
    } else if (materials_shines(materials, hit->thing)) {
        materials_shine(materials, hit->thing, hit->place, walk->lanes, &light);
    } else {
        return;
    }
    const double other = isinf(walk->pdf) ? 0
                                          : lights_pdf(lights, walk->ray.origin,
                                                       walk->ray.direction, walk->ray.time, hit);
    path_add(walk, &light, path_power_heuristic(walk->pdf, other));
}

/* The surface where a path goes on. */
struct path_vertex {
    const struct world_hit *hit;
    struct bsdf bsdf;
    struct frame frame;
    struct vector from, out; /* where rays leave it; where the path comes from, in the frame */
};

bool path_is_unoccluded(const struct path *path, struct vector from, double time,
                        const struct light_sample *sample)
{
    const struct world_ray ray = {from, sample->direction, time, sample->distance * BEFORE_LIGHT};
    return world_is_unoccluded(path->world, &ray);
}

/* Its light from one of those things that shine. */
static void path_add_direct_light(struct path_state *walk, const struct path_vertex *corner)
{
    const struct path *path = walk->path;
    double u[3];
    struct light_sample sample;
    struct radiance value;
    for (int i = 0; i < 3; i++) {
        u[i] = sampler_next(walk->points);
    }
    if (!lights_sample(path->lights, corner->from, walk->ray.time, u, walk->lanes, &sample) ||
        !(vector_dot(sample.direction, corner->hit->face) > 0)) {
        return;
    }
    const double density =
        bsdf_value(&corner->bsdf, corner->out, frame_in(&corner->frame, sample.direction), &value);
    if (!(density > 0) || !path_is_unoccluded(path, corner->from, walk->ray.time, &sample)) {
        return;
    }
    for (size_t k = 0; k < walk->lanes->count; k++) {
        value.of[k] *= sample.light.of[k];
    }
    path_add(walk, &value,
             (sample.is_point ? 1 : path_power_heuristic(sample.pdf, density)) / sample.pdf);
}

/* Does the path go on after `bounces` surfaces? Then it stands for those that do not, too. */
static bool path_survives_roulette(struct path_state *walk, int bounces)
{
    double most = 0;
    for (size_t k = 0; k < walk->lanes->count; k++) {
        most = fmax(most, walk->throughput.of[k]);
    }
    if (bounces < SURE_BOUNCES || !(most < 1)) {
        return most > 0;
    }
    if (!(sampler_next(walk->points) < most)) {
        return false;
    }
    for (size_t k = 0; k < walk->lanes->count; k++) {
        walk->throughput.of[k] /= most;
    }
    return true;
}

/* Turn the path where it has met a surface; false: it ends there. */
static bool path_scatter(struct path_state *walk, struct path_vertex *corner)
{
    double u[3] = {0};
    struct bsdf_sample sample;
    const bool is_mirror = corner->bsdf.kind == MATERIAL_MIRROR;
    for (int i = corner->bsdf.kind == MATERIAL_GLOSSY ? 0 : 1; i < 3 && !is_mirror; i++) {
        u[i] = sampler_next(walk->points);
    }
    if (!bsdf_sample(&corner->bsdf, corner->out, u, &sample)) {
        return false;
    }
    walk->ray.origin = corner->from;
    walk->ray.direction = frame_out(&corner->frame, sample.direction);
    walk->pdf = sample.pdf;
    walk->lights = walk->path->lights;
    for (size_t k = 0; k < walk->lanes->count; k++) {
        walk->throughput.of[k] *= sample.throughput.of[k];
    }
    return vector_dot(walk->ray.direction, corner->hit->face) > 0;
}

/* Add what a surface is lit by, and go on from there; false: nothing more comes. */
static bool path_reflect(struct path_state *walk, const struct world_hit *hit)
{
    struct path_vertex corner = {.hit = hit, .from = world_ray_origin(hit)};
    const struct vector back = vector_times(-1, walk->ray.direction);
    if (!materials_bsdf(&walk->path->lights->materials, hit->thing, hit->place, walk->lanes,
                        &corner.bsdf)) {
        return false;
    }
    /* smooth normals at the edge of a shape may turn away from who sees it */
    corner.frame = frame_about(vector_dot(back, hit->normal) > 0 ? hit->normal : hit->face);
    corner.out = frame_in(&corner.frame, back);
    if (corner.bsdf.kind != MATERIAL_MIRROR) {
        path_add_direct_light(walk, &corner);
    }
    return path_scatter(walk, &corner);
}

void path_radiance(const struct path *path, const struct world_ray *ray, const struct lanes *lanes,
                   struct sampler *points, struct radiance *light)
{
    struct path_state walk = {.path = path,
                              .lights = path->seen != NULL ? path->seen : path->lights,
                              .lanes = lanes,
                              .points = points,
                              .light = light,
                              .ray = *ray,
                              .pdf = path->seen != NULL ? path->pdf : INFINITY};
    *light = (struct radiance){{0}};
    for (size_t k = 0; k < lanes->count; k++) {
        walk.throughput.of[k] = 1;
    }
    for (int bounces = 0;; bounces++) {
        struct world_hit hit;
        const bool meets = world_intersect(path->world, &walk.ray, &hit);
        path_add_emission(&walk, meets ? &hit : NULL);
        if (!meets || bounces == path->bounces || !path_survives_roulette(&walk, bounces) ||
            !path_reflect(&walk, &hit)) {
            return;
        }
    }
}
